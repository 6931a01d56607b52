"""Energy closes: what the motor gives is what the balls gain and what their contacts take; the torque is that of their weight.

A fifth of the balls for 2 s; `full` takes all of them.
"""

from math import pi

from checking import Check

G, RPM = 9.81, 2 * pi / 60
BALL = 7800 * pi / 6 * 6e-3**3  # [kg]

with Check(__file__) as check:
    count = 5000 if check.full else 1000
    end = 3.0 if check.full else 2.0
    run = check.run(source__balls__count=count, simulation__end_time=end)
    steps, joints, track = run.table("steps.csv"), run.table("joints.csv"), run.table("track.csv")
    check.holds("no ball is lost", steps["bodies"][-1] == count + 1)

    drive = [i for i, name in enumerate(joints["name"]) if name == "drive"]
    axle = [i for i, name in enumerate(joints["name"]) if name == "axle"]
    check.near("the drum turns as the motor says", joints["angular_speed"][drive[-1]], 55 * RPM, 1e-9)
    check.holds("the axle holds", max(joints["error"][i] for i in axle) < 1e-10)

    given = joints["energy"][drive[-1]] - joints["energy"][drive[0]]
    gained = sum(steps[key][-1] - steps[key][0] for key in ("kinetic_energy", "potential_energy"))
    lost = steps["contact_loss"][-1] - steps["contact_loss"][0]
    check.near("energy of the motor = change of kinetic and potential energy + loss in contacts", given, gained + lost,
               0.01 * given)
    check.holds("contacts take energy and give none", lost > 0.0, f"{lost:.3g} of {given:.3g} J; the rest is in the drum")

    # The moment of the motor is that of the balls' weight, and what turns them faster: averages of the last second.
    late = [i for i, t in enumerate(track["time"]) if t > end - 1.0 and track["id"][i] > 0]
    lever = sum(track["x"][i] for i in late) / len(late)
    def moment(t):
        return BALL * sum(track["x"][i] * track["vy"][i] - track["y"][i] * track["vx"][i] for i in late if track["time"][i] == t)
    first, last = track["time"][late[0]], track["time"][late[-1]]
    faster = (moment(last) - moment(first)) / (last - first)
    torque = [joints["effort_torque"][i] for i in drive if first < joints["time"][i] <= last]
    torque = sum(torque) / len(torque)
    # Means of 50 moments, each of a lever that swings by a tenth.
    check.near("mean torque = weight times lever", torque, count * BALL * G * lever + faster, 0.05 * torque)
    power = sum(joints["power"][i] for i in drive if first < joints["time"][i] <= last) / 1.0
    check.holds("and power is torque times speed", abs(power * 1e-3 - torque * 55 * RPM) < 0.05 * torque * 55 * RPM)
