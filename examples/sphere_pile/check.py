"""A pyramid of four spheres at rest: each upper contact carries W/3, each lower sphere stands with 4W/3 on the floor."""

import math

from checking import Check

G, STEP, R, DENSITY, MU = 9.81, 1e-3, 0.01, 7800.0, 0.6
SPACING = 2 * R + 0.02e-3  # between the lower spheres, which do not touch
TOLERANCE = 1e-9  # residual at which the solver stops [m/s]

with Check(__file__) as check:
    run = check.run()
    contacts, steps = run.table("contacts.csv"), run.table("steps.csv")
    weight = DENSITY * 4 / 3 * math.pi * R**3 * G * STEP  # of one sphere over a step [N s]

    last = [i for i, t in enumerate(contacts["time"]) if t == contacts["time"][-1]]
    floor = [i for i in last if contacts["body_a"][i] == 0]
    upper = [i for i in last if contacts["body_a"][i] != 0]
    check.holds("three spheres stand on the floor and carry the fourth; they do not touch each other",
                len(floor) == 3 and len(upper) == 3 and all(contacts["body_b"][i] == 4 for i in upper))

    def tangential(i):
        whole = [contacts[f"impulse_{axis}"][i] for axis in "xyz"]
        return math.sqrt(max(0.0, sum(c * c for c in whole) - contacts["impulse_normal"][i] ** 2))

    # Equilibrium, theta the angle of the upper normals from the vertical: no torque on a lower sphere makes the frictions of
    # its two contacts equal, T = N tan(theta / 2), and the upper sphere then needs N = W / 3; touching spheres have
    # sin(theta) = 1 / sqrt(3) and T = 0.10595 W. The solver's residual is 1e-7 of g h; 1e-5 leaves room for the
    # micrometres by which gaps differ at rest.
    theta = math.asin(SPACING / math.sqrt(3) / (2 * R))
    friction = weight / 3 * math.tan(theta / 2)
    close = 1e-5 * weight
    for n, i in enumerate(upper):
        check.near(f"upper contact {n + 1} carries W/3", contacts["impulse_normal"][i], weight / 3, close)
        check.near(f"upper contact {n + 1} needs the friction (W/3) tan(theta/2)", tangential(i), friction, close)
    for n, i in enumerate(floor):
        check.near(f"lower sphere {n + 1} stands with 4W/3", contacts["impulse_z"][i], 4 * weight / 3, close)
        check.near(f"lower sphere {n + 1} is held by the same friction", tangential(i), friction, close)
    check.near("the floor carries the whole weight", sum(contacts["impulse_z"][i] for i in floor), 4 * weight, close)

    check.holds("every step meets the residual that the scene asks for", max(steps["residual"]) <= TOLERANCE,
                f"{max(steps['residual']):.2g} m/s")
    track = run.table("track.csv")
    speeds = [math.sqrt(track["vx"][i] ** 2 + track["vy"][i] ** 2 + track["vz"][i] ** 2)
              for i, t in enumerate(track["time"]) if t > 0.1]
    check.holds("nothing moves faster than ten times the residual", max(speeds) <= 10 * TOLERANCE, f"{max(speeds):.2g} m/s")

    # Statics needs T <= mu N in the upper contacts: mu >= tan(theta / 2) = 0.318. Below it the pile falls.
    for mu, stands in ((1.02 * math.tan(theta / 2), True), (0.95 * math.tan(theta / 2), False)):
        track = check.run(f"mu_{mu:.3f}", material__steel__friction=mu, simulation__end_time=0.5).table("track.csv")
        drop = track["z"][1] - track["z"][-1]  # of the upper sphere, every second row
        check.holds(f"with mu = {mu:.3f} the pile {'stands' if stands else 'falls'}",
                    drop < 1e-6 if stands else drop > 1e-3, f"the upper sphere sinks {drop * 1e3:.2g} mm")
