#!/usr/bin/env python3
"""Whole steps of scree's dvi at 1 ms beside LAMMPS' spring and dashpot at 40 us, on the same grains and the same cores.

    bench/peers/lammps/headline.py PROGRAM FOLDER [--bed FILE] [--lammps PROGRAM] [--seconds T] [--prefix COMMAND]

Scenes: a settled bed in a box, and the same grains in a rotating drum, already turning when the clock starts. Each program
first brings each scene to its own steady state, nobody timing it; then both are timed by turns, on one core and on two.
Prints tables and writes headline.csv into FOLDER. Needs Debian's lammps; otherwise the standard library only.
"""

import argparse
import csv
import os
import pathlib
import shlex
import sys

import grains
from lammps_side import Lammps, STIFFNESS, TIME_STEP
from scree_side import Scree, read_particles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scaling"))
import scaling  # noqa: E402

# The residual that a step reaches is part of the result. Undoing overlap faster than this keeps a deep bed from coming to
# rest: every layer adds its own speed to that of the layers below.
RECOVERY = 0.005  # [m/s]
SOLVER = """type = "asgs"
tolerance = 1e-3
max_iterations = {iterations}
active_set = false
check_interval = {iterations}
"""


def solver(iterations):
    return SOLVER.format(iterations=iterations)


def make_drum(wanted, folder, rows):
    """The bed's grains in the drum after two seconds of turning, as a bed file."""
    path = folder / "drum.txt"
    if not path.exists():
        loose = folder / "loose.txt"
        drum = grains.Drum(len(rows))
        grains.write_bed(loose, grains.loose_filling([row[3] for row in rows], drum), 2 * drum.radius)
        options = {"prefix": [], "recovery": 0.05, "solver": solver(40)}
        scree = Scree(wanted.program, folder, "drum", loose, 1, options)
        out = scree.run("drum_filling", 2.0, [], interval=2.0)
        grains.write_bed(path, read_particles(sorted(out.glob("particles_*.vtp"))[-1]), 2 * drum.radius)
    return path


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else 0.0


def judge(frames):
    """Mean and greatest overlap over the radius, and the kinetic energy [J]: means over frames."""
    found = [grains.overlaps(rows) for rows in frames]
    return (mean(mean(one) for one in found), max(max(one, default=0.0) for one in found),
            mean(grains.motion(rows)[0] for rows in frames))


def compare(wanted, folder, scene, bed):
    rows, side = grains.read_bed(bed)
    prefix = shlex.split(wanted.prefix)
    contestants = []
    for cores in wanted.cores:
        options = {"prefix": prefix, "recovery": RECOVERY, "solver": solver(wanted.iterations)}
        contestants.append((Scree(wanted.program, folder / f"{scene}_{cores}", scene, bed, cores, options),
                            Lammps(wanted.lammps, folder / f"{scene}_{cores}", scene, rows, side, cores, prefix)))
        contestants[-1][0].start(wanted.warm_up)
        if len(contestants) == 1:
            contestants[0][1].start(wanted.warm_up)  # its restart file serves any number of cores
        else:
            contestants[-1][1].warm = contestants[0][1].warm
    results = []
    for cores, (scree, lammps) in zip(wanted.cores, contestants):
        ours, theirs = [], []
        for _ in range(wanted.repeats):
            ours.append(scree.measure(wanted.warm_up, wanted.seconds))
            theirs.append(lammps.measure(wanted.seconds))
        results += [row_of(scene, cores, "scree dvi", ours, scree.frames(wanted.warm_up, wanted.seconds)),
                    row_of(scene, cores, "LAMMPS", theirs, theirs[-1]["frames"])]
    return results


def row_of(scene, cores, name, runs, frames):
    overlap, most, energy = judge(frames)
    walls = sorted(run["wall"] for run in runs)
    row = {"scene": scene, "cores": cores, "program": name, "wall s per simulated s": round(walls[len(walls) // 2], 1),
           "least": round(walls[0], 1), "mean overlap / r": f"{overlap:.2%}", "greatest": f"{most:.1%}",
           "kinetic energy [J]": f"{energy:.3g}"}
    column = runs[-1].get("columns")
    for title, key, pick in (("iterations a step", "iterations", mean), ("residual, mean [m/s]", "residual", mean),
                             ("residual, greatest", "residual", max), ("contacts", "contacts", mean)):
        row[title] = f"{pick(column[key]):.3g}" if column else ""
    phases = runs[-1].get("phases", {})
    row["collision, solver, rest [ms a step]"] = ", ".join(
        f"{value:.1f}" for value in (phases["collision"], phases["solver"], sum(phases.values()) - phases["collision"] -
                                     phases["solver"])) if phases else ""
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="the scree program")
    parser.add_argument("folder", type=pathlib.Path, help="for beds, runs and tables")
    parser.add_argument("--bed", type=pathlib.Path, help="settled bed; made with examples/settle if left out")
    parser.add_argument("--lammps", default="lmp", help="the LAMMPS program")
    parser.add_argument("--warm-up", type=float, default=0.3, help="simulated before the clock starts [s]")
    parser.add_argument("--seconds", type=float, default=0.2, help="simulated while the clock runs [s]")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--iterations", type=int, default=20, help="of scree's solver, at most, in a step")
    parser.add_argument("--cores", type=lambda text: [int(n) for n in text.split(",")], default=[1, 2])
    parser.add_argument("--scenes", type=lambda text: text.split(","), default=["bed", "drum"])
    parser.add_argument("--prefix", default="", help="command put before what is timed, for example one that quiets the machine")
    wanted = parser.parse_args()
    folder = wanted.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    bed = wanted.bed.resolve() if wanted.bed else scaling.make_tile(wanted.program, folder)
    beds = {"bed": bed, "drum": make_drum(wanted, folder, grains.read_bed(bed)[0])}
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; LAMMPS: {STIFFNESS} N/m, {TIME_STEP} s; "
          f"scree: 1 ms, overlap undone at {RECOVERY} m/s\n", flush=True)
    results = []
    for scene in wanted.scenes:
        results += compare(wanted, folder, scene, beds[scene])
        with open(folder / "headline.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, results[0].keys())
            writer.writeheader()
            writer.writerows(results)
    print("| " + " | ".join(results[0]) + " |\n|" + "---|" * len(results[0]))
    for row in results:
        print("| " + " | ".join(str(value) for value in row.values()) + " |")


if __name__ == "__main__":
    main()
