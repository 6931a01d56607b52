#!/usr/bin/env python3
"""Seconds to stated residuals, for every solver: settled beds from zero, the same grains in a rotating drum from the step before.

    bench/ccp/time_table.py BUILD FOLDER --bed BED_OF_8000 --bed BED_OF_64000 [--solvers a,b] [--limit S] [--budget MINUTES]
    bench/ccp/time_table.py BUILD FOLDER --bed BED_OF_8000 --bed BED_OF_64000 --prepare

The first run (or --prepare, which does only that) fills and turns a drum for each bed and records its problems in FOLDER; later runs
take them from there. Each solver then gets each problem, in a process of its own, one thread: to 1e-2, 1e-3 and 1e-4 m/s, and to a
natural map of 1e-4 (bench/ccp/time_to_residual.cpp says how each is timed). A solve that takes longer than the limit is ended, and
the tighter targets are left out. Writes time_table.md and time_table.csv into FOLDER. Standard library only.
"""

import argparse
import csv
import os
import pathlib
import platform
import resource
import selectors
import subprocess
import time

import drum_problems

TARGETS = ("0.01", "0.001", "0.0001", "map")
SOLVERS = {name: name for name in ("asgs", "apgd", "spg", "pgs", "jacobi", "admm", "interior_point", "semismooth_newton")}
SOLVERS["plain apgd"] = "apgd{scaled = false}"
FIELDS = ("problem", "start", "contacts", "solver", "target", "outcome", "iterations", "seconds [s]", "reached [m/s]")
STEPS = {8000: (80, 100), 64000: (20,)}  # of the drums, after which the problem is taken; others as 64 000


def lines_of(process, limit):
    """(line, False) of what the process says; (None, True) when a solve took longer than the limit."""
    ready = selectors.DefaultSelector()
    ready.register(process.stdout, selectors.EVENT_READ)
    began, rest = time.monotonic(), b""
    while True:
        left = began + limit - time.monotonic()
        if left <= 0 or not ready.select(left):
            yield None, True
            return
        piece = os.read(process.stdout.fileno(), 65536)
        if not piece:
            return
        *whole, rest = (rest + piece).split(b"\n")
        for line in whole:
            if line == b"begin" or line.startswith((b"done", b"contacts")):
                began = time.monotonic()
            yield line.decode(), False


