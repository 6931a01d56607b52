#!/usr/bin/env python3
"""Particle-steps per second of scree's dem and of Yade on settled beds: the same law, step and cores.

    bench/peers/yade/dem_speed.py PROGRAM FOLDER BED ... [--cores 1,2] [--pairs N] [--steps N] [--yade PROGRAM] [--prefix COMMAND]

The two run by turns, N pairs; what is compared is the median of the N ratios. scree's time is the sum of all phases of all outer steps but
the first, Yade's that of as many steps after 25. The kinetic energies at the end tell whether both simulate the same. Prints a table.
Needs Debian's yade; otherwise the standard library only.
"""

import pathlib
import re
import shlex
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "lammps"))

import contest_arguments  # noqa: E402
import grains  # noqa: E402
from dem_side import options  # noqa: E402
from lammps_side import TIME_STEP  # noqa: E402
from scree_side import Scree, read_steps  # noqa: E402

OUTER = 1e-3  # step of scree's log and reports [s]
HEADER = ("bed", "cores", "scree [1e6/s]", "Yade [1e6/s]", "ratio", "contacts", "kinetic energy [J]")


def run_scree(wanted, bed, cores):
    scree = Scree(wanted.program, wanted.folder.resolve() / f"{bed.stem}_{cores}", "bed", bed, cores,
                  options(TIME_STEP, OUTER, 0.0, shlex.split(wanted.prefix)))
    steps = read_steps(scree.run("scree_speed", OUTER + wanted.steps * TIME_STEP, [], scree.prefix))
    wall = sum(sum(values[1:]) for key, values in steps.items() if key.startswith("seconds_"))
    return wall, steps["contacts"][-1], steps["kinetic_energy"][-1]


def run_yade(wanted, bed, cores):
    skin = 0.2 * min(row[3] for row in grains.read_bed(bed)[0])  # scree's own choice
    script = pathlib.Path(__file__).resolve().parent / "bed.py"
    out = subprocess.run([*shlex.split(wanted.prefix), wanted.peer, "-n", "-x", "-j", str(cores), str(script), str(bed), repr(TIME_STEP),
                          str(wanted.steps), str(round(OUTER / TIME_STEP)), repr(skin)],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False).stdout
    found = re.search(r"seconds (\S+) energy (\S+) contacts (\d+)", out)
    if not found:
        raise RuntimeError(f"yade failed:\n{out}")
    return float(found[1]), int(found[3]), float(found[2])


def compare(wanted, bed, cores):
    work = len(grains.read_bed(bed)[0]) * wanted.steps / 1e6
    pairs = [(run_scree(wanted, bed, cores), run_yade(wanted, bed, cores)) for _ in range(wanted.pairs)]
    ours, theirs = pairs[-1]
    rates = [statistics.median(work / side[0] for side in sides) for sides in zip(*pairs)]
    ratio = statistics.median(b[0] / a[0] for a, b in pairs)
    return (bed.stem, cores, f"{rates[0]:.2f}", f"{rates[1]:.2f}", f"{ratio:.1f}", f"{ours[1]:.0f}, {theirs[1]}",
            f"{ours[2]:.2e}, {theirs[2]:.2e}")


def main():
    parser = contest_arguments.parser(__doc__, "yade", "yade", beds="+", pairs=3)
    parser.add_argument("--steps", type=int, default=500, help="of %g s, while the clock runs; a multiple of %d" %
                        (TIME_STEP, round(OUTER / TIME_STEP)))
    wanted = parser.parse_args()
    if contest_arguments.is_missing(wanted.peer, "yade"):
        return 77
    print("| " + " | ".join(HEADER) + " |\n|" + "---|" * len(HEADER))
    for bed in wanted.beds:
        for cores in wanted.cores:
            print("| " + " | ".join(map(str, compare(wanted, bed.resolve(), cores))) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
