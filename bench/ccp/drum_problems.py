"""Contact problems of a rotating drum that holds the grains of a bed. Standard library only."""

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


def record(program, folder, bed, steps, threads):
    """Problems of these steps of 1 ms, each with the impulses of the step before it."""
    out = folder / "recorded"
    files = [out / f"ccp_{step}.h5" for step in steps]
    if not all(file.exists() for file in files):
        drum = moving_drum(program, folder, bed, threads)
        times = ",".join(f"{1e-3 * step:.3f}" for step in steps)
        Scree(program, folder, "drum", drum, threads, FINE).run("recorded", 1e-3 * steps[-1], ["--record-ccp", "t=" + times])
    return files
