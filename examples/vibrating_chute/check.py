"""Grains in a trough that swings along a rising line go forward, by less than its own speed; without a swing they stay."""

from math import cos, pi, radians, sin

from checking import Check

G, MU, FREQUENCY, SLOPE, AMPLITUDE = 9.81, 0.5, 30.0, radians(30), 1e-3
TURNING = 2 * pi * FREQUENCY
BY = "prescribed_motion__0__translation__by"


def tracks(table):
    """The table of `track` by body: 0 is the chute, grains follow."""
    rows = {}
    for k, body in enumerate(table["id"]):
        rows.setdefault(int(body), []).append(k)
    return [{name: [column[k] for k in rows[body]] for name, column in table.items()} for body in sorted(rows)]


def speeds(grains):
    """Mean speed of transport of each grain [m/s], over the second half of the run."""
    half = len(grains[0]["x"]) // 2
    return [(g["x"][-1] - g["x"][half]) / (g["time"][-1] - g["time"][half]) for g in grains]


with Check(__file__) as check:
    chute, *grains = tracks(check.run("forward").table("track.csv"))
    error = max(abs(x - AMPLITUDE * cos(SLOPE) * sin(TURNING * t)) for t, x in zip(chute["time"], chute["x"]))
    # sin is called with the same time but for rounding, TURNING * 1e-16.
    check.near("the chute is where its function says after every step", error, 0.0, 1e-15)
    forward = speeds(grains)
    fastest = AMPLITUDE * TURNING * cos(SLOPE)
    check.holds("every grain goes forward, slower than the chute at its fastest", 0 < min(forward) and max(forward) < fastest,
                f"measured {min(forward):.3f} to {max(forward):.3f} m/s, below {fastest:.3f} m/s")
    check.holds("and lies in the trough", all(max(map(abs, g["y"])) < 0.03 and min(g["z"]) > 0.001 for g in grains))

    mirrored = tracks(check.run("mirrored", prescribed_motion__0__translation__along=[-cos(SLOPE), 0.0, sin(SLOPE)])
                      .table("track.csv"))
    check.holds("the mirrored swing takes them back", max(speeds(mirrored[1:])) < 0)

    still = tracks(check.run("still", **{BY: 0.0}).table("track.csv"))
    check.near("without a swing they stay", max(abs(v) for v in speeds(still[1:])), 0.0, 1e-6)

    # From rest at its lower end, with accelerations up to nine tenths of what friction holds: A w^2 (cos + mu sin) < mu g.
    weak = 0.9 * MU * G / (cos(SLOPE) + MU * sin(SLOPE)) / TURNING**2
    swing = f"{{ type = 'sine', mean = {-weak}, amplitude = {weak}, frequency = {FREQUENCY}, phase = {pi / 2} }}"
    rides = tracks(check.run("rides", **{BY: swing}).table("track.csv"))
    slip = max(abs((x - g["x"][0]) - (c - rides[0]["x"][0])) for g in rides[1:] for x, c in zip(g["x"], rides[0]["x"]))
    # The solver's tolerance of 1e-7 m/s over the run.
    check.near("a swing too weak for friction to slip carries them to and fro", slip, 0.0, 1e-6)
