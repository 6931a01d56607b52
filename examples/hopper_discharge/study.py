"""Discharge over four outlets: study.py PROGRAM FOLDER [STEPPER ...] prints rates and Beverloo's constants and draws beverloo.svg.

    W = C rho sqrt(g) (D - k d)^(5/2)            Beverloo, Leniger and van de Velde 1961, Chem. Eng. Sci. 15: 260-269

k and C follow from the line of W^(2/5) over D; the exponent is then the slope of ln W over ln(D - k d). k and the exponent
cannot both be told from rates with errors of a hundredth, since a greater k does nearly what a greater exponent does: so the
first is of the law's own exponent, and the second tells whether the rates follow the law with it.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))

from chart import Chart
from checking import Run, run_scene
from granular import line
from orifice import write_bottom

SCENE = pathlib.Path(__file__).resolve().parent / "scene.toml"
GRAVITY, GRAIN, CYLINDER = 9.81, 5e-3, 0.1   # d and the diameter of the hopper [m]
OUTLETS = {0.025: 2.0, 0.03: 2.0, 0.035: 1.7, 0.04: 1.25}  # end of the run [s]: before the bed is as shallow as the outlet is wide
OPENED = 0.25                                   # time at which the slide leaves [s]
GRAINS = 5000


def measure(program, folder, stepper, outlet, **settings):
    """Runs the scene with one outlet: dict of rate [kg/s], its standard error, drift over the window [1], bulk density [kg/m3]."""
    folder = pathlib.Path(folder) / f"{stepper}_{round(outlet * 1e3)}mm"
    folder.parent.mkdir(parents=True, exist_ok=True)
    bottom = folder.parent / f"bottom_{round(outlet * 1e3)}mm.obj"
    write_bottom(bottom, outlet)
    settings = {"time_stepper__type": stepper, "shape__bottom__file": bottom.resolve(), **settings}
    run_scene(program, SCENE, folder, settings)
    return rates(Run(folder))


def rates(run):
    """Batch means: the window from half a second on, in parts as long as the rows of the table."""
    flow, steps = run.table("mass_flow_outlet.csv"), run.table("steps.csv")
    start, end = 0.5, flow["time"][-1]
    total = {round(t, 6): a - b for t, a, b in zip(flow["time"], flow["mass_forward"], flow["mass_backward"])}
    times = sorted(t for t in total if t >= start - 1e-9)
    part = [(total[b] - total[a]) / (b - a) for a, b in zip(times, times[1:])]
    rate, n = sum(part) / len(part), len(part)
    error = math.sqrt(sum((p - rate) ** 2 for p in part) / (n - 1) / n)
    slope, _ = line([0.5 * (a + b) for a, b in zip(times, times[1:])], part)
    # Before the slide leaves, the bed is at rest and flat: twice the height of its centre is its depth.
    fed = next(table for table in run.json["tables"] if table["title"] == "particles by material")
    mass = float(fed["rows"][0][fed["header"].index("fed [kg]")])
    rest = max(i for i, t in enumerate(steps["time"]) if t < OPENED)
    depth = 2 * steps["potential_energy"][rest] / (mass * GRAVITY)
    return {"rate": rate, "error": error, "drift": slope * (end - start) / rate,
            "density": mass / (math.pi / 4 * CYLINDER**2 * depth)}


def beverloo(outlets, rate, density):
    """(C, k, exponent)."""
    slope, intercept = line(outlets, [w**0.4 for w in rate])
    k = -intercept / slope / GRAIN
    exponent, _ = line([math.log(d - k * GRAIN) for d in outlets], [math.log(w) for w in rate])
    return slope**2.5 / (density * math.sqrt(GRAVITY)), k, exponent


def study(program, folder, steppers):
    """Measures all outlets; prints, draws, and returns {stepper: (C, k, exponent)}."""
    chart = Chart("Discharge of a flat-bottomed hopper", "outlet D [mm]", "(mass flow W / (g/s))^(2/5)")
    found = {}
    print(f"{'stepper':8} {'D [mm]':>7} {'W [g/s]':>9} {'+-':>5} {'drift':>7} {'rho [kg/m3]':>12}")
    for number, stepper in enumerate(steppers):
        results = [measure(program, folder, stepper, outlet, source__beads__count=GRAINS, simulation__end_time=end)
                   for outlet, end in OUTLETS.items()]
        for outlet, r in zip(OUTLETS, results):
            print(f"{stepper:8} {outlet * 1e3:7.1f} {r['rate'] * 1e3:9.1f} {r['error'] * 1e3:5.1f} {r['drift']:7.3f} "
                  f"{r['density']:12.0f}")
        rate = [r["rate"] for r in results]
        density = sum(r["density"] for r in results) / len(results)
        c, k, exponent = found[stepper] = beverloo(list(OUTLETS), rate, density)
        print(f"{stepper:8} C = {c:.3f}, k = {k:.2f}, exponent {exponent:.3f}     (literature: C 0.55 to 0.65, k 1 to 2, 2.5)")
        chart.add(stepper, [d * 1e3 for d in OUTLETS], [(w * 1e3) ** 0.4 for w in rate], number)
        ends = (k * GRAIN, max(OUTLETS))
        law = [(c * density * math.sqrt(GRAVITY)) ** 0.4 * (d - k * GRAIN) * 1e3**0.4 for d in ends]
        chart.add(f"C = {c:.3f}, k = {k:.2f}", [d * 1e3 for d in ends], law, number, points=False)
    chart.save(pathlib.Path(folder) / "beverloo.svg")
    return found


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    study(sys.argv[1], sys.argv[2], sys.argv[3:] or ["dvi", "dem"])
