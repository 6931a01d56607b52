"""A ball on a slope of heights: x'' = 5/7 g sin(theta) along the slope, as on a plane (rolling, solid sphere)."""

import math

from checking import Check

G, SLOPE, R = 9.81, 0.2, 0.02
SIN, COS = SLOPE / math.hypot(1, SLOPE), 1 / math.hypot(1, SLOPE)

with Check(__file__) as check:
    for step in (1e-3, 0.5e-3):
        ball = check.run(f"step_{step}", simulation__time_step=step).table("track.csv")
        speed = [COS * vx - SIN * vz for vx, vz in zip(ball["vx"], ball["vz"])]
        # A new contact, on a plane the first one and here one a triangle, yields by a tenth of a step's fall, g h^2 / 10, and
        # has it back in the next step: both errors fall with h^2.
        dip = 0.11 * G * step**2
        check.near(f"h = {step}: speed after {ball['time'][-1]} s", speed[-1], 5 / 7 * G * SIN * ball["time"][-1],
                   10 * dip)
        height = [COS * (z - 0.08) + SIN * x for x, z in zip(ball["x"], ball["z"])]
        check.near(f"h = {step}: it never lifts off and never sinks in", max(abs(h - R) for h in height), 0, dip)
        check.near(f"h = {step}: it does not turn aside", max(abs(y - 0.042) for y in ball["y"]), 0, 1e-9)
        check.near(f"h = {step}: it rolls and does not slip", ball["wy"][-1], speed[-1] / R, 1e-3 * speed[-1] / R)
        check.near(f"h = {step}: it has come far enough to have met many cells",
                   float(ball["x"][-1] - ball["x"][0] > 0.15), 1, 0)
