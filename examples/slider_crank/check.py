"""The slider goes where the closed form says at every step, and the motor's work is the kinetic energy's change."""

from math import cos, pi, sin, sqrt

from checking import Check

R, L, W = 0.05, 0.15, 10.0


def way(angle):
    return R * cos(angle) + sqrt(L**2 - (R * sin(angle)) ** 2)


def speed(angle):
    return -R * W * sin(angle) * (1 + R * cos(angle) / sqrt(L**2 - (R * sin(angle)) ** 2))


def errors(run, h):
    """Greatest error of the way at the steps, and of the speed in the middle of them."""
    track = run.table("track.csv")
    rows = [i for i, body in enumerate(track["id"]) if body == 2 and track["time"][i] > 2.5 * h]
    return (max(abs(track["x"][i] - way(W * track["time"][i])) for i in rows),
            max(abs(track["vx"][i] - speed(W * (track["time"][i] - h / 2))) for i in rows))


with Check(__file__) as check:
    # The closed form, by figures that others computed.
    check.near("way at 30 degrees", way(pi / 6), 0.191203265, 1e-9)
    check.near("speed at 30 degrees", speed(pi / 6), -0.323192505, 1e-9)
    check.near("way at 120 degrees", way(2 * pi / 3), 0.118614066, 1e-9)
    check.near("speed at 120 degrees", speed(2 * pi / 3), -0.357634866, 1e-9)

    run = check.run()
    off, fine = errors(run, 1e-3)
    check.holds("the slider is where it shall be, to rounding", off < 1e-12, f"{off:.2g} m")
    coarse = errors(check.run("coarse", simulation__time_step="2e-3", observer__track__interval="2e-3"), 2e-3)[1]
    check.holds("its mean speed over a step is that in the middle, to second order", 3.5 < coarse / fine < 4.5,
                f"{coarse:.3g} at 2 ms, {fine:.3g} m/s at 1 ms")

    joints = run.table("joints.csv")
    check.holds("joints hold to rounding", max(joints["error"]) < 1e-12, f"{max(joints['error']):.2g} m")
    steps = run.table("steps.csv")
    all_joints = sum(power * 1e-3 for power in joints["power"])
    motor = sum(power * 1e-3 for power, name in zip(joints["power"], joints["name"]) if name == "drive")
    change = steps["kinetic_energy"][-1] - steps["force_work"][-1]
    check.near("work of joints and motor is the change of the energy", all_joints, change, 1e-12)
    # Ideal joints give nothing; in a step, whose ends have other directions than its middle, a little of second order.
    check.near("and all but all of it is the motor's", motor, change, 1e-3 * abs(change))
    carried = run.json["log"]
    check.holds("the log tells of the assembly and of the repeated equations",
                any("put together" in line for line in carried) and any("repeat" in line for line in carried))
