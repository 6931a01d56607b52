"""The heap that stays on a tray: its angle grows with friction, and is about the same with every stepper.

`full` makes two heaps of each kind, over more frictions, with and without resistance to rolling, and draws angle.svg.
"""

from math import hypot

from chart import Chart
from checking import STEPPERS, Check
from heap import angles, grains, mean_and_error


def sectors(check, stepper, friction, rolling, seed):
    """Angles of the sectors of one heap [deg]."""
    run = check.run(f"{stepper}_{friction}_{rolling * 1e3:g}_{seed}", time_stepper__type=stepper, simulation__seed=seed,
                    material__glass__friction=friction, material__glass__rolling_friction=rolling)
    track = run.table("track.csv")
    heap = grains(track)
    check.holds(f"{stepper}, friction {friction}: the heap covers the tray, what was too much is gone",
                0 < len(heap) < len({b for b in track["id"]}) - 10, f"{len(heap)} grains")
    return angles(heap)


def grows(check, stepper, found):
    """Without resistance to rolling the angle levels off above 0.5: it may fall there by what two angles scatter."""
    steps = [b - a + 2 * hypot(da, db) for (a, da), (b, db) in zip(found, found[1:])]
    rise, error = found[-1][0] - found[0][0], hypot(found[0][1], found[-1][1])
    check.holds(f"{stepper}: the angle grows with friction", rise > 3 * error and min(steps) > 0.0, f"by {rise:.1f} +- {error:.1f} degrees")


def agree(check, what, first, second):
    """Within the two degrees that drums are asked for, and twice the standard error of the difference."""
    difference, error = second[0] - first[0], hypot(first[1], second[1])
    check.holds(f"{what}: the steppers' angles are the same to 2 degrees and two standard errors", abs(difference) < 2.0 + 2 * error,
                f"{difference:.1f} +- {error:.1f} degrees")
    check.holds("   and heaps are enough to tell 2 degrees from 5", error < 1.5)


with Check(__file__) as check:
    frictions, seeds = ((0.1, 0.3, 0.8), (1, 2)) if check.full else ((0.1, 0.5), (1,))
    chart = Chart("Angle of repose of a heap", "friction", "angle [deg]")
    number = 0
    for rolling in (0.0, 0.25e-3) if check.full else (0.0,):
        over = {}
        for stepper in STEPPERS:
            found = over[stepper] = [mean_and_error([a for seed in seeds for a in sectors(check, stepper, mu, rolling, seed)])
                                     for mu in frictions]
            print(f"{stepper}, rolling friction {rolling * 1e3:g} mm: "
                  + ", ".join(f"friction {mu} {a:.1f} +- {da:.1f} degrees" for mu, (a, da) in zip(frictions, found)))
            grows(check, stepper, found)
            chart.add(f"{stepper}, rolling friction {rolling * 1e3:g} mm", frictions, [a for a, _ in found], number)
            number += 1
        for mu, *both in zip(frictions, *over.values()):
            agree(check, f"friction {mu}, rolling friction {rolling * 1e3:g} mm", *both)
    chart.save(check.folder / "angle.svg")
