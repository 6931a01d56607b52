"""The grains of the comparison: bed files, a loose filling of the drum, and overlaps of positions. Standard library only."""

import math
import random

# All numbers SI. Both programs get the same.
DENSITY = 1000.0
FRICTION = 0.5
GRAVITY = 9.81


class Drum:
    """Axis z, gravity along -y. A bit less than half full of `count` grains of 5 mm; all sizes have the same Froude number."""

    def __init__(self, count):
        scale = (count / 8000) ** (1 / 3)
        self.radius, self.length = 0.15 * scale, 0.22 * scale
        self.speed = 2 * math.pi * 20 / 60 / math.sqrt(scale)  # [rad/s]; 20 rpm for 8000


def read_bed(path):
    """Rows [x, y, z, radius, vx, vy, vz], and the side of the box."""
    lines = path.read_text().split("\n")
    side = float(lines[0].split()[1])
    return [list(map(float, line.split())) for line in lines[1:] if line.strip()], side


def write_bed(path, rows, side):
    path.write_text(f"{len(rows)} {side!r}\n" + "\n".join(" ".join(map(repr, row)) for row in rows) + "\n")


def loose_filling(radii, drum):
    """Grains of these radii in the drum, none touching another, layer by layer from below."""
    pitch = 2.02 * max(radii)
    inner = drum.radius - 0.51 * pitch
    columns = int((drum.length - 0.02 * pitch) / pitch)
    rows, left = [], list(radii)
    random.Random(1).shuffle(left)
    for level in range(int(2 * inner / pitch) + 1):
        y = -inner + level * pitch
        half = math.sqrt(max(0.0, inner * inner - y * y))
        for i in range(int(2 * half / pitch) + 1):
            for k in range(columns):
                if not left:
                    return rows
                z = (k - 0.5 * (columns - 1)) * pitch
                rows.append([-half + i * pitch, y, z, left.pop(), 0.0, 0.0, 0.0])
    raise ValueError(f"{len(left)} grains find no room in the drum")


def overlaps(rows):
    """Overlap of every pair of grains that overlaps, over the smaller radius."""
    cell = 2 * max(row[3] for row in rows)
    grid = {}
    for i, row in enumerate(rows):
        grid.setdefault(tuple(int(row[k] // cell) for k in range(3)), []).append(i)
    near = [(a, b, c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]
    found = []
    for i, (x, y, z, r, *_) in enumerate(rows):
        at = (int(x // cell), int(y // cell), int(z // cell))
        for shift in near:
            for j in grid.get((at[0] + shift[0], at[1] + shift[1], at[2] + shift[2]), ()):
                if j <= i:
                    continue
                other = rows[j]
                reach = r + other[3]
                square = (x - other[0]) ** 2 + (y - other[1]) ** 2 + (z - other[2]) ** 2
                if square < reach * reach:
                    found.append((reach - math.sqrt(square)) / min(r, other[3]))
    return found


def motion(rows):
    """Kinetic energy of translation [J], and the height of the centre of mass along gravity's axis [m] as a list x, y, z."""
    mass = [4 / 3 * math.pi * DENSITY * row[3] ** 3 for row in rows]
    total = sum(mass)
    energy = sum(0.5 * m * sum(v * v for v in row[4:7]) for m, row in zip(mass, rows))
    return energy, [sum(m * row[k] for m, row in zip(mass, rows)) / total for k in range(3)]
