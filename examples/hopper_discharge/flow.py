"""What the check and the study of the hopper measure: the scene with an outlet, its rate with an error, and whether the level matters.

The hopper is 2.5 times as wide as the outlet, and the bed deeper than 1.2 times the hopper's width until the end: from there
on neither matters (Mankoc et al. 2007, Granular Matter 9: 407-414).
"""

import math
import pathlib

from beverloo import GRAVITY
from checking import Run, run_scene
from granular import line
from orifice import write_bottom

SCENE = pathlib.Path(__file__).resolve().parent / "scene.toml"
GRAIN, WIDER = 5e-3, 2.5                  # d [m]; hopper over outlet
OPENED, STEADY = 0.45, 0.7               # times at which the slide leaves, and from which on the flow is looked at [s]
BLOCKS = 16                              # of that window


def run(program, folder, stepper, outlet, seed=1, **settings):
    """Runs the scene with an outlet [m]: its results."""
    folder = pathlib.Path(folder) / f"{stepper}_{round(outlet * 1e3)}mm_{seed}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    bottom = folder.parent / f"bottom_{round(outlet * 1e3)}mm.obj"
    radius = 0.5 * WIDER * outlet
    write_bottom(bottom, outlet, 2 * radius + 0.01)
    side = (radius - 0.6 * GRAIN) / math.sqrt(2)
    run_scene(program, SCENE, folder, {
        "time_stepper__type": stepper, "simulation__seed": seed, "shape__bottom__file": bottom.resolve(),
        "shape__cylinder__radius": radius, "observer__outlet__gate__radius": outlet,
        "source__beads__lower": [-side, -side, 1e-3], "source__beads__upper": [side, side, 0.8], **settings})
    return Run(folder)


def blocks(result):
    """The steady window in parts: (rates [kg/s], masses in the hopper, middle of each [kg], number of grains that left)."""
    flow = result.table("mass_flow_outlet.csv")
    fed = mass_fed(result)
    rows = [i for i, t in enumerate(flow["time"]) if t > STEADY - 1e-9]
    ends = [rows[round(b * (len(rows) - 1) / BLOCKS)] for b in range(BLOCKS + 1)]
    out = [flow["mass_forward"][i] - flow["mass_backward"][i] for i in ends]
    time = [flow["time"][i] for i in ends]
    rate = [(b - a) / (t - s) for a, b, s, t in zip(out, out[1:], time, time[1:])]
    return rate, [fed - 0.5 * (a + b) for a, b in zip(out, out[1:])], flow["number_forward"][ends[-1]] - flow["number_forward"][ends[0]]


def mass_fed(result):
    table = next(table for table in result.json["tables"] if table["title"] == "particles by material")
    return float(table["rows"][0][table["header"].index("fed [kg]")])


def density(result, outlet):
    """Bulk density of the bed before the slide leaves [kg/m3]: it is flat then, and twice the height of its centre deep."""
    steps, mass = result.table("steps.csv"), mass_fed(result)
    rest = max(i for i, t in enumerate(steps["time"]) if t < OPENED)
    depth = 2 * steps["potential_energy"][rest] / (mass * GRAVITY)
    return mass / (math.pi / 4 * (WIDER * outlet) ** 2 * depth)


def measure(results, outlet):
    """Of runs with the same outlet and other seeds: a dict.

    rate, error     mean over all blocks and its standard error (batch means) [kg/s]
    level, level_error  exponent p of rate ~ (mass in the hopper)^p, and its standard error; a liquid has 1/2 (Torricelli)
    burst           variance of the number in a block over that of independent grains (1)
    density         of the bed at rest [kg/m3]; `depth`: of the bed at the end, in diameters of the hopper
    """
    parts = [blocks(r) for r in results]
    rate = [w for p in parts for w in p[0]]
    mass = [m for p in parts for m in p[1]]
    n, mean = len(rate), sum(rate) / len(rate)
    x, y = [math.log(m) for m in mass], [math.log(w) for w in rate]
    p, intercept = line(x, y)
    spread = sum((a - sum(x) / n) ** 2 for a in x)
    scatter = sum((b - p * a - intercept) ** 2 for a, b in zip(x, y)) / (n - 2)
    grains = sum(part[2] for part in parts) / n
    rho = sum(density(r, outlet) for r in results) / len(results)
    wide = WIDER * outlet
    return {"rate": mean, "error": math.sqrt(sum((w - mean) ** 2 for w in rate) / (n - 1) / n), "level": p,
            "level_error": math.sqrt(scatter / spread), "burst": scatter * grains, "density": rho,
            "depth": min(mass) / rho / (math.pi / 4 * wide**2) / wide}
