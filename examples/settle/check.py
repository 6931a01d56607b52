"""A bed at rest weighs on its floor: the normal impulses of a step sum up to M g h, whatever the packing."""

import math
import random

from checking import Check

G, STEP, DENSITY, TOLERANCE = 9.81, 1e-3, 2500.0, 1e-5
LAYERS = 10  # of grains above each other


def floor_impulses(run, since):
    """Sum of the vertical impulses on what touches the floor, by time [N s]."""
    contacts = run.table("contacts.csv")
    sums = {}
    for time, body, impulse in zip(contacts["time"], contacts["body_a"], contacts["impulse_z"]):
        if body == 0 and time >= since:
            sums[time] = sums.get(time, 0.0) + impulse
    return list(sums.values())


def check_rest(check, what, run, mass, count, left):
    steps = run.table("steps.csv")
    rest = 0.9 * steps["time"][-1]
    # The solver stops when every contact is right to 0.01 mm/s, so that a bed of LAYERS may move as a whole by LAYERS times
    # that, where gravity makes g h = 9.8 mm/s: 1 % in a step. In the mean these errors cancel; what is left is the momentum
    # of the few grains that still roll.
    sums = floor_impulses(run, rest)
    weight = mass * G * STEP
    check.holds(f"{what}: in every step the floor carries M g h, to 1 %",
                sums and all(abs(s - weight) <= LAYERS * TOLERANCE / (G * STEP) * weight for s in sums),
                f"{min(sums):.6g} to {max(sums):.6g} N s, expected {weight:.6g}")
    check.near(f"{what}: on average it carries M g h, to 0.5 %", sum(sums) / len(sums), weight, 5e-3 * weight)
    # Without rolling friction a few grains roll on for long.
    energy = steps["kinetic_energy"]
    check.holds(f"{what}: it comes to rest: {left:g} of its greatest kinetic energy are left",
                energy[-1] <= left * max(energy), f"from {max(energy):.3g} to {energy[-1]:.3g} J")
    settled = [p for t, p in zip(steps["time"], steps["mean_penetration"]) if t >= rest]
    check.holds(f"{what}: mean penetration at rest at most 0.5 % of the radius", max(settled) <= 5e-3,
                f"{max(settled):.2g}")
    check.holds(f"{what}: every body is accounted for", all(n == count for n in steps["bodies"]), f"{count} bodies")


def write_bed(path, count, side):
    """Spheres on a loose lattice, above each other. Returns their mass [kg]."""
    draw = random.Random(3)
    across = int(side / 6.2e-3)
    mass = 0.0
    rows = []
    for i in range(count):
        r = draw.uniform(2e-3, 3e-3)
        x, y = ((k + 0.5) * side / across - side / 2 for k in (i % across, i // across % across))
        z = (i // across**2 + 0.5) * 6.2e-3
        rows.append(f"{x:.17g} {y:.17g} {z:.17g} {r:.17g} {draw.uniform(-0.1, 0.1):.17g} 0 -0.1")
        mass += DENSITY * 4 / 3 * math.pi * r**3
    path.write_text(f"{count} {side}\n" + "\n".join(rows) + "\n")
    return mass


def wide_box(side):
    """Settings for a box of another side [m]: its four walls, and where the spheres start."""
    half = side / 2
    walls = {"left": (-half, 0, 0), "right": (half, 0, 0), "front": (0, -half, 0), "back": (0, half, 0)}
    moved = {f"body__{name}__position": list(place) for name, place in walls.items()}
    return moved | {"source__fill__lower": [-half, -half, 0], "source__fill__upper": [half, half, 1]}


with Check(__file__) as check:
    # Eight times the spheres on eight times the floor: a bed as deep, at rest as soon.
    count = 8000 if check.full else 1000
    run = check.run("fill", source__fill__count=count, **(wide_box(0.05 * math.sqrt(8)) if check.full else {}))
    fed = run.table("steps.csv")["bodies"][0]
    check.holds("fill: all spheres are there from the first step", fed == count, f"{fed:g}")
    fed = next(table for table in run.json["tables"] if table["title"] == "particles by material")
    mass = float(fed["rows"][0][fed["header"].index("fed [kg]")])
    # The mean cube of a diameter uniform in 4 to 6 mm is (6^4 - 4^4) / (4 * 2) mm3; 1000 of them meet it to 1.1 %, and
    # more of them better.
    expected = count * DENSITY * math.pi / 6 * (6e-3**4 - 4e-3**4) / (4 * 2e-3)
    check.near("fill: the mass of the bed, to four deviations of the size law", mass, expected, 0.045 * expected)
    check_rest(check, "fill", run, mass, count, left=1e-4)

    bed = check.folder / "bed.txt"
    check.folder.mkdir(parents=True, exist_ok=True)
    mass = write_bed(bed, 400, 0.05)
    run = check.run("bed", scene=check.scene.parent / "settle_bed.toml", source__bed__file=bed.resolve())
    # The energy of a single grain at 4 cm/s is 1e-4 of the greatest of these 400, and nothing stops one that rolls.
    check_rest(check, "bed", run, mass, 400, left=1e-3)
