"""A block on a belt of speed v: it runs with the belt after v^2 / (2 mu g); uphill it is carried iff mu >= tan a."""

from math import cos, radians, sin, tan

from checking import Check

G, MU, V, STEP = 9.81, 0.3, 1.0, 1e-3


def distance_to_speed(block):
    """Where the block is when it first has the belt's speed, to the solver's tolerance."""
    return next(x for x, v in zip(block["x"], block["vx"]) if v > V - 1e-6)


with Check(__file__) as check:
    block = check.run("level").table("track.csv")
    k = len(block["vx"]) // 4
    check.near("it gains mu g", block["vx"][k], MU * G * block["time"][k], 1e-6)
    # The speed is reached in the middle of a step, and positions lag by half a step.
    check.near("it has the belt's speed after v^2 / (2 mu g)", distance_to_speed(block), V * V / (2 * MU * G), 1.5 * STEP * V)
    check.near("and keeps it", block["vx"][-1], V, 1e-6)
    check.near("it does not drift sideways", max(map(abs, block["y"])), 0.0, 1e-6)
    check.near("nor rock", max(map(abs, block["wy"])), 0.0, 1e-6)

    back = check.run("back", body__belt__surface_velocity="[-1.0, 0.0, 0.0]").table("track.csv")
    check.near("a belt that runs back takes it back", back["vx"][-1], -V, 1e-6)

    for factor, carried in ((1.05, True), (0.95, False)):
        angle = radians(20)
        mu = factor * tan(angle)
        uphill = check.run(f"uphill_mu_{factor}", material__wood__friction=mu, body__block__velocity="[1.0, 0.0, 0.0]",
                           force_field__gravity__acceleration=f"[{-G * sin(angle)}, 0.0, {-G * cos(angle)}]").table("track.csv")
        slides = G * (mu * cos(angle) - sin(angle)) * 0.5
        check.near(f"with mu = {factor} tan a it is {'carried uphill' if carried else 'left behind'}", uphill["vx"][-1],
                   V if carried else V + slides, 1e-5)
