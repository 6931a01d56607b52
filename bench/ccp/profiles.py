#!/usr/bin/env python3
"""Performance profiles of contact solvers (Dolan & More 2002, Math. Program. 91:201).

    bench/ccp/profiles.py PROGRAM FOLDER [--bed FILE]... [--peer NAME=PROGRAM]... [--solvers a,b] [--scenes a,b]

Every scene runs once, and leaves the contact problems of up to five of its steps. Every solver gets each of them, cold, for
each tolerance: `scree solve`, one thread, in turns, so that a busy machine troubles all alike. A problem counts as solved
when scree's judge finds a residual within the tolerance, within the time limit. The profile of a solver is the share of all
problems that it solves within a factor of the time of the fastest. Writes profiles.csv, a plot for each tolerance, and
prints a table. A peer is a program with the options and the JSON of `scree solve`; those that lie beside PROGRAM (Bullet's,
and Siconos' where it is installed) join by themselves: those that solve the same model of friction. Scenes take turns, so that a
budget cuts all of them alike. Standard library only.
"""

import argparse
import csv
import itertools
import json
import os
import pathlib
import platform
import resource
import subprocess
import sys
import time

import profile_plot

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "examples"
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8)  # [m/s]
SCENES = {  # scene and the times [s] of its problems
    "settling": (HERE / "scenes/settling.toml", (0.1, 0.2, 0.3, 0.4, 0.5)),
    "drum": (HERE / "scenes/drum.toml", (0.2, 0.3, 0.4, 0.5, 0.6)),
    "mass_ratio": (HERE / "scenes/mass_ratio.toml", (0.1, 0.15, 0.2, 0.25, 0.3)),
    "rolling": (HERE / "scenes/rolling.toml", (0.1, 0.2, 0.3, 0.4)),
    "shavings": (HERE / "scenes/shavings.toml", (0.1, 0.15, 0.2, 0.25, 0.3)),
    "wedge": (HERE / "scenes/wedge.toml", (0.1, 0.15, 0.2, 0.25, 0.3)),
    "column": (HERE / "scenes/column.toml", (0.001, 0.005, 0.02)),
    "separator": (EXAMPLES / "ces_separator/scene.toml", (0.2, 0.3, 0.4, 0.5)),
    "pile": (EXAMPLES / "sphere_pile/scene.toml", (0.05, 0.2)),
    "sliding_block": (EXAMPLES / "sliding_block/scene.toml", (0.01, 0.05)),
}
BED_TIMES = (0.001, 0.005)
SOLVERS = "pgs,asgs,jacobi,apgd,spg,admm,interior_point,semismooth_newton"
PEERS = {  # by the model of friction that they solve; Bullet's is neither, and is judged by the smaller residual
    "associated": ("bullet", "siconos_soclcp_nsgs", "siconos_soclcp_vi_fpp", "siconos_soclcp_vi_eg", "siconos_convexqp_pg",
                   "siconos_convexqp_admm", "siconos_global_admm", "siconos_global_ipm"),
    "coulomb": ("bullet", "siconos_nsgs", "siconos_admm", "siconos_aclmfp", "siconos_tfp", "siconos_vi_fpp", "siconos_vi_eg",
                "siconos_nsn_ac"),
}
SHORT = 0.05  # [s]; a shorter solve is repeated, and the least time counts
FIELDS = ("scene", "problem", "contacts", "solver", "tolerance [m/s]", "solved", "status", "iterations", "residual [m/s]",
          "seconds [s]")


def record(program, scene, times, folder, settings=()):
    """Runs a scene and returns its recorded problems: name -> (file, contacts)."""
    if not (folder / "run.json").exists():
        command = [program, "run", str(scene), "-o", str(folder), "--overwrite", "--quiet", "--end-time", f"{times[-1]} s",
                   "--record-ccp", "t=" + ",".join(map(str, times))]
        for setting in settings:
            command += ["--set", setting]
        with open(folder.parent / (folder.name + ".log"), "w") as log:
            if subprocess.run(command, stdout=log, stderr=log).returncode != 0:
                sys.exit(f"{' '.join(command)} failed, see {folder}.log")
    with open(folder / "steps.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    contacts = {row["step"]: row["contacts"] for row in rows}
    files = sorted(folder.glob("ccp_*.h5"), key=lambda path: int(path.stem.split("_")[1]))
    return {path.stem: (path, contacts.get(path.stem.split("_")[1], "")) for path in files}


def all_problems(wanted):
    """(scene, name, file, contacts) of every problem, scene after scene in turns."""
    names = list(SCENES) if wanted.scenes is None else [name for name in wanted.scenes.split(",") if name]
    scenes = []
    for name in names:
        scene, times = SCENES[name]
        found = record(wanted.program, scene, times[-wanted.problems:], wanted.folder / name)
        scenes.append([(name, key, path, contacts) for key, (path, contacts) in found.items()])
    for bed in wanted.bed:
        if not bed.is_file():
            print(f"{bed} is not there; its problems are left out", flush=True)
            continue
        settings = (f"source.bed.file={bed.resolve()}", "ccp_solver.max_iterations=100")
        found = record(wanted.program, HERE / "scenes/bed.toml", BED_TIMES[-wanted.problems:], wanted.folder / bed.stem, settings)
        scenes.append([(bed.stem, key, path, contacts) for key, (path, contacts) in found.items()])
    return [problem for turn in itertools.zip_longest(*scenes) for problem in turn if problem]


def solve_once(command, wanted):
    """What a solve printed, or None when it took too long or too much memory, or could not solve such a problem."""
    def bounded():
        most = int(wanted.memory * 2**30)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))

    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=wanted.limit, preexec_fn=bounded)
    except subprocess.TimeoutExpired:
        return None
    try:  # libraries of peers may print sentences of their own first
        return json.loads(done.stdout[max(0, done.stdout.find("{")):]) if done.returncode == 0 else None
    except ValueError:
        return None


