"""The machine's parts go as their motors say, whatever falls on them, and metals and plastics part as on the plain separator.

A fifth of the feed for 1 s; `full` takes all of it for 2 s.
"""

from math import pi, radians, sqrt

from checking import Check

RPM = 2 * pi / 60
SPEEDS = {"roll_axle": -44.8 * RPM, "brush_axle": -300 * RPM}
SETTINGS = {"plastic_hinge": radians(5), "metal_hinge": radians(-5)}


def landing(run, name):
    """Mean position, its standard error, and the number of the grains of a material."""
    bins = run.table("bins_collector.csv")
    number = bins[f"number_{name}"]
    count = sum(number)
    mean = sum(n * x for n, x in zip(number, bins["x"])) / count
    return mean, sqrt(sum(n * (x - mean) ** 2 for n, x in zip(number, bins["x"])) / (count - 1) / count), count


with Check(__file__) as check:
    run = check.run(simulation__end_time=2.0 if check.full else 1.0, source__feed__rate=10000 if check.full else 2000,
                    observer__vtk__interval=1)
    joints, steps = run.table("joints.csv"), run.table("steps.csv")
    rows = {name: [i for i, of in enumerate(joints["name"]) if of == name] for name in set(joints["name"])}
    for name, speed in SPEEDS.items():
        worst = max(abs(joints["angular_speed"][i] - speed) for i in rows[name])
        # The limit of the torque leaves the speed to the solver's tolerance, which is taken out where the limit is not reached.
        check.holds(f"{name} turns as its motor says", worst < 1e-9 * abs(speed) + 1e-10, f"off by {worst:.2g} rad/s")
    for name, angle in SETTINGS.items():
        check.near(f"{name} stands where it was set", joints["rotation"][rows[name][-1]], angle, 1e-10)
    worst = max(joints["error"])
    check.holds("joints hold to rounding", worst < 1e-12, f"{worst:.2g} m")

    last = {name: joints["energy"][of[-1]] for name, of in rows.items()}
    check.holds("the roll's motor works against the grains", last["roll_drive"] > 0.0, f"{last['roll_drive']:.3g} J")
    metal, plastic = landing(run, "metal"), landing(run, "plastic")
    apart = (metal[0] - plastic[0]) / sqrt(metal[1] ** 2 + plastic[1] ** 2)
    check.holds("metals land farther than plastics by more than 10 standard errors", apart > 10,
                f"{apart:.1f}, of {metal[2]:.0f} and {plastic[2]:.0f} grains")
    kinetic = max(steps["kinetic_energy"]) - steps["kinetic_energy"][0]
    check.holds("nothing gains energy from the machine's joints", kinetic < 5.0, f"{kinetic:.3g} J")
