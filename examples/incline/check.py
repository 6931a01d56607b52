"""On an incline of angle a a ball rolls iff mu >= 2/7 tan a, and a rough box tips iff tan a > b / H."""

import math

from checking import Check

G, END = 9.81, 0.2
B, H = 0.02, 0.06


def tilted(angle):
    return f"[{G * math.sin(angle):.15g}, 0.0, {-G * math.cos(angle):.15g}]"


with Check(__file__) as check:
    for degrees in (15, 30):
        a = math.radians(degrees)
        least = 2 / 7 * math.tan(a)
        for factor in (1.02, 0.9):
            mu = factor * least
            ball = check.run(f"ball_{degrees}_{factor}", force_field__gravity__acceleration=tilted(a),
                             material__wood__friction=mu).table("track.csv")
            rolls = factor >= 1.0
            # Rolling: 5/7 g sin a. Sliding: friction is mu N, against the motion. Both are constant, so that the
            # semi-implicit step is exact in the velocity; 1e-6 is for the solver.
            acceleration = 5 / 7 * G * math.sin(a) if rolls else G * (math.sin(a) - mu * math.cos(a))
            check.near(f"{degrees} degrees, mu = {factor} * 2/7 tan a: it {'rolls' if rolls else 'slides'}",
                       ball["vx"][-1], acceleration * END, 1e-6)
            slip = ball["vx"][-1] - 0.02 * ball["wy"][-1]
            check.holds("   and its lowest point " + ("rests" if rolls else "slips"), (abs(slip) < 1e-6) == rolls,
                        f"{slip:.3g} m/s")

    for factor in (0.97, 1.03):
        a = math.atan(factor * B / H)
        box = check.run(f"box_{factor}", scene=check.scene.parent / "box.toml", simulation__end_time=0.3,
                        force_field__gravity__acceleration=tilted(a)).table("track.csv")
        speed = max(abs(w) for w in box["wy"])
        tips = factor > 1.0
        # Just beyond the limit the torque is 3 % of m g b / 2, and the box falls over within half a second.
        check.holds(f"tan a = {factor} b / H: the box {'tips' if tips else 'stands'}", (speed > 0.05) == tips,
                    f"turns at {speed:.3g} rad/s")
