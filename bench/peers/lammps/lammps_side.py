"""The comparison's scenes for LAMMPS: springs and dashpots with history (gran/hooke/history). Standard library only."""

import dataclasses
import math
import os
import re
import subprocess
import time

import grains

STIFFNESS = 2000.0      # normal [N/m]; tangential 2/7 of it
TIME_STEP = 4e-5        # [s]
RESTITUTION = 0.5       # of two grains of 5 mm
SKIN = 1.5e-3           # of the neighbour lists [m]

COMMON = """
comm_modify     vel yes
neighbor        {skin} bin
neigh_modify    delay 0 every 1 check yes
pair_style      gran/hooke/history {k} NULL {damping} NULL {friction} 1
pair_coeff      * *
timestep        {dt}
fix             motion all nve/sphere
fix             weight all gravity {gravity} vector {down}
{walls}
compute         linear all ke
compute         spinning all erotate/sphere
thermo          {often}
thermo_style    custom step atoms c_linear c_spinning
thermo_modify   lost error
"""

FIRST = """
units           si
atom_style      sphere
boundary        f f f
newton          off
{processors}
read_data       {data}
"""

AGAIN = """
units           si
atom_style      sphere
newton          off
{processors}
read_restart    {restart}
"""


def damping(mass=0.5 * grains.DENSITY * 4 / 3 * math.pi * 5e-3 ** 3):
    """gamma_n [1/s] with which a spring of STIFFNESS and this effective mass rebounds with RESTITUTION when the gap is zero
    again; the dashpot is mass times gamma_n. Of two grains of 5 mm, if not given."""
    log = math.log(RESTITUTION)
    zeta = -log / math.sqrt(math.pi ** 2 + log * log)
    return 2 * zeta * math.sqrt(STIFFNESS / mass)


@dataclasses.dataclass
class Law:
    """What may differ between runs; tangential springs are 2/7 of the normal ones, tangential dashpots half of them."""
    pairs: float = damping()  # gamma_n of two grains [1/s]
    walls: float = damping()  # of a grain and a wall
    step: float = TIME_STEP   # [s]
    skin: float = SKIN        # [m]


def walls(drum, side, gamma):
    law = f"hooke/history {STIFFNESS} NULL {gamma} NULL {grains.FRICTION} 1"
    if drum:
        half = drum.length / 2
        return (f"variable angle equal {drum.speed}*time\n"
                f"region drum cylinder z 0 0 {drum.radius} {-half} {half} side in rotate v_angle 0 0 0 0 0 1\n"
                f"fix wall all wall/gran/region {law} region drum")
    half = side / 2
    return (f"fix floor all wall/gran {law} zplane 0 NULL\n"
            f"fix sides_x all wall/gran {law} xplane {-half} {half}\n"
            f"fix sides_y all wall/gran {law} yplane {-half} {half}")


def write_data(path, rows, box):
    text = [f"grains\n\n{len(rows)} atoms\n1 atom types\n"]
    text += [f"{low} {high} {axis}lo {axis}hi" for (low, high), axis in zip(box, "xyz")]
    text.append("\nAtoms # sphere\n")
    text += [f"{i} 1 {2 * r[3]!r} {grains.DENSITY} {r[0]!r} {r[1]!r} {r[2]!r}" for i, r in enumerate(rows, 1)]
    text.append("\nVelocities\n")
    text += [" ".join(map(repr, [i, *r[4:7], *(r[7:] or (0, 0, 0))])) for i, r in enumerate(rows, 1)]
    path.write_text("\n".join(text) + "\n")


def read_dump(path, count):
    """Frames of a dump, each a list of rows as in a bed file."""
    frames, lines = [], path.read_text().split("\n")
    for at, line in enumerate(lines):
        if line.startswith("ITEM: ATOMS"):
            frames.append([list(map(float, row.split()))[1:] for row in lines[at + 1:at + 1 + count]])
    return frames