def bounded(wanted):
    most = int(wanted.memory * 2**30)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def measure(wanted, solver, file, warm):
    """Target -> (outcome, iterations, seconds, reached), and the number of contacts."""
    command = [str(wanted.build / "benchmarks/time_to_residual"), "--events", "--limit=1000000000", f"--only={SOLVERS[solver]}"]
    command += ["--no-map"] if wanted.no_map else []
    process = subprocess.Popen([*command, *(["--warm"] if warm else []), str(file)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, preexec_fn=lambda: bounded(wanted))
    found, contacts, reached, late = {}, "", "", False
    for line, late in lines_of(process, wanted.limit):
        words = (line or "").split()
        if not words:
            continue
        if words[0] == "contacts":
            contacts = int(words[1])
        elif words[0] == "begin":
            reached = ""
        elif words[0] == "reached":
            reached = float(words[1])
        elif words[0] == "done":
            found[words[1]] = ("solved", int(words[2]), float(words[3]), "")
        elif words[0] == "missed":
            found[words[1]] = (words[2], "", "", float(words[3]))
    if late:
        process.kill()
    problem = process.communicate()[1].decode().strip()
    target = next((t for t in TARGETS if t not in found), None)
    if target is None or (target == "map" and wanted.no_map):
        return found, contacts
    if late:
        found[target] = (f"not in {wanted.limit:g} s", "", "", reached)
    elif process.returncode != 0:
        memory = "bad_alloc" in problem or "memory" in problem
        found[target] = (f"not in {wanted.memory:g} GiB" if memory else problem or f"ended with {process.returncode}", "", "", reached)
    return found, contacts


def cell(rows):
    """One cell of the table: the mean over the problems, or why there is none."""
    bad = [row for row in rows if row["outcome"] != "solved"]
    if bad:
        reached = f" ({bad[0]['reached [m/s]']:.1g})" if bad[0]["reached [m/s]"] != "" else ""
        return bad[0]["outcome"] + reached
    if not rows:
        return "-"
    mean = {key: sum(row[key] for row in rows) / len(rows) for key in ("iterations", "seconds [s]")}
    return f"{mean['iterations']:.0f}, {mean['seconds [s]']:.3g}"


def run_table(wanted, name, files, warm, out):
    """All solvers on one group of problems; appends rows to `out`."""
    for solver in wanted.solvers:
        failed = set()
        for file in files:
            if failed:
                break
            if time.monotonic() > wanted.end:
                found, contacts = {TARGETS[0]: ("not begun: budget spent", "", "", "")}, ""
            else:
                found, contacts = measure(wanted, solver, file, warm)
            failed = {target for target, entry in found.items() if entry[0] != "solved"}
            for target, entry in found.items():
                out.append(dict(zip(FIELDS, (name, "warm" if warm else "cold", contacts, solver, target, *entry))))
        print(f"{name}, {'warm' if warm else 'cold'}, {solver}: " + "; ".join(
            cell([row for row in group(out, name, warm) if row["solver"] == solver and row["target"] == target])
            for target in TARGETS), flush=True)


def group(rows, name, warm):
    return [row for row in rows if row["problem"] == name and row["start"] == ("warm" if warm else "cold")]


def table(rows, name, warm, solvers):
    mine = group(rows, name, warm)
    contacts = sorted({row["contacts"] for row in mine if row["contacts"]})
    text = [f"\n### {name}, {'warm' if warm else 'cold'}: {', '.join(map(str, contacts))} contacts\n",
            "| solver | 1e-2 m/s | 1e-3 m/s | 1e-4 m/s | natural map 1e-4 |", "|---|---|---|---|---|"]
    for solver in solvers:
        cells = [cell([row for row in mine if row["solver"] == solver and row["target"] == target]) for target in TARGETS]
        text.append(f"| {solver} | " + " | ".join(cells) + " |")
    return text


def prepare(wanted):
    """(name, files, warm) of each table."""
    tables = []
    for bed in wanted.bed:
        count = int(bed.read_text().split(maxsplit=1)[0])
        steps = STEPS.get(count, STEPS[64000])
        drum = wanted.folder / f"drum_{count}"
        files = drum_problems.record(str(wanted.build / "bin/scree"), drum, bed.resolve(), steps, wanted.threads)
        if not wanted.no_beds:
            tables.append((f"bed of {count}", [bed], False))
        tables.append((f"drum of {count}", files, True))
        if wanted.cold_drums:
            tables.append((f"drum of {count}", files, False))
    return sorted(tables, key=lambda entry: (not entry[0].startswith("bed"), entry[2]))


def solver_names(text):
    names = text.split(",")
    for name in names:
        if name not in SOLVERS:
            raise argparse.ArgumentTypeError(f"there is no solver '{name}'; valid: {', '.join(SOLVERS)}")
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", type=pathlib.Path, help="build folder, for example build/release")
    parser.add_argument("folder", type=pathlib.Path, help="for problems and tables")
    parser.add_argument("--bed", type=pathlib.Path, action="append", required=True, help="a bed file, see scenes/bed.toml")
    parser.add_argument("--prepare", action="store_true", help="only fill the drums and record their problems")
    parser.add_argument("--no-beds", action="store_true", help="the drums only")
    parser.add_argument("--cold-drums", action="store_true", help="the drums from zero as well")
    parser.add_argument("--solvers", type=solver_names, default=None, help=f"some of {', '.join(SOLVERS)}")
    parser.add_argument("--no-map", action="store_true", help="residuals only")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for a solve")
    parser.add_argument("--memory", type=float, default=8.0, help="for a solve, in GiB")
    parser.add_argument("--budget", type=float, default=float("inf"), help="minutes after which no row is begun")
    parser.add_argument("--threads", type=int, default=2, help="for filling the drums")
    wanted = parser.parse_args()
    wanted.build, wanted.folder = wanted.build.resolve(), wanted.folder.resolve()
    wanted.solvers = wanted.solvers or list(SOLVERS)
    wanted.folder.mkdir(parents=True, exist_ok=True)
    tables = prepare(wanted)
    if wanted.prepare:
        return
    wanted.end = time.monotonic() + 60 * wanted.budget
    text = [f"{platform.machine()}, {os.cpu_count()} cores, load at the start {os.getloadavg()[0]:.1f}; one thread; iterations, seconds; "
            f"at most {wanted.limit:g} s and {wanted.memory:g} GiB a solve; in brackets the residual reached [m/s]; a dash: "
            "not tried, since an easier target was missed"]
    print(text[0], flush=True)
    rows = []
    for name, files, warm in tables:
        run_table(wanted, name, files, warm, rows)
        text += table(rows, name, warm, wanted.solvers)
        (wanted.folder / "time_table.md").write_text("\n".join(text) + "\n")
        with open(wanted.folder / "time_table.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, FIELDS)
            writer.writeheader()
            writer.writerows(rows)
    print("\n".join(text[1:]))


if __name__ == "__main__":
    main()