def solve(commands, solver, path, tolerance, wanted):
    command = [*commands[solver], str(path), "--tolerance", str(tolerance), "--max-iterations", str(wanted.max_iterations),
               "--threads", "1", "--json"]
    result = solve_once(command, wanted)
    for _ in range(wanted.repeats - 1):
        if result is None or result["wall_time"] > SHORT:
            break
        again = solve_once(command, wanted)
        if again and again["wall_time"] < result["wall_time"]:
            result = again
    return result


def measure(problems, commands, wanted):
    rows, file = [], open(wanted.folder / "profiles.csv", "w", newline="")
    table = csv.DictWriter(file, FIELDS)
    table.writeheader()
    began = time.monotonic()
    for done, (scene, key, path, contacts) in enumerate(problems):
        if time.monotonic() - began > 60 * wanted.budget:
            print(f"the budget is spent: the last {len(problems) - done} of {len(problems)} problems are left out", flush=True)
            break
        failed = set()
        for tolerance in TOLERANCES:
            for solver in commands:
                # A solver that misses a tolerance misses every smaller one.
                result = None if solver in failed else solve(commands, solver, path, tolerance, wanted)
                solved = result is not None and result["residual"] <= tolerance * (1 + 1e-9)
                if not solved:
                    failed.add(solver)
                result = result or {"status": "none", "iterations": "", "residual": "", "wall_time": ""}
                rows.append(dict(zip(FIELDS, (scene, key, contacts, solver, tolerance, int(solved), result["status"],
                                              result["iterations"], result["residual"], result["wall_time"]))))
                table.writerow(rows[-1])
        file.flush()
        print(f"{scene} {key}: {contacts} contacts; misses 1e-8: {', '.join(sorted(failed)) or 'none'}", flush=True)
    file.close()
    return rows


def ratios_of(rows, tolerance):
    """Solver -> its times over those of the fastest, where it solved; and the number of problems."""
    times, solvers = {}, []
    for row in rows:
        if float(row["tolerance [m/s]"]) != tolerance:
            continue
        solvers.append(row["solver"])
        problem = times.setdefault((row["scene"], row["problem"]), {})
        if int(row["solved"]):
            problem[row["solver"]] = max(float(row["seconds [s]"]), 1e-9)
    ratios = {solver: [] for solver in dict.fromkeys(solvers)}
    for problem in times.values():
        for solver, time in problem.items():
            ratios[solver].append(time / min(problem.values()))
    return ratios, len(times)


def report(rows, folder):
    print(f"\n| tolerance [m/s] | solver | fastest | within 2x | within 10x | solved |\n|{'---|' * 6}")
    for tolerance in TOLERANCES:
        ratios, problems = ratios_of(rows, tolerance)
        profile_plot.draw(folder / f"profile_{tolerance:.0e}.svg", f"{problems} contact problems to {tolerance:g} m/s",
                          ratios, problems, [name for name in ratios if name.split("_")[0] in ("bullet", "siconos")])
        for solver, values in ratios.items():
            shares = [sum(v <= factor for v in values) / problems for factor in (1.0, 2.0, 10.0, float("inf"))]
            print(f"| {tolerance:.0e} | `{solver}` | " + " | ".join(f"{100 * s:.0f} %" for s in shares) + " |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="the scree program")
    parser.add_argument("folder", type=pathlib.Path, help="for runs, problems, table and plots; runs found there are kept")
    parser.add_argument("--bed", type=pathlib.Path, action="append", default=[], help="a bed file, see scenes/bed.toml")
    parser.add_argument("--solvers", default=SOLVERS, help="of scree")
    parser.add_argument("--friction", choices=PEERS, default="associated", help="the model that all solve, and are judged by")
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=COMMAND", help="another program's solver")
    parser.add_argument("--no-peers", action="store_true", help="without those that lie beside the program")
    parser.add_argument("--scenes", help=f"some of {', '.join(SCENES)}")
    parser.add_argument("--limit", "--limit-seconds", type=float, default=60.0, help="seconds for a solve")
    parser.add_argument("--budget", type=float, default=float("inf"), help="minutes after which no problem is begun")
    parser.add_argument("--memory", type=float, default=4.0, help="of a solve, in GiB")
    parser.add_argument("--max-iterations", type=int, default=100000)
    parser.add_argument("--problems", type=int, default=5, help="at most so many of each scene, the last ones")
    parser.add_argument("--repeats", type=int, default=3, help="of solves shorter than 0.05 s; the least time counts")
    parser.add_argument("--report", action="store_true", help="only draw and print what profiles.csv holds")
    wanted = parser.parse_args()
    wanted.folder = wanted.folder.resolve()
    wanted.folder.mkdir(parents=True, exist_ok=True)
    if wanted.report:
        with open(wanted.folder / "profiles.csv", newline="") as file:
            return report(list(csv.DictReader(file)), wanted.folder)
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}", flush=True)
    commands = {name: [wanted.program, "solve", "--friction", wanted.friction, "--solver", name]
                for name in wanted.solvers.split(",") if name}
    beside = pathlib.Path(wanted.program).resolve().parent
    for name in () if wanted.no_peers else PEERS[wanted.friction]:
        program, _, method = name.partition("_")
        if (beside / f"{program}_solve").exists():
            commands[name] = [str(beside / f"{program}_solve"), *(["--method", method] if method else [])]
    commands |= {peer.split("=", 1)[0]: peer.split("=", 1)[1].split() for peer in wanted.peer}
    report(measure(all_problems(wanted), commands, wanted), wanted.folder)


if __name__ == "__main__":
    main()
