#!/usr/bin/env python3
"""scree's dem and LAMMPS' gran/hooke/history: the same law, the same grains, the same numbers?

    bench/peers/lammps/dem_check.py PROGRAM FOLDER [--lammps PROGRAM] [--seeds N] [--count N] [--scenes impacts,phases,settling,drum] [--keep]

impacts: single oblique impacts of two grains, and of a grain on a floor: velocities and spins after them, one by one.
phases: restitution at the step that settling and drum have, by where in a step the surfaces meet: each program's own error.
settling: grains fall into a box. drum: a drum turns from the first moment on. Five seeds each; what is compared are means over
seeds, since grains in contact are chaotic: mean height, coordination number, and how kinetic energy goes.
Prints tables, writes dem_check.csv and one picture of the settling into FOLDER. Returns 0 if all differences are within 5 % (impacts:
0.5 % of the speed), 1 if not, 77 where LAMMPS is not installed. Needs Debian's lammps; otherwise the standard library only.
"""

import argparse
import csv
import math
import pathlib
import random
import shutil
import statistics
import sys

import decay_plot
import grains
from dem_side import law_of, of_lammps, of_scree, options
from lammps_side import Lammps, RESTITUTION, TIME_STEP
from scree_side import Scree

RADIUS = 5e-3       # [m]
SIDE = 0.12         # of the box [m]
LIMIT = 0.05        # of a mean over seeds
IMPACT_LIMIT = 5e-3  # of the speed of an impact
IMPACT_STEP = 1e-6  # [s]: both schemes' own errors are far below the limit
PARTS = (0.5, 0.1, 0.01, 0.001)  # of the greatest kinetic energy


