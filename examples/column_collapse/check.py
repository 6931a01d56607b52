"""A column runs as far as the laws of its aspect ratio say, on both of their branches."""

from checking import STEPPERS, Check
from study import law, study

with Check(__file__) as check:
    aspects = {} if check.full else {"aspects": (1.0, 3.0)}
    for stepper, found in study(check.program, check.folder, STEPPERS, **aspects).items():
        for a, way in found:
            branch = "1.2 a" if a < 2.3 else "1.9 a^(2/3)"
            # What experiments with sand, sugar and beads scatter by.
            check.near(f"{stepper}: a column of a = {a:.2f} runs by {branch}, to 15 %", way, law(a), 0.15 * law(a))
