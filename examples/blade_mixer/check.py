"""What turns the blades: power is torque times speed, about the same with all steppers; the halves of the bed mix."""

from math import pi

from checking import STEPPERS, Check

SPEED, STEADY = 2 * pi, 1.0  # 60 rpm [rad/s]; time from which on it turns as fast, and the bed has begun to flow [s]


def mean(values):
    return sum(values) / len(values)


with Check(__file__) as check:
    # Of slow impacts dvi lets none bounce; so that both have one law, dem gets none that bounce either (README).
    settings = {"material__glass__restitution": 0.05, "material__dark_glass__restitution": 0.05}
    if check.full:
        settings["simulation__end_time"] = 6.0
    torques = []
    for stepper in STEPPERS:
        run = check.run(stepper, time_stepper__type=stepper, **settings)
        load, mixing = run.table("body_load.csv"), run.table("mixing.csv")
        late = [i for i, t in enumerate(load["time"]) if t > STEADY]
        torque = -mean([load["axial_torque"][i] for i in late])
        torques.append(torque)
        power = -mean([load["power"][i] for i in late])
        check.holds(f"{stepper}: the bed resists", torque > 0.0, f"{torque * 1e3:.1f} mN m, {power * 1e3:.0f} mW")
        # Levers are those of the beginning of a step, velocities those of its middle: half a step of turning, 3e-3.
        check.near(f"{stepper}: power is torque times speed", power, torque * SPEED, 5e-3 * power)
        first = next(m for t, m in zip(mixing["time"], mixing["lacey_index"]) if t > 0.4)
        check.holds(f"{stepper}: the halves mix", first < 0.3 and mixing["lacey_index"][-1] > 0.7,
                    f"Lacey's index from {first:.2f} to {mixing['lacey_index'][-1]:.2f}")
        # 900 beads of 0.164 g.
        steps = run.table("steps.csv")
        check.holds(f"{stepper}: no bead is lost", steps["bodies"][-1] == steps["bodies"][0] == 900)
    # The two means scatter by 0.03 and 0.02.
    check.holds("torques of all steppers are within 15 % of each other", max(torques) < 1.15 * min(torques),
                f"{max(torques) / min(torques):.3f}")
