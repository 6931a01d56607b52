"""A column runs as far as the laws of its aspect ratio say, on both of their branches."""

from checking import STEPPERS, Check
from study import KINK, law, study

with Check(__file__) as check:
    aspects = {} if check.full else {"aspects": (1.0, 3.0)}
    for stepper, found in study(check.program, check.folder, STEPPERS, **aspects).items():
        for branch, low in (("1.2 a", True), ("1.9 a^(2/3)", False)):
            # A single column scatters by a twentieth about its branch: of several, their mean.
            ratios = [way / law(a) for a, way in found if (a < KINK) == low]
            # What experiments with sand, sugar and beads scatter by.
            check.near(f"{stepper}: columns run by {branch}, to 15 %", sum(ratios) / len(ratios), 1.0, 0.15)
