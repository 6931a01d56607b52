"""A sliding sphere rolls after t = 2 v0 / (7 mu g), at x = 12 v0^2 / (49 mu g), with v = 5/7 v0."""

from checking import Check

G, MU, V0, R = 9.81, 0.2, 1.0, 0.02

with Check(__file__) as check:
    for step in (2e-3, 1e-3, 0.5e-3):
        ball = check.run(f"step_{step}", simulation__time_step=step).table("track.csv")
        # Angular momentum about the contact is conserved by friction in every step, so 5/7 holds for any step.
        check.near(f"h = {step}: it ends with 5/7 of its speed, for any step", ball["vx"][-1], 5 / 7 * V0, 1e-7)
        rolls = next(i for i in range(len(ball["time"])) if abs(ball["vx"][i] - R * ball["wy"][i]) < 1e-6)
        check.near(f"h = {step}: it rolls after 2 v0 / (7 mu g), to one step", ball["time"][rolls],
                   2 * V0 / (7 * MU * G), 1.5 * step)
        check.near(f"h = {step}: it rolls after 12 v0^2 / (49 mu g), to one step", ball["x"][rolls],
                   12 * V0**2 / (49 * MU * G), 1.5 * step * V0)
