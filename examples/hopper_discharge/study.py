"""Discharge over four outlets: study.py PROGRAM FOLDER [STEPPER ...] prints rates and what they tell of two laws, and draws beverloo.svg.

Fitted to the rates, with their errors (beverloo.py):

    k        of the law with its own exponent, 5/2
    n        the exponent, with the k of the literature
    k and n  together: a greater k does nearly what a greater exponent does, so that four outlets hardly tell them apart; the
             standard errors say how well
    Mankoc   the law of Mankoc et al., which has k = 1 and a correction for small outlets; only its C' is fitted
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))

import beverloo
import flow
from chart import Chart

# Outlet [m]: number of grains, end of the run [s]. The bed ends 1.0 to 1.3 diameters of the hopper deep, after 2200 to 3900 grains.
OUTLETS = {0.025: (4200, 4.3), 0.032: (7000, 2.6), 0.042: (13500, 1.6), 0.055: (27500, 1.2)}
SEEDS = (1,)


def rates(program, folder, stepper):
    """Runs and measures all outlets: {outlet: what flow.measure says}."""
    found = {}
    for outlet, (grains, end) in OUTLETS.items():
        runs = [flow.run(program, folder, stepper, outlet, seed, source__beads__count=grains, simulation__end_time=end,
                         ccp_solver__max_iterations=300) for seed in SEEDS]
        r = found[outlet] = flow.measure(runs, outlet)
        print(f"{stepper:8} {outlet * 1e3:7.1f} {r['rate'] * 1e3:9.1f} {r['error'] * 1e3:5.1f} {r['level']:9.2f} {r['level_error']:5.2f} "
              f"{r['burst']:7.2f} {r['density']:12.0f} {r['depth']:6.2f}", flush=True)
    return found


def laws(found):
    """All fits to the rates of a stepper, by name; `density`: mean of the beds."""
    outlets, density = list(found), sum(r["density"] for r in found.values()) / len(found)
    data = (outlets, flow.GRAIN, [r["rate"] for r in found.values()], [r["error"] for r in found.values()], density)
    fits = {name: beverloo.fit(*data, free) for name, free in {"k": "k", "n": "n", "k and n": "kn"}.items()}
    return {**fits, "Mankoc": beverloo.fit_mankoc(*data), "density": density}


def show(stepper, fits):
    for name in ("k", "n", "k and n", "Mankoc"):
        fit = fits[name]
        values = ", ".join(f"{key} = {fit[key]:.3f}" + (f" +- {fit['errors'][key]:.3f}" if key in fit["errors"] else "")
                           for key in ("C", "k", "n") if key in fit)
        print(f"{stepper:8} {name:8} {values}; misfit {fit['misfit'][0]:.1f} of {fit['misfit'][1]}")


def draw(folder, found, fits):
    """Rates to the power 2/5, in which Beverloo's law is a line; the law of Mankoc et al. dashed."""
    chart = Chart("Discharge of a flat-bottomed hopper", "outlet D [mm]", "(mass flow W / (g/s))^(2/5)")
    for number, (stepper, rate) in enumerate(found.items()):
        line, curve, density = fits[stepper]["k"], fits[stepper]["Mankoc"], fits[stepper]["density"]
        unit = density * math.sqrt(flow.GRAVITY) * flow.GRAIN**2.5 * 1e3  # [g/s]
        chart.add(stepper, [d * 1e3 for d in rate], [(r["rate"] * 1e3) ** 0.4 for r in rate.values()], number)
        ends = (line["k"], max(rate) / flow.GRAIN)
        chart.add(f"{stepper}: C = {line['C']:.3f}, k = {line['k']:.2f}", [x * flow.GRAIN * 1e3 for x in ends],
                  [(line["C"] * unit) ** 0.4 * (x - line["k"]) for x in ends], number, points=False)
        ratios = [1 + i * (ends[1] - 1) / 40 for i in range(41)]
        shape = [(1 - 0.5 * math.exp(-beverloo.B_LITERATURE * (x - 1))) * (x - 1) ** 2.5 for x in ratios]
        chart.add(f"{stepper}: Mankoc et al., C' = {curve['C']:.3f}", [x * flow.GRAIN * 1e3 for x in ratios],
                  [(curve["C"] * unit * s) ** 0.4 for s in shape], number, points=False, dashed=True)
    chart.save(pathlib.Path(folder) / "beverloo.svg")


def study(program, folder, steppers):
    """Measures all outlets, prints, draws; returns {stepper: rates} and {stepper: fits}."""
    print(f"{'stepper':8} {'D [mm]':>7} {'W [g/s]':>9} {'+-':>5} {'level p':>9} {'+-':>5} {'burst':>7} {'rho [kg/m3]':>12} {'depth':>6}")
    found = {stepper: rates(program, folder, stepper) for stepper in steppers}
    fits = {stepper: laws(rate) for stepper, rate in found.items()}
    for stepper in steppers:
        show(stepper, fits[stepper])
    print("literature: C 0.55 to 0.65, k 1 to 2 (1.4 in the mean of Beverloo et al.), n 5/2")
    draw(folder, found, fits)
    return found, fits


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    study(sys.argv[1], sys.argv[2], sys.argv[3:] or ["dvi", "dem"])
