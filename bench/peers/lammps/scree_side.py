"""The comparison's scenes for scree: dvi or dem in steps of 1 ms. Standard library only."""

import csv
import os
import pathlib
import subprocess
import sys
import time

import grains

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scaling"))
import vtp  # noqa: E402

TIME_STEP = 1e-3  # [s]

SCENE = """
[simulation]
end_time = 100.0
time_step = {step}
allow_overlap = {allow_overlap}
{stepper}
[broad_phase]
type = "grid"
[[narrow_phase]]
type = "sphere_cluster"
[[force_field]]
type = "gravity"
acceleration = [{down}]
[material.grain]
density = {density}
friction = {friction}
restitution = {restitution}
[[source]]
type = "bed"
file = "{bed}"
material = "grain"
{walls}
{frames}
"""

DVI = """[time_stepper]
type = "dvi"
recovery_speed = {recovery}
[ccp_solver]
{solver}"""

DRUM = """
[shape.drum]
type = "cylinder"
hollow = true
radius = {radius}
length = {length}
[[body]]
shape = "drum"
material = "grain"
motion = "kinematic"
angular_velocity = [0.0, 0.0, {speed}]
"""


def read_particles(path, spin=False):
    """Rows as in a bed file, with the angular velocity behind if asked for."""
    arrays = vtp.read_arrays(path, ("Points", "radius", "velocity", "angular_velocity"))
    p, r, v, w = arrays["Points"], arrays["radius"], arrays["velocity"], arrays["angular_velocity"]
    return [[*p[3 * i:3 * i + 3], r[i], *v[3 * i:3 * i + 3], *(w[3 * i:3 * i + 3] if spin else ())] for i in range(len(r))]


def read_steps(out):
    """The columns of steps.csv, without their units."""
    with open(out / "steps.csv", newline="") as file:
        rows = [{key.split(" ")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]
    return {key: [float(row[key]) for row in rows] for key in rows[0] if key != "status"}


class Scree:
    """One scene; start() brings it to its state, measure() continues from there."""

    def __init__(self, program, folder, scene, bed, cores, options):
        self.drum = grains.Drum(len(grains.read_bed(bed)[0])) if scene == "drum" else None
        self.program, self.folder, self.name, self.cores, self.prefix = program, folder, scene, cores, options["prefix"]
        self.bed, self.options = bed, options
        folder.mkdir(parents=True, exist_ok=True)
        self.warm = folder / f"scree_{scene}_start" / "checkpoint.h5"
        self.wall_time = self.processor_time = self.peak_memory = 0  # of the last run [s], [s], [byte]

    def write_scene(self, path, interval):
        drum = self.drum
        frames = f'[[observer]]\ntype = "vtk"\nwalls = false\ninterval = {interval!r}\n' if interval else ""
        stepper = self.options.get("stepper") or DVI.format(recovery=self.options["recovery"], solver=self.options["solver"])
        path.write_text(SCENE.format(
            step=self.options.get("step", TIME_STEP), allow_overlap=self.options.get("allow_overlap", "false"), stepper=stepper,
            density=grains.DENSITY, friction=grains.FRICTION, restitution=self.options.get("restitution", 0.0), bed=self.bed,
            down=f"0.0, -{grains.GRAVITY}, 0.0" if drum else f"0.0, 0.0, -{grains.GRAVITY}",
            walls=DRUM.format(**vars(drum)) if drum else 'walls = "grain"', frames=frames))

    def run(self, name, end, more, prefix=(), interval=0.0):
        scene = self.folder / f"{name}.toml"
        self.write_scene(scene, interval)
        out = self.folder / name
        command = [*prefix, self.program, "run", str(scene), "-o", str(out), "--overwrite", "--quiet", "--threads",
                   str(self.cores), "--end-time", repr(end), *more]
        began = time.time()
        with open(self.folder / f"{name}.log", "w") as log:
            child = subprocess.Popen(command, stdout=log, stderr=log)
            _, status, usage = os.wait4(child.pid, 0)
            if status != 0:
                raise RuntimeError(f"scree failed, see {log.name}")
        self.wall_time, self.processor_time = time.time() - began, usage.ru_utime + usage.ru_stime
        self.peak_memory = 1024 * usage.ru_maxrss
        return out

    def start(self, seconds):
        self.run(f"scree_{self.name}_start", seconds, [])

    def measure(self, since, seconds):
        """Wall seconds per simulated second by the sum of all steps, residuals, iterations, overlaps, and some frames."""
        name = f"scree_{self.name}_{self.cores}"
        out = self.run(name, since + seconds, ["--resume", str(self.warm)], self.prefix)
        column = read_steps(out)
        later = [i for i, time in enumerate(column["time"]) if time > since + 0.5 * TIME_STEP]
        column = {key: [values[i] for i in later] for key, values in column.items()}
        phases = {key[8:]: sum(values) / len(later) / TIME_STEP for key, values in column.items() if key.startswith("seconds_")}
        return {"wall": sum(phases.values()), "phases": phases, "columns": column}

    def frames(self, since, seconds):
        """Positions at four times of the measured interval, from a run of their own that nobody times."""
        out = self.run(f"scree_{self.name}_frames", since + seconds, ["--resume", str(self.warm)], (), seconds / 4)
        return [read_particles(path) for path in sorted(out.glob("particles_*.vtp"))[-4:]]
