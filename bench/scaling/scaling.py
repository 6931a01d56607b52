#!/usr/bin/env python3
"""How the cost of a step and the memory grow with the number of particles.

    bench/scaling/scaling.py PROGRAM FOLDER [--bed FILE] [--steps N] [--iterations N]

A settled bed (made here from examples/settle, or given as a bed file) is repeated sideways, so that the depth, and with
it the number of contacts a body, stays the same. Overlap is not undone (recovery_speed = 0), since that would lift a deep
bed off its contacts. All beds run with one thread and a fixed number of solver iterations.
Cost: processor time of a run of 2N steps less that of N steps, over N steps and bodies; starting up cancels, and so do the
waits of a busy machine. Memory: largest resident set of a run, over the difference in bodies. Prints a table and
writes scaling.csv and memory.csv into FOLDER. Standard library only.
"""

import argparse
import csv
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys

import vtp

ROOT = pathlib.Path(__file__).resolve().parents[2]
TILE_BODIES = 8000
TILE_SIDE = 0.1  # [m]
COST_TILES = ((2, 2), (8, 4))        # 32 000 and 256 000 of a tile of 8000
MEMORY_BODIES = (20000, 100000)
LARGE_TILES = (10, 9)                # 720 000, with two million contacts
MILLION_TILES = (14, 9)              # 1 008 000

SCENE = """
[simulation]
end_time = 1.0
time_step = 1e-3
[time_stepper]
type = "dvi"
recovery_speed = 0.0
[ccp_solver]
type = "apgd"
tolerance = 0.0
max_iterations = {iterations}
[broad_phase]
type = "grid"
[[narrow_phase]]
type = "sphere_cluster"
[[force_field]]
type = "gravity"
[material.glass]
density = 2500
friction = 0.3
[material.smooth]
density = 2500
[shape]
floor = {{ type = "plane" }}
left = {{ type = "plane", normal = [1, 0, 0] }}
right = {{ type = "plane", normal = [-1, 0, 0] }}
front = {{ type = "plane", normal = [0, 1, 0] }}
back = {{ type = "plane", normal = [0, -1, 0] }}
[[body]]
shape = "floor"
material = "glass"
[[body]]
shape = "left"
material = "smooth"
position = [{left}, 0, 0]
[[body]]
shape = "right"
material = "smooth"
position = [{right}, 0, 0]
[[body]]
shape = "front"
material = "smooth"
position = [0, {front}, 0]
[[body]]
shape = "back"
material = "smooth"
position = [0, {back}, 0]
"""

BED_SOURCE = """
[[source]]
type = "bed"
file = "{file}"
material = "glass"
limit = {count}
"""

FEED_SOURCE = """
[[source]]
type = "fill"
count = {count}
lower = [{left}, {front}, 0]
upper = [{right}, {back}, 9]
families = [{{ name = "f", material = "glass", size = {{ type = "uniform", min = 4e-3, max = 6e-3 }}, shape = {shape} }}]
"""


