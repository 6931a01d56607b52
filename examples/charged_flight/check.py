"""A charged metal grain flies from the roll: after 0.25 s it is where an independent integration puts it, at first order."""

from checking import Check

STEPS = (1e-3, 0.5e-3, 0.25e-3)  # s
# State after 0.25 s by a Runge-Kutta method of high order: m and m/s.
EXACT = {"x": 0.284714467, "y": -0.418933239, "vx": 0.617594843, "vy": -3.269630152}
CHARGE = 2e-10  # C

with Check(__file__) as check:
    ends = []
    for step in STEPS:
        track = check.run(f"step_{step}", simulation__time_step=step).table("track.csv")
        end = {name: track[name][-1] for name in EXACT}
        ends.append(end)
        check.near(f"step {step * 1e3} ms: the flight lasts 0.25 s", track["time"][-1], 0.25, 1e-9)
        check.holds(f"step {step * 1e3} ms: the charge is kept in flight", set(track["charge_induced"]) == {CHARGE})
        # Free fall in this scheme is ahead by g h t / 2; the field and the air change this by less than a tenth.
        check.near(f"step {step * 1e3} ms: x", end["x"], EXACT["x"], 0.15 * step)
        check.near(f"step {step * 1e3} ms: y", end["y"], EXACT["y"] - 9.81 * step * 0.25 / 2, 0.15 * step)
    for name, exact in EXACT.items():
        ratio = (ends[0][name] - exact) / (ends[2][name] - exact)
        # Two halvings of a first-order error divide it by 4; the second order left in it is some per cent.
        check.near(f"the error of {name} falls with the step", ratio, 4.0, 0.2)
        # Richardson's extrapolation leaves the second order: (1 ms / 0.25 s)^2 of the coordinate, and less.
        check.near(f"{name} extrapolated to no step at all", 2 * ends[2][name] - ends[1][name], exact, 2e-6)
