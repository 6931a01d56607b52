"""Grains run out at a constant rate, whatever their level, and about as fast as Beverloo's law says; dvi and dem agree.

`full` is the study over four outlets: the exponent of the law.
"""

from math import hypot, sqrt

from checking import STEPPERS, Check
from flow import GRAIN, GRAVITY, measure, run
from study import study

OUTLET = 0.028


def constant(check, name, p, error):
    """The rate goes with the level to the power p: 0 for grains, 1/2 for a liquid (Torricelli).

    p is judged by its own standard error, from the scatter of sixteen parts of the window: one in 800 constant flows lies beyond four
    of them (Student's t, 14 degrees of freedom), and one in 200 of a liquid's below the second bound.
    """
    check.holds(f"{name}: the rate does not change while the level falls", abs(p) < 4 * error, f"level^({p:.3f} +- {error:.3f})")
    check.holds("   and a liquid's would be told from it", 0.5 - p > 3 * error)


def one_outlet(check):
    rates = {}
    for stepper in STEPPERS:
        r = rates[stepper] = measure([run(check.program, check.folder, stepper, OUTLET)], OUTLET)
        constant(check, stepper, r["level"], r["level_error"])
        low, high = (c * r["density"] * sqrt(GRAVITY) * (OUTLET - k * GRAIN) ** 2.5 for c, k in ((0.55, 2.0), (0.65, 1.0)))
        check.holds(f"{stepper}: the rate is one of C = 0.55 to 0.65, k = 1 to 2", low < r["rate"] < high,
                    f"{r['rate'] * 1e3:.0f} +- {r['error'] * 1e3:.1f} g/s, between {low * 1e3:.0f} and {high * 1e3:.0f}")
        # Grains do not leave one by one at random: they are packed, which evens out their number.
        check.holds(f"{stepper}: numbers scatter less than those of independent grains", r["burst"] < 1.0, f"{r['burst']:.2f} of it")
    # By the law a rate goes with the density of its bed, which the steppers pack differently: soft grains bounce until they lie closer.
    both = [(r["rate"] / r["density"], r["error"] / r["rate"]) for r in rates.values()]
    apart, error = abs(both[1][0] / both[0][0] - 1), hypot(both[0][1], both[1][1])
    check.holds("rates over densities of all steppers are the same to 5 % and three standard errors", apart < 0.05 + 3 * error,
                f"{apart:.3f} +- {error:.3f}")


def four_outlets(check):
    found, fits = study(check.program, check.folder, STEPPERS)
    for stepper, rates in found.items():
        # The mean over the outlets, weighted with their errors.
        weight = [r["level_error"] ** -2 for r in rates.values()]
        p = sum(w * r["level"] for w, r in zip(weight, rates.values())) / sum(weight)
        constant(check, stepper, p, sum(weight) ** -0.5)
        fit = fits[stepper]
        check.near(f"{stepper}: the exponent, with k = 1.4 of the literature", fit["n"]["n"], 2.5, 0.1)
        check.holds(f"{stepper}: k, with the exponent 5/2, is in the range of the literature, 1 to 2", 1.0 < fit["k"]["k"] < 2.0)
        check.holds(f"{stepper}: C is within a tenth of its range, 0.55 to 0.65", 0.495 < fit["k"]["C"] < 0.715, f"{fit['k']['C']:.3f}")
        error = fit["k and n"]["errors"]["n"]
        check.holds(f"{stepper}: four outlets tell the exponent to a quarter, k being unknown", error < 0.25, f"{error:.2f}")
        # One in a thousand sets of four rates with such errors misses its law by more (chi^2, three degrees of freedom).
        check.holds(f"{stepper}: rates follow the law of Mankoc et al. within their errors", fit["Mankoc"]["misfit"][0] < 16.3,
                    f"{fit['Mankoc']['misfit'][0]:.1f}")


with Check(__file__) as check:
    if check.full:
        four_outlets(check)
    else:
        one_outlet(check)