class Measured:
    """One run: processor time [s], largest resident set [byte], its steps.csv by column."""

    def __init__(self, program, scene, folder, steps):
        command = [program, "run", str(scene), "-o", str(folder), "--overwrite", "--quiet", "--threads", "1",
                   "--end-time", f"{steps} ms"]
        with open(folder.parent / (folder.name + ".log"), "w") as log:
            child = subprocess.Popen(command, stdout=log, stderr=log)
            _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            sys.exit(f"{' '.join(command)} failed, see {folder}.log")
        self.cpu = usage.ru_utime + usage.ru_stime
        self.memory = usage.ru_maxrss * 1024
        self.hash = json.loads((folder / "run.json").read_text())["state_hash"]
        with open(folder / "steps.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.columns = {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}

    def last(self, name):
        return float(self.columns[name][-1])

    def median(self, name, since):
        return statistics.median(float(value) for value in self.columns[name][since:])


def make_tile(program, folder):
    """A settled bed of TILE_BODIES spheres TILE_SIDE wide, by examples/settle."""
    tile = folder / "tile.txt"
    if not tile.exists():
        scene = folder / "tile.toml"
        text = (ROOT / "examples/settle/scene.toml").read_text().replace("25 mm", f"{1e3 * TILE_SIDE / 2} mm")
        start = text.index("[[observer]]")
        scene.write_text(text[:start] + '[[observer]]\ntype = "vtk"\ninterval = "100 ms"\n')
        subprocess.run([program, "run", str(scene), "-o", str(folder / "tile"), "--overwrite", "--quiet", "--end-time", "800 ms",
                        "--set", f"source.fill.count={TILE_BODIES}", "--set", "ccp_solver.max_iterations=100"], check=True)
        arrays = vtp.read_arrays(sorted((folder / "tile").glob("particles_*.vtp"))[-1], ("Points", "radius", "velocity"))
        points, radii, speeds = arrays["Points"], arrays["radius"], arrays["velocity"]
        rows = [[*points[3 * i:3 * i + 3], radii[i], *speeds[3 * i:3 * i + 3]] for i in range(len(radii))]
        tile.write_text(f"{len(rows)} {TILE_SIDE}\n" + "\n".join(" ".join(repr(v) for v in row) for row in rows) + "\n")
    return tile


def repeat(tile, across, along, path):
    """Writes a bed of across x along tiles side by side. Returns the number of spheres and half its extents [m]. No two radii
    are the same bits, so that every sphere has a shape of its own, as those of a feed have."""
    lines = tile.read_text().split("\n")
    side = float(lines[0].split()[1])
    rows = [list(map(float, line.split())) for line in lines[1:] if line.strip()]
    with open(path, "w") as out:
        out.write(f"{len(rows) * across * along} {side * max(across, along)}\n")
        for i in range(across):
            for j in range(along):
                x, y = (i - (across - 1) / 2) * side, (j - (along - 1) / 2) * side
                scale = 1.0 - 1e-10 * (i * along + j)
                for row in rows:
                    place = (row[0] + x, row[1] + y, row[2], scale * row[3], *row[4:])
                    out.write(" ".join(map(repr, place)) + "\n")
    return len(rows) * across * along, across * side / 2, along * side / 2


def write_scene(path, source, half_x, half_y, iterations):
    walls = {"left": -half_x, "right": half_x, "front": -half_y, "back": half_y}
    path.write_text(SCENE.format(iterations=iterations, **walls) + source.format(**walls))


def write_table(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    print("| " + " | ".join(rows[0]) + " |\n|" + "---|" * len(rows[0]))
    for row in rows:
        print("| " + " | ".join(str(v) for v in row.values()) + " |")
    print(flush=True)


def measure_cost(program, tile, folder, steps, iterations):
    rows = []
    for across, along in COST_TILES:
        bed = folder / f"bed_{across}x{along}.txt"
        count, half_x, half_y = repeat(tile, across, along, bed)
        scene = bed.with_suffix(".toml")
        write_scene(scene, BED_SOURCE.replace("{file}", str(bed)).replace("{count}", str(count)), half_x, half_y, iterations)
        short = Measured(program, scene, folder / f"{bed.stem}_short", steps)
        long = Measured(program, scene, folder / f"{bed.stem}_long", 2 * steps)
        row = {"bodies": count, "contacts/body": round(long.last("contacts") / count, 3),
               "cpu [us/step/body]": round(1e6 * (long.cpu - short.cpu) / steps / count, 3)}
        for name in long.columns:
            if name.startswith("seconds_"):
                micro = 1e6 * long.median(name, steps) / count
                if micro >= 0.01:
                    row[f"{name.split(' ')[0].removeprefix('seconds_')} [wall us]"] = round(micro, 3)
        row["state hash"] = long.hash
        rows.append(row)
    write_table(folder / "scaling.csv", rows)
    ratio = rows[-1]["cpu [us/step/body]"] / rows[0]["cpu [us/step/body]"]
    print(f"cost of a step a body grows by a factor of {ratio:.2f} (target: at most 1.5)\n")


def measure_memory(program, tile, folder, iterations):
    bed = folder / "bed_memory.txt"
    _, half_x, half_y = repeat(tile, 4, 4, bed)
    feeds = {"settled spheres, bed file": (BED_SOURCE.replace("{file}", str(bed)), 10),
             "spheres, fill": (FEED_SOURCE.replace("{shape}", '"sphere"'), 10),
             "shavings of 7 spheres, fill": (FEED_SOURCE.replace("{shape}", '{{ type = "shaving" }}'), 10)}
    rows = []
    for name, (source, steps) in feeds.items():
        runs = []
        for count in MEMORY_BODIES:
            scene = folder / "memory.toml"
            write_scene(scene, source.replace("{count}", str(count)), half_x, half_y, iterations)
            runs.append(Measured(program, scene, folder / "memory", steps))
        rows.append({"particles": name, "contacts/body": round(runs[1].last("contacts") / MEMORY_BODIES[1], 2),
                     **{f"peak at {n} [MB]": round(run.memory / 1e6, 1) for n, run in zip(MEMORY_BODIES, runs)},
                     "slope [byte/particle]": round((runs[1].memory - runs[0].memory) / (MEMORY_BODIES[1] - MEMORY_BODIES[0]))})
    write_table(folder / "memory.csv", rows)


def measure_large(program, tile, folder, iterations):
    """One bed of two million contacts, two steps."""
    bed = folder / "bed_large.txt"
    count, half_x, half_y = repeat(tile, *LARGE_TILES, bed)
    scene = folder / "large.toml"
    write_scene(scene, BED_SOURCE.replace("{file}", str(bed)).replace("{count}", str(count)), half_x, half_y, iterations)
    run = Measured(program, scene, folder / "large", 2)
    contacts = run.last("contacts")
    write_table(folder / "large.csv", [{"bodies": count, "contacts": round(contacts), "peak [GiB]": round(run.memory / 2**30, 2),
                                        "peak [byte/contact]": round(run.memory / contacts), "cpu [s]": round(run.cpu, 1)}])


def measure_million(program, tile, folder, steps, iterations):
    """A step of the whole simulation of a million spheres: its time by phase, and the largest resident set of the run."""
    bed = folder / "bed_million.txt"
    count, half_x, half_y = repeat(tile, *MILLION_TILES, bed)
    scene = folder / "million.toml"
    write_scene(scene, BED_SOURCE.replace("{file}", str(bed)).replace("{count}", str(count)), half_x, half_y, iterations)
    run = Measured(program, scene, folder / "million", steps)
    # The first step makes all buffers.
    phases = {name: run.median(name, 1) for name in run.columns if name.startswith("seconds_")}
    write_table(folder / "million.csv", [{"bodies": count, "contacts": round(run.last("contacts")),
                                          "a step [wall s]": round(sum(phases.values()), 2),
                                          **{f"{name.split(' ')[0].removeprefix('seconds_')} [s]": round(value, 3)
                                             for name, value in phases.items()},
                                          "run [cpu s]": round(run.cpu, 1), "peak [GiB]": round(run.memory / 2**30, 2)}])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="the scree program")
    parser.add_argument("folder", type=pathlib.Path, help="for beds, runs and tables")
    parser.add_argument("--bed", type=pathlib.Path, help="settled bed to repeat; made with examples/settle if left out")
    parser.add_argument("--steps", type=int, default=5, help="steps N of the shorter run")
    parser.add_argument("--iterations", type=int, default=50, help="of the solver, in every step")
    parser.add_argument("--only", choices=("cost", "memory", "large", "million"), help="one of them")
    wanted = parser.parse_args()
    folder = wanted.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    tile = wanted.bed.resolve() if wanted.bed else make_tile(wanted.program, folder)
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, "
          f"{wanted.iterations} iterations a step\n", flush=True)
    if wanted.only in (None, "cost"):
        measure_cost(wanted.program, tile, folder, wanted.steps, wanted.iterations)
    if wanted.only in (None, "memory"):
        measure_memory(wanted.program, tile, folder, wanted.iterations)
    if wanted.only in (None, "large"):
        measure_large(wanted.program, tile, folder, wanted.iterations)
    if wanted.only in (None, "million"):
        measure_million(wanted.program, tile, folder, wanted.steps, wanted.iterations)


if __name__ == "__main__":
    main()
