"""The heap that stays on a tray: its angle grows with friction, and is about the same with every stepper.

`full` goes over more frictions, with and without resistance to rolling, and draws angle.svg.
"""

from math import hypot

from chart import Chart
from checking import STEPPERS, Check
from granular import frames, slope_angle

GRAIN, INNER, OUTER = 5e-3, 0.005, 0.045  # [m]; radii between which the surface is a cone


def angle(check, stepper, friction, rolling=0.0):
    run = check.run(f"{stepper}_{friction}_{rolling * 1e3:g}", time_stepper__type=stepper, material__glass__friction=friction,
                    material__glass__rolling_friction=rolling)
    track = run.table("track.csv")
    _, last = frames(track)[-1]
    heap = [i for i in last if track["z"][i] > 0.0]
    check.holds(f"{stepper}, friction {friction}: the heap covers the tray, what was too much is gone",
                0 < len(heap) < len({b for b in track["id"]}) - 10, f"{len(heap)} grains")
    return -slope_angle([hypot(track["x"][i], track["y"][i]) for i in heap], [track["z"][i] for i in heap], GRAIN, INNER, OUTER)


with Check(__file__) as check:
    frictions = (0.1, 0.2, 0.3, 0.5, 0.8) if check.full else (0.1, 0.5)
    chart = Chart("Angle of repose of a heap", "friction", "angle [deg]")
    number = 0
    for rolling in (0.0, 0.25e-3) if check.full else (0.0,):
        over = {stepper: [angle(check, stepper, mu, rolling) for mu in frictions] for stepper in STEPPERS}
        for stepper, found in over.items():
            print(f"{stepper}, rolling friction {rolling * 1e3:g} mm: "
                  + ", ".join(f"friction {mu} {a:.1f} degrees" for mu, a in zip(frictions, found)))
            # One heap scatters by a degree or two; without resistance to rolling the angle levels off above 0.5.
            check.holds(f"{stepper}: the angle grows with friction",
                        found[-1] > found[0] + 3 and all(b > a - 1.5 for a, b in zip(found, found[1:])))
            chart.add(f"{stepper}, rolling friction {rolling * 1e3:g} mm", frictions, found, number)
            number += 1
        for k, mu in enumerate(frictions):
            both = [found[k] for found in over.values()]
            check.holds(f"friction {mu}: all steppers are within 5 degrees", max(both) - min(both) < 5.0)
    chart.save(check.folder / "angle.svg")
