"""The angle of repose in a turning drum: steady, the same with every stepper; the bed mixes.

`full` turns for longer and draws angle.svg: the angle over friction.
"""

from math import pi

from chart import Chart
from checking import STEPPERS, Check
from granular import frames, slope_angle

RADIUS, GRAIN, STEADY = 0.05, 5e-3, 1.2  # [m], [m]; time from which on the surface is steady [s]


def angles(track):
    """Angle of the surface [deg] at every look once it is steady, of the middle of the drum."""
    found = []
    for _, rows in frames(track, STEADY):
        grains = [i for i in rows if track["id"][i] > 0]
        x, y = ([track[key][i] for i in grains] for key in "xy")
        found.append(-slope_angle(x, y, GRAIN, -0.5 * RADIUS, 0.5 * RADIUS))
    return found


def mean(values):
    return sum(values) / len(values)


with Check(__file__) as check:
    settings = {"simulation__end_time": 6.0} if check.full else {}
    angle, mixed = {}, {}
    for stepper in STEPPERS:
        run = check.run(stepper, time_stepper__type=stepper, **settings)
        found, mixing = angles(run.table("track.csv")), run.table("mixing.csv")
        angle[stepper], mixed[stepper] = mean(found), mixing["lacey_index"][-1]
        half = len(found) // 2
        # A look has a spread of 4 degrees, since grains are a twentieth of the surface; looks follow each other in a tenth of the
        # time that a grain takes down the slope, so that ten of them count as few.
        check.near(f"{stepper}: the surface is steady: the second half of the time against the first", mean(found[half:]),
                   mean(found[:half]), 3.0)
        turned = 15 / 60 * 2 * pi * (run.table("steps.csv")["time"][-1] - 0.45)
        check.holds(f"{stepper}: the bed mixes", mixing["lacey_index"][-1] > mixing["lacey_index"][0] + 0.2,
                    f"Lacey's index from {mixing['lacey_index'][0]:.2f} to {mixing['lacey_index'][-1]:.2f} in {turned / 2 / pi:.2f} turns; "
                    f"angle {angle[stepper]:.1f} degrees")
    check.holds("angles of all steppers are within 2 degrees", max(angle.values()) - min(angle.values()) < 2.0,
                ", ".join(f"{name} {value:.2f}" for name, value in angle.items()))
    check.holds("and mixing within 0.15", max(mixed.values()) - min(mixed.values()) < 0.15)

    if check.full:
        chart = Chart("Dynamic angle of repose", "friction", "angle [deg]")
        frictions = (0.1, 0.2, 0.3, 0.5, 0.8)
        series = {}
        for number, stepper in enumerate(STEPPERS):
            over = series[stepper] = []
            for mu in frictions:
                run = check.run(f"{stepper}_{mu}", time_stepper__type=stepper, material__glass__friction=mu,
                                material__dark_glass__friction=mu, simulation__end_time=4.0)
                over.append(mean(angles(run.table("track.csv"))))
            print(f"{stepper}: " + ", ".join(f"friction {mu} {a:.1f} degrees" for mu, a in zip(frictions, over)))
            check.holds(f"{stepper}: the angle grows with friction", all(b > a for a, b in zip(over, over[1:])))
            chart.add(stepper, frictions, over, number)
        for mu, *both in zip(frictions, *series.values()):
            check.holds(f"friction {mu}: angles of all steppers are within 2 degrees", max(both) - min(both) < 2.0,
                        ", ".join(f"{a:.2f}" for a in both))
        chart.save(check.folder / "angle.svg")