class Lammps:
    """One scene; start() brings it to its state, measure() continues from there."""

    def __init__(self, program, folder, scene, rows, side, cores, prefix, law=None):
        self.law = law or Law()
        self.peak_memory = 0  # of the last run [byte]
        self.folder, self.scene, self.rows, self.side, self.cores = folder, scene, rows, side, cores
        self.drum = grains.Drum(len(rows)) if scene == "drum" else None
        self.program, self.prefix = program, prefix
        self.warm = folder / f"lammps_{scene}.restart"
        folder.mkdir(parents=True, exist_ok=True)

    def script(self, first, steps, rest, often=0):
        drum, margin = self.drum, 0.02
        reach = (drum.radius if drum else self.side / 2) + margin
        depth = (drum.length / 2 if drum else 0.0) + margin
        box = [(-reach, reach), (-reach, reach), (-depth, depth) if drum else (-margin, max(r[2] for r in self.rows) + 0.1)]
        # Slices that share the load: along the drum's axis, or along x.
        processors = f"processors {'1 1 *' if drum else '* 1 1'}"
        data = self.folder / f"lammps_{self.scene}.data"
        if first:
            write_data(data, self.rows, box)
        head = (FIRST if first else AGAIN).format(processors=processors, data=data, restart=self.warm)
        return head + COMMON.format(
            skin=self.law.skin, k=STIFFNESS, damping=self.law.pairs, friction=grains.FRICTION, dt=self.law.step,
            gravity=grains.GRAVITY, down="0 -1 0" if drum else "0 0 -1", walls=walls(drum, self.side, self.law.walls),
            often=max(1, often or steps)) + rest

    def run(self, name, text, cores):
        path = self.folder / f"{name}.in"
        path.write_text(text)
        command = [*self.prefix, "mpirun", "--allow-run-as-root", "-np", str(cores), self.program, "-log", "none", "-in"]
        log = self.folder / f"{name}.log"
        with open(log, "w") as out:
            child = subprocess.Popen([*command, str(path)], stdout=out, stderr=out)
            _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            raise RuntimeError(f"LAMMPS failed, see {log}")
        self.peak_memory = 1024 * usage.ru_maxrss  # of the largest rank
        return log.read_text()

    def start(self, seconds):
        steps = round(seconds / self.law.step)
        self.run(f"lammps_{self.scene}_start", self.script(True, steps, f"run {steps}\nwrite_restart {self.warm}\n"), 1)

    def measure(self, seconds):
        """Wall seconds per simulated second, and some frames."""
        steps = round(seconds / self.law.step)
        dump = self.folder / f"lammps_{self.scene}_{self.cores}.dump"
        rest = (f"dump frames all custom {max(1, steps // 4)} {dump} id x y z radius vx vy vz\n"
                f"dump_modify frames sort id format float %.12g\nrun {steps}\n")
        began = time.time()
        out = self.run(f"lammps_{self.scene}_{self.cores}", self.script(False, steps, rest), self.cores)
        loop = float(re.search(r"Loop time of (\S+)", out).group(1))
        return {"wall": loop / (steps * self.law.step), "elapsed": time.time() - began,
                "frames": read_dump(dump, len(self.rows))[1:]}

    def record(self, seconds, often, since, interval, keep=False):
        """From the first state on: rows [time [s], kinetic energy of translation, of rotation [J]] every `often` steps, and frames
        every `interval` from `since` on [s]. With `keep`, those of an older run that has come to its end."""
        step = self.law.step
        steps, first, apart = round(seconds / step), round(since / step), round(interval / step)
        dump = self.folder / f"lammps_{self.scene}.dump"
        rest = (f"variable when equal stride({first},{steps + 2 * apart},{apart})\n"
                f"dump frames all custom {apart} {dump} id x y z radius vx vy vz omegax omegay omegaz\n"
                f"dump_modify frames sort id format float %.14g every v_when\nrun {steps}\n")
        log = self.folder / f"lammps_{self.scene}_record.log"
        if keep and log.exists() and "Total wall time" in log.read_text():
            out = log.read_text()
        else:
            out = self.run(log.stem, self.script(True, steps, rest, often), self.cores)
        rows = re.findall(rf"^ *(\d+) +{len(self.rows)} +(\S+) +(\S+) *$", out, re.M)
        return [[int(n) * step, float(a), float(b)] for n, a, b in rows], read_dump(dump, len(self.rows))
