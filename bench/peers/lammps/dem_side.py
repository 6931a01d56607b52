"""scree's dem with the law and the parameters that lammps_side gives to LAMMPS. Standard library only."""

import dataclasses
import math

import grains
from lammps_side import Law, RESTITUTION, STIFFNESS, damping
from scree_side import Scree, read_particles, read_steps

# LAMMPS ends a contact when the gap is zero again, limits friction by mu |F| also while the dashpot pulls, and lets forces act at
# each grain's undeformed surface; its tangential dashpot is half of the normal one, its tangential spring 2/7.
STEPPER = """[time_stepper]
type = "dem"
sub_step = {step!r}
force_step = true
lever = "radius"
{skin}
[contact_law]
type = "linear_spring_dashpot"
stiffness = {stiffness!r}
end_of_contact = "gap"
friction_in_tension = true
tangential_stiffness_ratio = {spring!r}
tangential_damping_ratio = 0.5
"""


def options(step, outer=1e-3, skin=0.0, prefix=()):
    """For Scree: sub-step, outer step [s], skin [m]; 0: scree's own."""
    stepper = STEPPER.format(step=step, stiffness=STIFFNESS, spring=2 / 7, skin=f"skin = {skin!r}" if skin else "")
    return {"prefix": list(prefix), "stepper": stepper, "step": outer, "allow_overlap": "true", "restitution": RESTITUTION}


def law_of(radius, **more):
    """LAMMPS' law for grains of one radius [m], with scree's dashpot: C = 2 zeta sqrt(k m), m that of the contact."""
    mass = grains.DENSITY * 4 / 3 * math.pi * radius ** 3
    return Law(pairs=damping(0.5 * mass), walls=damping(mass), **more)


@dataclasses.dataclass
class Record:
    """What a run leaves: times [s] and kinetic energies of translation and rotation [J], and frames, rows as in a bed file
    with the angular velocity behind."""
    times: list
    energies: list
    frames: list


def of_lammps(lammps, seconds, since, interval, keep):
    rows, frames = lammps.record(seconds, round(1e-3 / lammps.law.step), since, interval, keep)
    return Record([row[0] for row in rows], [row[1] + row[2] for row in rows], frames)


def of_scree(scree, seconds, since, interval, keep):
    name = f"scree_{scree.name}_record"
    out = scree.folder / name
    if not (keep and (out / "run.json").exists()):
        scree.run(name, seconds, [], interval=interval)
    steps = read_steps(out)
    paths = sorted(out.glob("particles_*.vtp"))
    frames = [read_particles(path, spin=True) for path in paths if number(path) >= round(since / scree.options["step"])]
    return Record(steps["time"], steps["kinetic_energy"], frames)


def number(path):
    return int(path.stem.rsplit("_", 1)[1])
