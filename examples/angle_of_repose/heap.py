"""The angle of a heap around the axis z, sector by sector, so that one knows what it scatters by. Standard library only."""

from math import atan, atan2, degrees, floor, hypot, pi, sqrt

from granular import line

GRAIN, INNER, OUTER = 5e-3, 0.005, 0.045  # [m]; radii between which the surface is a cone
SECTORS = 6


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
