"""A grain falls 0.5 m through air: time and speed converge to the exact fall at first order in the step."""

from checking import Check

DEPTH = 0.5  # m
STEPS = (1e-3, 0.5e-3, 0.25e-3)  # s
# Time [s] and speed [m/s] after DEPTH, by a Runge-Kutta method of high order.
EXACT = {"stokes": (0.3207449371, 3.10345815), "schiller_naumann": (0.3294103332, 2.892074734)}


def crossing(track):
    """Time and speed at DEPTH; within one step the motion is uniform."""
    for i in range(1, len(track["z"])):
        above, below = track["z"][i - 1], track["z"][i]
        if below <= -DEPTH:
            part = (above + DEPTH) / (above - below)
            return [(1 - part) * track[name][i - 1] + part * track[name][i] for name in ("time", "vz")]
    raise SystemExit("the grain did not fall far enough")


with Check(__file__) as check:
    for law, (exact_time, exact_speed) in EXACT.items():
        errors = []
        for step in STEPS:
            run = check.run(f"{law}_{step}", simulation__time_step=step, force_field__drag__law=law)
            time, velocity = crossing(run.table("track.csv"))
            errors.append(time - exact_time)
            # Free fall in this scheme is ahead by half a step; drag changes that by less than a tenth of a step.
            check.near(f"{law}, step {step * 1e3} ms: the time is half a step early", time, exact_time - step / 2,
                       0.1 * step)
            check.near(f"{law}, step {step * 1e3} ms: the speed is right to 5 m/s2 times the step", -velocity,
                       exact_speed, 5 * step)
        # Two halvings of a first-order error divide it by 4; the second order left in it is some per cent.
        check.near(f"{law}: the error falls with the step", errors[0] / errors[2], 4.0, 0.1)
        # Richardson's extrapolation leaves the second order: 1e-7 s.
        check.near(f"{law}: extrapolated to no step at all it is the exact time", exact_time + 2 * errors[2] - errors[1],
                   exact_time, 1e-6)
