"""Writes blade.obj: a plate of 33 x 16 x 3 mm along x, tilted by 45 degrees so that its lower edge leads about +z, lengths in m."""

import math
import pathlib

TILT = math.radians(45)
REACH, HALF_HEIGHT, HALF_THICKNESS = 0.033, 0.008, 0.0015
SQUARES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]

rows = [f"# {__doc__.split(': ')[1]}"]
for i in range(8):
    across = HALF_THICKNESS if i & 2 else -HALF_THICKNESS
    along = HALF_HEIGHT if i & 4 else -HALF_HEIGHT
    y, z = across * math.cos(TILT) - along * math.sin(TILT), across * math.sin(TILT) + along * math.cos(TILT)
    rows.append("v %.6g %.6g %.6g" % (REACH if i & 1 else 0.0, y, z))
for a, b, c, d in SQUARES:
    rows += ["f %d %d %d" % (a + 1, b + 1, c + 1), "f %d %d %d" % (a + 1, c + 1, d + 1)]
(pathlib.Path(__file__).parent / "blade.obj").write_text("\n".join(rows) + "\n")
