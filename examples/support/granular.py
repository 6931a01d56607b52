"""What the checks of granular flows measure: slopes of surfaces, lines through points, mixing, rates. Standard library only."""

import math


def line(x, y):
    """Least squares: (slope, intercept) of y over x."""
    n = len(x)
    mx, my = sum(x) / n, sum(y) / n
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
    return slope, my - slope * mx


def frames(track, since=0.0, until=math.inf):
    """Rows of a `track` table by time: a list of (time, indices of rows)."""
    rows = {}
    for i, t in enumerate(track["time"]):
        if since <= t <= until:
            rows.setdefault(t, []).append(i)
    return sorted(rows.items())


def surface(across, height, width):
    """The highest grain in each column of `width`: (middles of columns, heights), where there is a grain."""
    tops = {}
    for a, h in zip(across, height):
        column = math.floor(a / width)
        tops[column] = max(tops.get(column, -math.inf), h)
    columns = sorted(tops)
    return [(c + 0.5) * width for c in columns], [tops[c] for c in columns]


def slope_angle(across, height, width, lower, upper):
    """Angle [deg] of the line through the surface between `lower` and `upper`."""
    x, h = surface(across, height, width)
    inside = [i for i, c in enumerate(x) if lower <= c <= upper]
    return math.degrees(math.atan(line([x[i] for i in inside], [h[i] for i in inside])[0]))


def lacey(points, kinds, side, least=4):
    """Lacey's index of mixing, 0 to 1, of two kinds (0 and 1), over cubes of `side` with at least `least` grains.

    (s0^2 - s^2) / (s0^2 - sr^2), with s0^2 = p (1 - p) and sr^2 = s0^2 / n (Lacey 1954, J. Appl. Chem. 4: 257-268); cells are
    weighted with their number of grains, n is its weighted mean.
    """
    cells = {}
    for point, kind in zip(points, kinds):
        cell = cells.setdefault(tuple(math.floor(c / side) for c in point), [0, 0])
        cell[0] += 1
        cell[1] += kind
    used = [(n, k / n) for n, k in cells.values() if n >= least]
    total = sum(n for n, _ in used)
    p = sum(n * share for n, share in used) / total
    variance = sum(n * (share - p) ** 2 for n, share in used) / total
    apart = p * (1 - p)
    mixed = apart * len(used) / total
    return (apart - variance) / (apart - mixed)


def connected(points, reach, is_start):
    """The points that a chain of points, each nearer than `reach` to the next, ties to those where `is_start` holds."""
    cells = {}
    for i, p in enumerate(points):
        cells.setdefault(tuple(math.floor(c / reach) for c in p), []).append(i)
    around = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    found = {i for i, p in enumerate(points) if is_start(p)}
    ahead = list(found)
    while ahead:
        p = points[ahead.pop()]
        cell = [math.floor(c / reach) for c in p]
        for step in around:
            for i in cells.get(tuple(c + s for c, s in zip(cell, step)), ()):
                if i not in found and math.dist(p, points[i]) < reach:
                    found.add(i)
                    ahead.append(i)
    return [points[i] for i in found]
