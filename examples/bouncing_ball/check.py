"""A ball from 1 m with restitution e: it lands at t1 = sqrt(2 H / g), rises to e^(2n) H, rests at t1 (1 + e) / (1 - e)."""

from math import sqrt

from checking import Check

H, G, E, STEP = 1.0, 9.81, 0.5, 1e-3

with Check(__file__) as check:
    ball = check.run().table("track.csv")
    time = ball["time"]
    height = [z - 0.01 for z in ball["z"]]
    speed = ball["vz"]

    # An impact is a step in which the velocity turns upwards. A step resolves its time to one step.
    impacts = [i for i in range(1, len(time)) if speed[i] > 0.05 and speed[i - 1] < 0.0]
    first = sqrt(2 * H / G)
    check.near("the first impact comes after sqrt(2 H / g), to two steps", time[impacts[0]], first, 2 * STEP)

    # Peak n: first order in the step. The impact is found up to one step late, which changes the speed by g h.
    for n in range(1, 4):
        peak = max(height[impacts[n - 1]:impacts[n]])
        expected = H * E ** (2 * n)
        check.near(f"peak {n} reaches e^{2 * n} H, to first order in the step", peak, expected,
                   6 * STEP * sqrt(2 * G * expected))

    rest = next(t for t, v in zip(reversed(time), reversed(speed)) if abs(v) > 1e-6) + STEP
    expected = first * (1 + E) / (1 - E)
    # Below the minimum bounce speed of 0.1 m/s the ball stops bouncing: the last 2 v / g = 20 ms (1 + e) are cut off.
    check.near("it rests at t1 (1 + e) / (1 - e)", rest, expected, 0.05)
    check.near("it rests on the floor, to a micrometre", height[-1], 0.0, 1e-6)
