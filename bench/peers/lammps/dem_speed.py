#!/usr/bin/env python3
"""Particle-steps per second of scree's dem and of LAMMPS' gran/hooke/history on settled beds: the same law, step and cores.

    bench/peers/lammps/dem_speed.py PROGRAM FOLDER [BED ...] [--cores 1,2] [--pairs N] [--seconds T] [--lammps PROGRAM] [--prefix COMMAND]

A BED is a file as the source `bed` reads it; without one, a bed of 8000 is settled with scree. The two run by turns, N pairs; what is
compared is the median of the N ratios. scree's time is the sum of all phases of all outer steps but the first, LAMMPS' its loop time
after as many steps: neither starting up nor the first search for neighbours counts. Processor time beside it, which a busy machine
spoils less: the loop's or the steps' share of what the process took. Prints a table and writes dem_speed.csv into FOLDER.
Needs Debian's lammps; otherwise the standard library only.
"""

import csv
import os
import pathlib
import re
import shlex
import statistics
import sys

import contest_arguments
import grains
from dem_side import options
from lammps_side import Lammps, Law, STIFFNESS, TIME_STEP
from scree_side import Scree, read_steps

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scaling"))
import scaling  # noqa: E402

OUTER = 1e-3  # step of scree's log and reports [s]; a whole number of TIME_STEP


class Contest:
    """One bed on so many cores."""

    def __init__(self, wanted, bed, cores):
        self.rows, side = grains.read_bed(bed)
        self.seconds, self.cores = wanted.seconds, cores
        folder, prefix = wanted.folder.resolve() / f"{bed.stem}_{cores}", shlex.split(wanted.prefix)
        self.skin = wanted.skin or 0.2 * min(row[3] for row in self.rows)  # scree's own choice
        self.scree = Scree(wanted.program, folder, "bed", bed, cores, options(TIME_STEP, OUTER, wanted.skin, prefix))
        self.lammps = Lammps(wanted.peer, folder, "bed", self.rows, side, cores, prefix, Law(skin=self.skin))

    def particle_steps(self, seconds):
        return len(self.rows) * round(seconds / TIME_STEP)

    def run_scree(self):
        out = self.scree.run("scree_speed", OUTER + self.seconds, [], self.scree.prefix)
        steps = read_steps(out)
        phases = [values for key, values in steps.items() if key.startswith("seconds_")]
        wall = [sum(values) for values in zip(*phases)]
        share = self.scree.processor_time / self.scree.wall_time
        return {"rate": self.particle_steps(self.seconds) / sum(wall[1:]),
                "processor": self.particle_steps(self.seconds) / (sum(wall[1:]) * min(share, self.cores)),
                "memory": self.scree.peak_memory, "contacts": steps["contacts"][-1], "energy": steps["kinetic_energy"][-1]}

    def run_lammps(self):
        first, steps = round(OUTER / TIME_STEP), round(self.seconds / TIME_STEP)
        out = self.lammps.run("lammps_speed", self.lammps.script(True, steps, f"run {first}\nrun {steps}\n"), self.cores)
        loop = float(re.findall(r"Loop time of (\S+)", out)[-1])
        share = float(re.findall(r"([\d.]+)% CPU use", out)[-1]) / 100 * self.cores
        energies = [float(a) + float(b) for a, b in re.findall(rf"^ *\d+ +{len(self.rows)} +(\S+) +(\S+) *$", out, re.M)]
        allocated = re.findall(r"memory allocation \(min/avg/max\) = \S+ \| (\S+) \|", out)
        return {"rate": self.particle_steps(self.seconds) / loop, "processor": self.particle_steps(self.seconds) / (loop * share),
                "memory": self.lammps.peak_memory * self.cores, "allocated": float(allocated[-1]) * 1e6 * self.cores,
                "neighbours": float(re.findall(r"Total # of neighbors = (\S+)", out)[-1]),
                "builds": float(re.findall(r"Neighbor list builds = (\S+)", out)[-1]), "energy": energies[-1]}


def compare(wanted, bed, cores):
    contest = Contest(wanted, bed, cores)
    pairs = [(contest.run_scree(), contest.run_lammps()) for _ in range(wanted.pairs)]
    middle = {name: statistics.median(ours[name] / theirs[name] for ours, theirs in pairs) for name in ("rate", "processor")}
    rates = [[run["rate"] / 1e6 for run in side] for side in zip(*pairs)]
    ours, theirs = pairs[-1]
    return {"bed": bed.stem, "grains": len(contest.rows), "cores": cores,
            "scree [1e6/s]": f"{statistics.median(rates[0]):.2f}", "best": f"{max(rates[0]):.2f}",
            "LAMMPS [1e6/s]": f"{statistics.median(rates[1]):.2f}", "its best": f"{max(rates[1]):.2f}",
            "ratio": f"{middle['rate']:.2f}", "by processor time": f"{middle['processor']:.2f}",
            "memory, scree [MB]": f"{ours['memory'] / 1e6:.0f}", "LAMMPS": f"{theirs['memory'] / 1e6:.0f}",
            "allocated": f"{theirs['allocated'] / 1e6:.0f}", "contacts": f"{ours['contacts']:.0f}",
            "LAMMPS' neighbours": f"{theirs['neighbours']:.0f}", "its searches": f"{theirs['builds']:.0f}",
            "skin [mm]": f"{1e3 * contest.skin:.2f}", "kinetic energy, scree, LAMMPS [J]": f"{ours['energy']:.2e}, {theirs['energy']:.2e}"}


def main():
    parser = contest_arguments.parser(__doc__, "lammps", "lmp", beds="*", pairs=5)
    parser.add_argument("--seconds", type=float, default=0.02, help="simulated while the clock runs [s]")
    parser.add_argument("--skin", type=float, default=0.0, help="of both neighbour lists [m]; 0: scree's own, for both")
    wanted = parser.parse_args()
    if contest_arguments.is_missing(wanted.peer, "lammps"):
        return 77
    wanted.folder.mkdir(parents=True, exist_ok=True)
    beds = [bed.resolve() for bed in wanted.beds] or [scaling.make_tile(wanted.program, wanted.folder.resolve())]
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; {STIFFNESS:g} N/m, {TIME_STEP:g} s, {wanted.pairs} pairs\n", flush=True)
    results = []
    for bed in beds:
        for cores in wanted.cores:
            results.append(compare(wanted, bed, cores))
            if len(results) == 1:
                print("| " + " | ".join(results[0]) + " |\n|" + "---|" * len(results[0]))
            print("| " + " | ".join(str(value) for value in results[-1].values()) + " |", flush=True)
            with open(wanted.folder / "dem_speed.csv", "w", newline="") as file:
                writer = csv.DictWriter(file, results[0].keys())
                writer.writeheader()
                writer.writerows(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
