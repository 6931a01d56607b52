"""Impacts by the whole program: oblique ones on linear springs, and tests 1 to 4 of Chung and Ooi (2011)."""

from math import cos, pi, radians, sin, tan

from checking import Check


def overlap_history(times, overlaps):
    """Greatest overlap, and the time between the crossings of zero, by straight lines between rows."""
    def crossing(i):
        return times[i] + (times[i + 1] - times[i]) * overlaps[i] / (overlaps[i] - overlaps[i + 1])

    inside = [i for i, x in enumerate(overlaps) if x > 0.0]
    return max(overlaps), crossing(inside[-1]) - crossing(inside[0] - 1)


def greatest_force(times, speeds, mass):
    return max(mass * (b - a) / (t - s) for s, t, a, b in zip(times, times[1:], speeds, speeds[1:]))


def sphere(radius, density):
    return density * 4 / 3 * pi * radius**3


def oblique(check):
    # An independent integration of the same equations gave u' and R w'. R w' is 5/2 of what u' changes by.
    for what, tail, along, surface in (("with friction in tension", True, 0.468103, -0.597510),
                                       ("without", False, 0.464706, -0.606001)):
        ball = check.run(f"oblique_{tail}", contact_law__friction_in_tension=tail).table("track.csv")
        check.near(f"oblique, {what}: u'", ball["vx"][-1], along, 3e-6)
        check.near(f"oblique, {what}: R w'", -1e-3 * ball["wy"][-1], surface, 6e-6)
        check.near(f"oblique, {what}: e", ball["vz"][-1], 0.7 * 0.5**0.5, 2e-6)


def two_spheres(check):
    run = check.run("test_1", check.scene.with_name("two_spheres.toml")).table("track.csv")
    left = [i for i, identity in enumerate(run["id"]) if identity == run["id"][0]]
    times, x = [run["time"][i] for i in left], [run["x"][i] for i in left]
    depth, time = overlap_history(times, [2 * (0.01 + x_left) for x_left in x])
    check.near("test 1: overlap [m]", depth, 274.1e-6, 2.7e-6)
    check.near("test 1: time [s]", time, 40.34e-6, 0.4e-6)
    force = greatest_force(times, [-run["vx"][i] for i in left], sphere(0.01, 2800))
    check.near("test 1: force [N]", force, 10.697e3, 107)


def elastic(check, name, **settings):
    return check.run(name, check.scene.with_name("elastic.toml"), **settings).table("track.csv")


def on_a_wall(check):
    ball = elastic(check, "test_2")
    depth, time = overlap_history(ball["time"], [0.1 - z for z in ball["z"]])
    check.near("test 2: overlap [m]", depth, 49.72e-6, 0.5e-6)
    check.near("test 2: time [s]", time, 731.7e-6, 7.3e-6)
    check.near("test 2: force [N]", greatest_force(ball["time"], ball["vz"], sphere(0.1, 2699)), 11.37e3, 114)

    def oxide(degrees, e):
        return {"material__alloy__young_modulus": 380e9, "material__alloy__poisson_ratio": 0.23,
                "material__alloy__density": 4000, "material__alloy__friction": 0.092, "shape__ball__radius": 2.5e-3,
                "material__alloy__restitution": e, "simulation__end_time": 40e-6, "simulation__time_step": 1e-6,
                "time_stepper__sub_step": 1e-8, "body__ball__position": "[0.0, 0.0, 2.501e-3]",
                "body__ball__velocity": f"[{3.9 * sin(radians(degrees))}, 0.0, {-3.9 * cos(radians(degrees))}]"}

    for e in (0.2, 0.6, 1.0):
        check.near(f"test 3: e = {e}", elastic(check, f"test_3_{e}", **oxide(0, e))["vz"][-1] / 3.9, e, 1e-3)
    mu, e = 0.092, 0.98
    for degrees in (40, 60, 80):
        ball, t = elastic(check, f"test_4_{degrees}", **oxide(degrees, e)), tan(radians(degrees))
        w = 2.5 * mu * (1 + e) * 3.9 * cos(radians(degrees)) / 2.5e-3
        check.near(f"test 4, {degrees} deg: e_t", ball["vx"][-1] / (3.9 * sin(radians(degrees))), 1 - mu * (1 + e) / t,
                   0.01)
        check.near(f"test 4, {degrees} deg: spin [rad/s]", ball["wy"][-1], w, 0.01 * w)


def adhesion(check):
    # JKR: the neck takes 7.09 (w^5 R^4 / E^2)^(1/3) from an elastic impact; what comes slower than that stays.
    w, radius, modulus = 0.1, 1e-3, 1e7 / (1 - 0.3**2)
    work = (4.8 * 4 ** (1 / 3) + 0.8) * 0.5 * pi * (pi / 8) ** (2 / 3) * (w**5 * radius**4 / modulus**2) ** (1 / 3)
    sticks = (2 * work / sphere(radius, 1000)) ** 0.5
    for factor in (0.8, 2.0):
        ball = elastic(check, f"jkr_{factor}", contact_law__cohesion="jkr", material__alloy__young_modulus=1e7,
                       material__alloy__density=1000, material__alloy__surface_energy=w,
                       material__wall__surface_energy=w, shape__ball__radius=radius, simulation__end_time=5e-3,
                       simulation__time_step=1e-5, time_stepper__sub_step=1e-7,
                       body__ball__position="[0.0, 0.0, 1.001e-3]", body__ball__velocity=[0, 0, -factor * sticks])
        if factor > 1:
            check.near("JKR: an elastic impact loses the work of the neck", ball["vz"][-1] / sticks,
                       (factor**2 - 1) ** 0.5, 0.01)
        else:
            check.holds("JKR: a slower one stays", abs(ball["z"][-1] - radius) < 0.01 * radius, f"z = {ball['z'][-1]}")


with Check(__file__) as check:
    oblique(check)
    two_spheres(check)
    on_a_wall(check)
    adhesion(check)
