"""Grains run out at a constant rate, whatever their level, and about as fast as Beverloo's law says; dvi and dem agree.

`full` is the study over four outlets: the exponent of the law.
"""

import math

from checking import STEPPERS, Check
from study import GRAIN, GRAVITY, measure, study

OUTLET = 0.035
CHECK = {"source__beads__count": 3000, "simulation__end_time": 1.0}


def law(outlet, c, k, density):
    return c * density * math.sqrt(GRAVITY) * (outlet - k * GRAIN) ** 2.5


with Check(__file__) as check:
    if check.full:
        for stepper, (c, k, exponent) in study(check.program, check.folder, STEPPERS).items():
            check.near(f"{stepper}: the flow goes with (D - k d)^2.5", exponent, 2.5, 0.1)
            check.holds(f"{stepper}: k is in the range of the literature, 1 to 2", 1.0 < k < 2.0, f"{k:.2f}")
            # 0.55 to 0.65 is the range over materials; it falls with friction and with the bulk density one divides by.
            check.holds(f"{stepper}: C is within a fifth of its range, 0.55 to 0.65", 0.44 < c < 0.78, f"{c:.3f}")
    else:
        rate = {}
        for stepper in STEPPERS:
            r = measure(check.program, check.folder, stepper, OUTLET, **CHECK)
            rate[stepper] = r["rate"]
            # The slope through ten blocks that scatter by 8 % has a standard error of 9 % of the rate over the window.
            check.near(f"{stepper}: the rate does not change while the level falls", r["drift"], 0.0, 0.25)
            low, high = law(OUTLET, 0.55, 2.0, r["density"]), law(OUTLET, 0.65, 1.0, r["density"])
            check.holds(f"{stepper}: the rate is one of C = 0.55 to 0.65, k = 1 to 2, to a fifth", 0.8 * low < r["rate"] < 1.2 * high,
                        f"{r['rate'] * 1e3:.0f} +- {r['error'] * 1e3:.0f} g/s, between {low * 1e3:.0f} and {high * 1e3:.0f}")
        check.holds("rates of all steppers are within 15 % of each other", max(rate.values()) < 1.15 * min(rate.values()))
