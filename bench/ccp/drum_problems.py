#!/usr/bin/env python3
"""Contact problems of a rotating drum that holds the grains of a bed.

    bench/ccp/drum_problems.py PROGRAM FOLDER BED 78,79,80 [--slower 10] [--stiffness 2000]

Fills the drum, turns it for a while, and records the problems of these steps of 1 ms into FOLDER/recorded, each with the impulses of the
step before it; or, with --slower, into FOLDER/slower, after the drum has been slowed to a part of its speed: let it calm down for
some hundred steps. With --stiffness contacts are springs instead of rigid. Standard library only.
"""

import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "peers/lammps"))
import grains  # noqa: E402
from scree_side import Scree, read_particles  # noqa: E402

SWEEPS = 'type = "asgs"\ntolerance = 1e-3\nmax_iterations = 30\nactive_set = false\ncheck_interval = 30\n'
# Name, duration [s], settings: the grains fall into the drum; it turns; every step is solved so well that the impulses of one are a
# fair guess for the next.
FALLING = ("falling", 1.2, {"prefix": [], "recovery": 0.05, "step": 2e-3, "solver": SWEEPS})
TURNING = ("turning", 0.3, {"prefix": [], "recovery": 0.02, "allow_overlap": "true", "solver": SWEEPS})
FINE = {"prefix": [], "recovery": 0.005, "allow_overlap": "true",
        "solver": 'type = "asgs"\ntolerance = 1e-4\nmax_iterations = 2000\nactive_set = false\n'}


def moving_drum(program, folder, bed, threads):
    """The grains of the bed file in a drum that has turned for a while, as a bed file."""
    folder.mkdir(parents=True, exist_ok=True)
    rows, latest = grains.read_bed(bed)[0], folder / "loose.txt"
    drum = grains.Drum(len(rows))
    grains.write_bed(latest, grains.loose_filling([row[3] for row in rows], drum), 2 * drum.radius)
    for name, duration, settings in (FALLING, TURNING):
        path = folder / f"{name}.txt"
        if not path.exists():
            out = Scree(program, folder, "drum", latest, threads, settings).run(name, duration, [], interval=duration)
            grains.write_bed(path, read_particles(sorted(out.glob("particles_*.vtp"))[-1]), 2 * drum.radius)
        latest = path
    return latest


def record(program, folder, bed, steps, threads, slower=1.0, stiffness=None):
    """Problems of these steps of 1 ms, each with the impulses of the step before it; stiffness [N/m], none for rigid contacts."""
    name = "recorded" if slower == 1.0 else "slower"
    soft = []
    if stiffness:  # each side of a contact brings half of its compliance
        name, soft = f"{name}_{stiffness:g}", ["--set", f"material.grain.compliance={0.5 / stiffness!r}"]
    files = [folder / name / f"ccp_{step}.h5" for step in steps]
    if not all(file.exists() for file in files):
        drum = moving_drum(program, folder, bed, threads)
        times = ",".join(f"{1e-3 * step:.3f}" for step in steps)
        scene = Scree(program, folder, "drum", drum, threads, FINE)
        scene.drum.speed /= slower
        scene.run(name, 1e-3 * steps[-1], ["--record-ccp", "t=" + times, *soft])
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="scree")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("bed", type=pathlib.Path, help="a bed file, see scenes/bed.toml")
    parser.add_argument("steps", type=lambda text: [int(step) for step in text.split(",")])
    parser.add_argument("--slower", type=float, default=1.0, help="divides the speed of the drum")
    parser.add_argument("--stiffness", type=float, help="of contacts [N/m]; without it they are rigid")
    parser.add_argument("--threads", type=int, default=2)
    wanted = parser.parse_args()
    for file in record(wanted.program, wanted.folder, wanted.bed.resolve(), wanted.steps, wanted.threads, wanted.slower, wanted.stiffness):
        print(file)


if __name__ == "__main__":
    main()
