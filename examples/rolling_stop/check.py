"""Rolling friction stops a ball after 7 R v0^2 / (10 mu_r g), spinning friction stops a top after 2 R^2 w0 / (5 mu_s g)."""

from math import atan, cos, sin

from checking import Check

G, R, V0, W0, MU_R, MU_S = 9.81, 0.02, 0.5, 20.0, 1e-3, 0.25e-3
SLOW = 5 * MU_R * G / (7 * R)  # deceleration of the ball [m/s2]
STOP, SPIN_STOP = V0 / SLOW, 0.4 * R**2 * W0 / (MU_S * G)  # [s]


BALL, TOP = 1, 2  # ids: the floor is 0


def of(track, body):
    """Rows of one body of the table."""
    rows = [i for i, identity in enumerate(track["id"]) if identity == body]
    return {column: [values[i] for i in rows] for column, values in track.items()}


def stops(times, speeds):
    """The time after which nothing moves."""
    return next((t for t, v in zip(times, speeds) if abs(v) < 1e-7), float("inf"))


with Check(__file__) as check:
    for solver, step in (("pgs", 1e-3), ("pgs", 2e-3), ("pgs", 0.5e-3), ("asgs", 1e-3), ("apgd", 1e-3)):
        track = check.run(f"{solver}_{step}", ccp_solver__type=solver, simulation__time_step=step).table("track.csv")
        ball, top, what = of(track, BALL), of(track, TOP), f"{solver}, h = {step}"
        # Constant forces: the scheme is exact in velocities, a step in time, half of v0 h in the distance.
        half = min(range(len(ball["time"])), key=lambda i: abs(ball["time"][i] - 0.5 * STOP))
        check.near(f"{what}: half way it has v0 - 5 mu_r g t / (7 R)", ball["vx"][half],
                   V0 - SLOW * ball["time"][half], 1e-6)
        check.near(f"{what}: the ball stops after 7 R v0 / (5 mu_r g)", stops(ball["time"], ball["vx"]), STOP, 2 * step)
        check.near(f"{what}: and 7 R v0^2 / (10 mu_r g)", ball["x"][-1], 0.5 * V0 * STOP, 0.6 * V0 * step)
        check.near(f"{what}: the top stops after 2 R^2 w0 / (5 mu_s g)", stops(top["time"], top["wz"]), SPIN_STOP,
                   2 * step)
        check.near(f"{what}: and does not leave its place", top["x"][-1], 0.0, 1e-9)
        check.near(f"{what}: nothing floats", max(map(abs, (z - R for z in ball["z"]))), 0.0, 1e-8)

    contacts = check.run("contacts", simulation__end_time=0.2).table("contacts.csv")
    weight = 1200 * 4 / 3 * 3.141592653589793 * R**3 * G * 1e-3
    moments = [contacts[f"moment_{axis}"][i] for i in range(len(contacts["time"])) for axis in "xyz"
               if contacts["time"][i] == contacts["time"][-1]]
    for law, measured, expected in zip(("x", "y", "z") * 2, moments, (0, -MU_R, 0, 0, 0, -MU_S)):
        check.near(f"the moment about {law} is what its arm makes of the weight", measured, expected * weight,
                   1e-6 * MU_S * weight)

    for factor in (0.98, 1.02):
        a = atan(factor * MU_R / R)
        ball = of(check.run(f"incline_{factor}", simulation__end_time=0.4, body__ball__velocity=[0, 0, 0],
                            body__ball__angular_velocity=[0, 0, 0],
                            force_field__gravity__acceleration=f"[{G * sin(a):.15g}, 0.0, {-G * cos(a):.15g}]")
                  .table("track.csv"), BALL)
        expected = max(0.0, 5 / 7 * G * (sin(a) - MU_R / R * cos(a)) * 0.4)
        check.near(f"tan a = {factor} mu_r / R: it {'stays' if factor < 1 else 'rolls'}", ball["vx"][-1], expected, 1e-6)

    floats = of(check.run("floats", time_stepper__friction="associated", simulation__end_time=0.5).table("track.csv"),
                BALL)
    # The relaxed cone lets a contact open by what it dissipates: h (mu |u_t| + mu_r |w_r|), and here it does not slip.
    check.near("the relaxed rolling contact floats at h mu_r w", floats["z"][-1] - R, 1e-3 * MU_R * floats["wy"][-1],
               1e-3 * 1e-3 * MU_R * 25)
