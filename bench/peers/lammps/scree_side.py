"""The comparison's scenes for scree: dvi with steps of 1 ms. Standard library only."""

import csv
import pathlib
import subprocess
import sys

import grains

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scaling"))
import vtp  # noqa: E402

TIME_STEP = 1e-3  # [s]

SCENE = """
[simulation]
end_time = 100.0
time_step = {step}
allow_overlap = {allow_overlap}
[time_stepper]
type = "dvi"
recovery_speed = {recovery}
[ccp_solver]
{solver}
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
[[source]]
type = "bed"
file = "{bed}"
material = "grain"
{walls}
{frames}
"""

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


def read_particles(path):
    """Rows as in a bed file."""
    arrays = vtp.read_arrays(path, ("Points", "radius", "velocity"))
    p, r, v = arrays["Points"], arrays["radius"], arrays["velocity"]
    return [[*p[3 * i:3 * i + 3], r[i], *v[3 * i:3 * i + 3]] for i in range(len(r))]


class Scree:
    """One scene; start() brings it to its state, measure() continues from there."""

    def __init__(self, program, folder, scene, bed, cores, options):
        self.drum = grains.Drum(len(grains.read_bed(bed)[0])) if scene == "drum" else None
        self.program, self.folder, self.name, self.cores, self.prefix = program, folder, scene, cores, options["prefix"]
        self.bed, self.options = bed, options
        folder.mkdir(parents=True, exist_ok=True)
        self.warm = folder / f"scree_{scene}_start" / "checkpoint.h5"

    def write_scene(self, path, interval):
        drum = self.drum
        frames = f'[[observer]]\ntype = "vtk"\nwalls = false\ninterval = {interval!r}\n' if interval else ""
        path.write_text(SCENE.format(
            step=self.options.get("step", TIME_STEP), allow_overlap=self.options.get("allow_overlap", "false"),
            recovery=self.options["recovery"], solver=self.options["solver"], density=grains.DENSITY,
            friction=grains.FRICTION, bed=self.bed, down=f"0.0, -{grains.GRAVITY}, 0.0" if drum else f"0.0, 0.0, -{grains.GRAVITY}",
            walls=DRUM.format(**vars(drum)) if drum else 'walls = "grain"', frames=frames))

    def run(self, name, end, more, prefix=(), interval=0.0):
        scene = self.folder / f"{name}.toml"
        self.write_scene(scene, interval)
        out = self.folder / name
        command = [*prefix, self.program, "run", str(scene), "-o", str(out), "--overwrite", "--quiet", "--threads",
                   str(self.cores), "--end-time", repr(end), *more]
        with open(self.folder / f"{name}.log", "w") as log:
            if subprocess.run(command, stdout=log, stderr=log).returncode != 0:
                raise RuntimeError(f"scree failed, see {log.name}")
        return out

    def start(self, seconds):
        self.run(f"scree_{self.name}_start", seconds, [])

    def measure(self, since, seconds):
        """Wall seconds per simulated second by the sum of all steps, residuals, iterations, overlaps, and some frames."""
        name = f"scree_{self.name}_{self.cores}"
        out = self.run(name, since + seconds, ["--resume", str(self.warm)], self.prefix)
        with open(out / "steps.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file)]
        rows = [{key.split(" ")[0]: value for key, value in row.items()} for row in rows]
        rows = [row for row in rows if float(row["time"]) > since + 0.5 * TIME_STEP]
        column = {key: [float(row[key]) for row in rows] for key in rows[0] if key != "status"}
        phases = {key[8:]: sum(values) / len(rows) / TIME_STEP for key, values in column.items() if key.startswith("seconds_")}
        return {"wall": sum(phases.values()), "phases": phases, "columns": column}

    def frames(self, since, seconds):
        """Positions at four times of the measured interval, from a run of their own that nobody times."""
        out = self.run(f"scree_{self.name}_frames", since + seconds, ["--resume", str(self.warm)], (), seconds / 4)
        return [read_particles(path) for path in sorted(out.glob("particles_*.vtp"))[-4:]]
