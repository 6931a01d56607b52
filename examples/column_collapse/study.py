"""How far columns run, over their aspect ratio a = H/L: study.py PROGRAM FOLDER [STEPPER ...] prints a table and draws runout.svg.

    (x_end - L) / L = 1.2 a           a < 2.3
                      1.9 a^(2/3)     a > 2.3       Lube, Huppert, Sparks and Freundt 2005, Phys. Rev. E 72: 041301
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))

from chart import Chart
from checking import Run, run_scene
from granular import connected, frames

SCENE = pathlib.Path(__file__).resolve().parent / "scene.toml"
LENGTH, WIDTH, GRAIN, LIFTED = 0.04, 0.012, 4e-3, 0.3  # L, distance of the long walls, mean grain [m]; start of the gate [s]
PER_ASPECT = 250                                       # grains that make a column about as high as long
SEEDS = (1, 2, 3)
STUDY = (0.7, 1.0, 1.5, 3.0, 3.5, 4.5)
KINK = 2.3                                             # aspect ratio between the branches


def law(a):
    return 1.2 * a if a < KINK else 1.9 * a ** (2 / 3)


def edge(points):
    """Where the deposit ends [m]: the foremost grain that lies with it, as a mean over strips as wide as a grain.

    A grain lies with the deposit when grains less than a quarter of a diameter apart lead from it to the back wall. Those that
    have rolled on by themselves do not count.
    """
    front = [0.0] * round(WIDTH / GRAIN)
    for x, y, _ in connected(points, 1.25 * GRAIN, lambda p: p[0] < GRAIN):
        strip = int((y + 0.5 * WIDTH) / GRAIN)
        front[strip] = max(front[strip], x + 0.5 * GRAIN)
    return sum(front) / len(front)


def measure(program, folder, stepper, aspect, **settings):
    """Runs the scene with a column of about that aspect ratio: (a, (x_end - L) / L), both as found."""
    folder = pathlib.Path(folder) / f"{stepper}_{aspect:g}"
    settings = {"time_stepper__type": stepper, "source__column__count": round(aspect * PER_ASPECT), **settings}
    run_scene(program, SCENE, folder, settings)
    track = Run(folder).table("track.csv")
    looks = frames(track)
    _, rest = max((t, rows) for t, rows in looks if t < LIFTED + 1e-6)
    _, end = looks[-1]
    height = 2 * sum(track["z"][i] for i in rest) / len(rest)
    return height / LENGTH, edge([(track["x"][i], track["y"][i], track["z"][i]) for i in end]) / LENGTH - 1


def mean(program, folder, stepper, aspect):
    """The mean of measure() over SEEDS packings: one grain more or less at the front is a tenth of the way."""
    runs = [measure(program, folder, stepper, aspect, simulation__seed=seed) for seed in SEEDS]
    return tuple(sum(values) / len(SEEDS) for values in zip(*runs))


def study(program, folder, steppers, aspects=STUDY):
    """Measures all columns; prints, draws, and returns {stepper: [(a, run-out)]}."""
    chart = Chart("Run-out of a column", "aspect ratio a = H/L", "(x_end - L) / L", log=True)
    found = {}
    print(f"{'stepper':8} {'a':>6} {'run-out':>8} {'law':>6} {'ratio':>6}")
    for number, stepper in enumerate(steppers):
        found[stepper] = []
        for aspect in aspects:
            a, way = mean(program, folder, stepper, aspect)
            found[stepper].append((a, way))
            print(f"{stepper:8} {a:6.2f} {way:8.2f} {law(a):6.2f} {way / law(a):6.2f}", flush=True)
        chart.add(stepper, *zip(*found[stepper]), number)
    ratios = [0.5 * 1.05**k for k in range(54)]
    chart.add("1.2 a and 1.9 a^(2/3), Lube et al.", ratios, [law(a) for a in ratios], 2, points=False)
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    chart.save(pathlib.Path(folder) / "runout.svg")
    return found


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    study(sys.argv[1], sys.argv[2], sys.argv[3:] or ["dvi", "dem"])