def scattered(count, seed):
    """Grains above the floor, none touching another, with small random velocities."""
    rng, pitch = random.Random(seed), 2.4 * RADIUS
    across = int(SIDE / pitch)
    rows = []
    for i in range(count):
        level, rest = divmod(i, across * across)
        at = [(rest % across + 0.5) * pitch - SIDE / 2, (rest // across + 0.5) * pitch - SIDE / 2, (level + 0.5) * pitch]
        rows.append([x + rng.uniform(-0.19, 0.19) * RADIUS for x in at] + [RADIUS] + [rng.uniform(-0.2, 0.2) for _ in range(3)])
    return rows


def in_the_drum(count, seed):
    rng = random.Random(seed)
    rows = grains.loose_filling([RADIUS] * count, grains.Drum(count))
    return [row[:4] + [rng.uniform(-0.1, 0.1) for _ in range(3)] for row in rows]


def impacts():
    """A grain hits one at rest at 1 m/s under eight angles; beside them, a grain hits the floor."""
    rows, speed = [], 1.0
    for i in range(8):
        angle = math.radians(10 * i)
        x, v = 0.05 * i - 0.175, [speed * math.sin(angle), 0.0, -speed * math.cos(angle)]
        rows += [[x, -0.05, 0.1, RADIUS, 0, 0, 0], [x, -0.05, 0.1 + 2 * RADIUS + 1e-9, RADIUS, *v],
                 [x, 0.05, RADIUS + 1e-9, RADIUS, *v]]
    return rows, 0.4


def two(wanted, folder, scene, rows, side, step, outer=1e-3):
    """Both contestants on the same grains."""
    folder.mkdir(parents=True, exist_ok=True)
    bed = folder / "bed.txt"
    grains.write_bed(bed, rows, side)
    kind = "drum" if scene == "drum" else "bed"
    return {"scree": Scree(wanted.program, folder, kind, bed, 1, options(step, outer)),
            "LAMMPS": Lammps(wanted.lammps, folder, kind, rows, side, 1, [], law_of(RADIUS, step=step))}


def record(wanted, pair, seconds, since, interval):
    return {"scree": of_scree(pair["scree"], seconds, since, interval, wanted.keep),
            "LAMMPS": of_lammps(pair["LAMMPS"], seconds, since, interval, wanted.keep)}


def check_impacts(wanted, folder):
    """The largest difference of a surface speed after an impact."""
    rows, side = impacts()
    pair = two(wanted, folder / "impacts", "impacts", rows, side, IMPACT_STEP)
    found = record(wanted, pair, 4e-3, 4e-3, 4e-3)
    ours, theirs = found["scree"].frames[-1], found["LAMMPS"].frames[-1]
    table, worst = [], 0.0
    for i in range(8):
        for body, what in ((3 * i + 1, "grain"), (3 * i + 2, "floor")):
            a, b = ([*row[4:7], *(RADIUS * w for w in row[7:10])] for row in (ours[body], theirs[body]))
            difference = max(abs(x - y) for x, y in zip(a, b))
            worst = max(worst, difference)
            table.append({"scene": "impact", "figure": f"{10 * i} degrees on {what}: speed along, away, R w [m/s]",
                          "scree": " ".join(f"{a[k]:.4f}" for k in (0, 2, 4)), "LAMMPS": " ".join(f"{b[k]:.4f}" for k in (0, 2, 4)),
                          "difference": f"{difference:.2%}"})
    return table, worst <= IMPACT_LIMIT


def check_phases(wanted, folder):
    """Restitution at the step of the other scenes, by where in a step the surfaces meet: each scheme's own error, no criterion."""
    rows, count = [], 16
    for i in range(count):
        x, gap = 0.03 * i - 0.225, i / count * TIME_STEP + 1e-9
        rows += [[x, 0.0, 0.1, RADIUS, 0, 0, 0], [x, 0.0, 0.1 + 2 * RADIUS + gap, RADIUS, 0, 0, -1.0]]
    found = record(wanted, two(wanted, folder / "phases", "phases", rows, 0.5, TIME_STEP), 4e-3, 4e-3, 4e-3)
    row = {"scene": "impact", "figure": f"restitution at {1e6 * TIME_STEP:g} us, {count} phases; {RESTITUTION} exactly"}
    means = {}
    for name, one in found.items():
        values = [one.frames[-1][2 * i + 1][6] - one.frames[-1][2 * i][6] for i in range(count)]
        means[name] = statistics.mean(values)
        row[name] = f"{means[name]:.4f}, {min(values):.4f} to {max(values):.4f}"
    return [row | {"difference": f"{means['scree'] / means['LAMMPS'] - 1:+.2%}"}], True


def coordination(frame):
    return 2 * len(grains.overlaps([row[:7] for row in frame])) / len(frame)


def time_below(record, part):
    """When kinetic energy falls for the first time below this part of its greatest value, after that [s]."""
    top = max(record.energies)
    at = record.energies.index(top)
    for i in range(at, len(record.energies)):
        if record.energies[i] < part * top:
            a, b = record.energies[i - 1], record.energies[i]
            share = math.log(a / (part * top)) / math.log(a / b)
            return record.times[i - 1] + share * (record.times[i] - record.times[i - 1])
    return math.nan


def settling_figures(found):
    last = found.frames[-5:]
    figures = {"mean height [mm]": 1e3 * statistics.mean(grains.motion(frame)[1][2] for frame in last),
               "coordination number": statistics.mean(map(coordination, last)),
               "greatest kinetic energy [mJ]": 1e3 * max(found.energies)}
    figures["its integral over time [mJ s]"] = sum(found.energies) * 1e3 * (found.times[-1] - found.times[-2])
    figures.update({f"below {part:g} of the greatest after [ms]": 1e3 * time_below(found, part) for part in PARTS})
    figures["from a half to a hundredth in [ms]"] = 1e3 * (time_below(found, 0.01) - time_below(found, 0.5))
    return figures


def drum_figures(found, drum, since):
    height = [grains.motion(frame)[1][1] + drum.radius for frame in found.frames]
    centre = [grains.motion(frame)[1] for frame in found.frames]
    energies = [e for time, e in zip(found.times, found.energies) if time > since]
    return {"mean height above the lowest line [mm]": 1e3 * statistics.mean(height),
            "coordination number": statistics.mean(map(coordination, found.frames[::4])),
            "kinetic energy [mJ]": 1e3 * statistics.mean(energies),
            "slope of the line to the centre of mass [degrees]":
                statistics.mean(math.degrees(math.atan2(abs(x), -y)) for x, y, _ in centre)}


def compare(scene, figures):
    """Rows of the table, from lists of figures of each program, one for each seed."""
    table, good = [], True
    for name in figures["scree"][0]:
        ours, theirs = ([one[name] for one in figures[side]] for side in ("scree", "LAMMPS"))
        mean, other = statistics.mean(ours), statistics.mean(theirs)
        spread = [statistics.stdev(values) if len(values) > 1 else 0.0 for values in (ours, theirs)]
        error = math.hypot(*spread) / math.sqrt(len(ours)) / abs(other)
        good = good and abs(mean / other - 1) <= LIMIT
        table.append({"scene": scene, "figure": name, "scree": f"{mean:.4g} +- {spread[0]:.2g}",
                      "LAMMPS": f"{other:.4g} +- {spread[1]:.2g}",
                      "difference": f"{mean / other - 1:+.2%} +- {error:.2%}"})
    return table, good


def check_settling(wanted, folder):
    figures, curves = {"scree": [], "LAMMPS": []}, {"scree": [], "LAMMPS": []}
    for seed in range(1, wanted.seeds + 1):
        pair = two(wanted, folder / f"settling_{seed}", "settling", scattered(wanted.count, seed), SIDE, TIME_STEP)
        for name, found in record(wanted, pair, 0.5, 0.42, 0.02).items():
            figures[name].append(settling_figures(found))
            curves[name].append((found.times, found.energies))
    decay_plot.draw(folder / "settling.svg", f"{wanted.count} grains fall into a box, {wanted.seeds} seeds", curves)
    return compare("settling", figures)


def check_drum(wanted, folder):
    figures, since, end = {"scree": [], "LAMMPS": []}, 0.6, 1.2
    for seed in range(1, wanted.seeds + 1):
        pair = two(wanted, folder / f"drum_{seed}", "drum", in_the_drum(wanted.count, seed),
                   2 * grains.Drum(wanted.count).radius, TIME_STEP)
        for name, found in record(wanted, pair, end, since, 0.025).items():
            figures[name].append(drum_figures(found, grains.Drum(wanted.count), since))
    return compare("drum", figures)


CHECKS = {"impacts": check_impacts, "phases": check_phases, "settling": check_settling, "drum": check_drum}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="the scree program")
    parser.add_argument("folder", type=pathlib.Path, help="for runs and tables")
    parser.add_argument("--lammps", default="lmp", help="the LAMMPS program")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--count", type=int, default=2000, help="grains")
    parser.add_argument("--keep", action="store_true", help="take runs that are in FOLDER already")
    parser.add_argument("--scenes", type=lambda text: text.split(","), default=list(CHECKS))
    wanted = parser.parse_args()
    if not shutil.which(wanted.lammps):
        print(f"{wanted.lammps} is not installed: skipped (Debian's lammps has it)")
        return 77
    print("yade is " + ("installed, but this script has no scenes for it" if shutil.which("yade") else "not installed") +
          ": skipped\n")
    folder = wanted.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    table, good = [], True
    print("| scene | figure | scree | LAMMPS | difference |\n|---|---|---|---|---|")
    for scene in wanted.scenes:
        rows, agrees = CHECKS[scene](wanted, folder)
        table, good = table + rows, good and agrees
        for row in rows:
            print("| " + " | ".join(row.values()) + " |", flush=True)
        with open(folder / "dem_check.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, table[0].keys())
            writer.writeheader()
            writer.writerows(table)
    print("\n" + ("All agree." if good else "They differ."))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
