"""The angle of a heap around the axis z, sector by sector, so that one knows what it scatters by: heap.py RESULTS prints it.

RESULTS is the folder of a run whose observer `track` saw the heap; its last look counts. Standard library only.
"""

import pathlib
import sys
from math import atan, atan2, degrees, floor, hypot, pi, sqrt

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))

from checking import Run
from granular import frames, line

GRAIN, INNER, OUTER = 5e-3, 0.005, 0.045  # [m]; radii between which the surface is a cone
SECTORS = 6


def grains(track):
    """Middles [m] of the grains of a `track` table that lie on the tray at the end."""
    _, rows = frames(track)[-1]
    return [(track["x"][i], track["y"][i], track["z"][i]) for i in rows if track["z"][i] > 0.0]


def tops(points):
    """The highest grain in each column one grain wide. Columns are equal everywhere: among more grains, as in a ring further out,
    the highest stands higher, and the heap would look flatter than it is."""
    highest = {}
    for x, y, z in points:
        column = floor(x / GRAIN), floor(y / GRAIN)
        if column not in highest or z > highest[column][2]:
            highest[column] = (x, y, z)
    return highest.values()


def angles(points):
    """Angle [deg] of each sector: of the line of height over radius through its tops."""
    sectors = [[] for _ in range(SECTORS)]
    for x, y, z in tops(points):
        if INNER <= hypot(x, y) <= OUTER:
            sectors[int((atan2(y, x) / (2 * pi) % 1.0) * SECTORS)].append((hypot(x, y), z))
    return [-degrees(atan(line(*zip(*sector))[0])) for sector in sectors]


def mean_and_error(values):
    """(mean, standard error)."""
    n, mean = len(values), sum(values) / len(values)
    return mean, sqrt(sum((v - mean) ** 2 for v in values) / (n - 1) / n)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        heap = grains(Run(sys.argv[1]).table("track.csv"))
    except FileNotFoundError as missing:
        sys.exit(f"{missing.filename}: no such file; RESULTS is the folder of a run of a scene that has an observer `track`")
    angle, error = mean_and_error(angles(heap))
    print(f"{len(heap)} grains, angle of repose {angle:.1f} +- {error:.1f} degrees")
