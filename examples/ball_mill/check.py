"""Energy closes: what the motor gives is what the balls gain and what their contacts take; the torque is that of their weight.

A fifth of the balls for 2 s, and fewer with soft contacts; `full` takes all of them with both, and compares torques.
"""

from math import pi

from checking import STEPPERS, Check

G, RPM = 9.81, 2 * pi / 60
BALL = 7800 * pi / 6 * 6e-3**3  # [kg]


def mean(values):
    return sum(values) / len(values)


def check_energy(check, stepper, run):
    steps, joints = run.table("steps.csv"), run.table("joints.csv")
    drive = [i for i, name in enumerate(joints["name"]) if name == "drive"]
    axle = [i for i, name in enumerate(joints["name"]) if name == "axle"]
    check.near(f"{stepper}: the drum turns as the motor says", joints["angular_speed"][drive[-1]], 55 * RPM, 1e-9)
    check.holds(f"{stepper}: the axle holds", max(joints["error"][i] for i in axle) < 1e-10)
    given = joints["energy"][drive[-1]] - joints["energy"][drive[0]]
    gained = sum(steps[key][-1] - steps[key][0] for key in ("kinetic_energy", "potential_energy"))
    lost = steps["contact_loss"][-1] - steps["contact_loss"][0]
    check.near(f"{stepper}: energy of the motor = change of kinetic and potential energy + loss in contacts", given, gained + lost,
               0.01 * given)
    check.holds(f"{stepper}: contacts take energy and give none", lost > 0.0,
                f"{lost:.3g} of {given:.3g} J; the rest is in the drum")


def check_torque(check, stepper, run, count, end):
    """The moment of the motor is that of the balls' weight, and what turns them faster: averages of the last second."""
    track, joints = run.table("track.csv"), run.table("joints.csv")
    late = [i for i, t in enumerate(track["time"]) if t > end - 1.0 and track["id"][i] > 0]

    def moment(t):
        return BALL * sum(track["x"][i] * track["vy"][i] - track["y"][i] * track["vx"][i] for i in late if track["time"][i] == t)

    first, last = track["time"][late[0]], track["time"][late[-1]]
    faster = (moment(last) - moment(first)) / (last - first)
    drive = [i for i, name in enumerate(joints["name"]) if name == "drive" and first < joints["time"][i] <= last]
    torque = mean([joints["effort_torque"][i] for i in drive])
    # Means of 50 moments, each of a lever that swings by a tenth.
    check.near(f"{stepper}: mean torque = weight times lever", torque,
               count * BALL * G * mean([track["x"][i] for i in late]) + faster, 0.05 * torque)
    power = sum(joints["power"][i] for i in drive) * 1e-3
    check.holds(f"{stepper}: and power is torque times speed", abs(power - torque * 55 * RPM) < 0.05 * torque * 55 * RPM)
    return torque


def mill(check, stepper, count, end):
    """Runs a mill: (torque [N m], worn volume [m3])."""
    run = check.run(f"{stepper}_{count}", time_stepper__type=stepper, source__balls__count=count, simulation__end_time=end)
    check.holds(f"{stepper}: no ball is lost", run.table("steps.csv")["bodies"][-1] == count + 1)
    check_energy(check, stepper, run)
    torque = check_torque(check, stepper, run, count, end)
    load, wear, joints = run.table("body_load.csv"), run.table("wear.csv"), run.table("joints.csv")
    balls = -mean([m for t, m in zip(load["time"], load["axial_torque"]) if t > end - 1.0 + 1e-6])
    # Energy over angle, of the same second: of soft contacts `effort_torque` is that of one sub-step in each step.
    drive = [i for i, name in enumerate(joints["name"]) if name == "drive" and joints["time"][i] > end - 1.0 - 1e-6]
    energy, time = (joints[key][drive[-1]] - joints[key][drive[0]] for key in ("energy", "time"))
    motor = energy / (55 * RPM * time)
    check.near(f"{stepper}: what the motor gives is the moment of the balls on the drum", balls, motor, 0.01 * motor)
    # Two laws with coefficients of the scene's own; what is tested of them is in their unit tests.
    sliding, impacts = (wear[key][-1] for key in ("sliding_volume", "impact_volume"))
    check.holds(f"{stepper}: the drum wears", sliding > 0.0 and impacts > 0.0,
                f"sliding {sliding * 1e9:.3g} mm3, impacts {impacts * 1e9:.3g} mm3 in {end} s; torque {torque:.3f} N m")
    return torque


with Check(__file__) as check:
    if check.full:
        torque = [mill(check, stepper, 5000, 3.0) for stepper in STEPPERS]
        check.holds("torques of all steppers agree to a tenth", max(torque) < 1.1 * min(torque), f"{max(torque) / min(torque):.3f}")
    else:
        mill(check, "dvi", 1000, 2.0)
        mill(check, "dem", 300, 2.0)
