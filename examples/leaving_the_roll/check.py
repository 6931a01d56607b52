"""A carried grain leaves the roll at the angle at which weight and image force no longer bend its path."""

from math import asin, atan2, degrees, pi

from checking import Check

ROLL, GRAIN, CLEAR = 0.16, 1e-3, 1e-6  # m
PER_VOLT = 9.386057595  # strongest field on the published roll over its voltage, 1/m
# rpm, kV, degrees above the horizontal
ANGLES = ((44.8, 0, 21.175), (44.8, 30, 11.754), (60.0, 0, 40.384), (60.0, 30, 29.367))


def last_touch(contacts, track):
    """Angle of the grain in the last step in which the surface of the roll (not the ridge) pressed it outward."""
    place = {t: (x, y) for t, x, y in zip(track["time"], track["x"], track["y"])}
    for i in reversed(range(len(contacts["time"]))):
        x, y = place[contacts["time"][i]]
        radial = contacts["impulse_x"][i] * x + contacts["impulse_y"][i] * y
        if radial > 0.5 * contacts["impulse_normal"][i] * (ROLL + GRAIN):
            return degrees(atan2(y, x))
    raise SystemExit("the grain never touched the roll")


with Check(__file__) as check:
    for rpm, kilovolt, expected in ANGLES:
        speed = rpm * 2 * pi / 60
        run = check.run(f"{rpm}rpm_{kilovolt}kV", electric_field__gap__field=[0.0, PER_VOLT * kilovolt * 1e3, 0.0],
                        body__roll__angular_velocity=[0.0, 0.0, -speed],
                        body__grain__velocity=[speed * (ROLL + GRAIN + CLEAR), 0.0, 0.0])
        angle = last_touch(run.table("contacts.csv"), run.table("track.csv"))
        # A step turns the roll by less than 0.1 degrees, and the charge is held from the first step on.
        check.near(f"{rpm} rpm, {kilovolt} kV: the grain leaves at the angle of the force balance", angle, expected, 0.5)
        # The expectation itself, from the balance: F/m of the charge on the grain.
        charge = run.table("track.csv")["charge_corona"][-1]
        mass = 946 * 4 / 3 * pi * GRAIN**3
        hold = charge**2 / (4 * pi * 8.85941e-12 * (2 * GRAIN)**2) / mass
        balance = degrees(asin((speed**2 * (ROLL + GRAIN) - hold) / 9.81))
        check.near(f"{rpm} rpm, {kilovolt} kV: the charge gives that angle", balance, expected, 1e-3)
        check.holds(f"{rpm} rpm, {kilovolt} kV: the corona's charge is negative, or none", charge < 0 or kilovolt == 0)
