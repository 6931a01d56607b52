"""A flat bottom with a round outlet as an OBJ file: orifice.py DIAMETER FILE [OUTER_DIAMETER], lengths in m."""

import math
import sys

SEGMENTS = 48


def write_bottom(path, diameter, outer=0.12):
    """A ring of triangles in the plane z = 0, its area that of the round outlet."""
    step = 2 * math.pi / SEGMENTS
    inner = 0.5 * diameter * math.sqrt(step / math.sin(step))
    rows = ["# flat bottom with an outlet of %.6g m" % diameter]
    for radius in (inner, 0.5 * outer):
        rows += ["v %.9g %.9g 0" % (radius * math.cos(i * step), radius * math.sin(i * step)) for i in range(SEGMENTS)]
    for i in range(SEGMENTS):
        a, b = i + 1, (i + 1) % SEGMENTS + 1
        rows += ["f %d %d %d" % (a, a + SEGMENTS, b + SEGMENTS), "f %d %d %d" % (a, b + SEGMENTS, b)]
    with open(path, "w") as file:
        file.write("\n".join(rows) + "\n")


if __name__ == "__main__":
    write_bottom(sys.argv[2], float(sys.argv[1]), *map(float, sys.argv[3:]))
