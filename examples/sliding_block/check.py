"""A block on an incline of angle a: it sticks when mu >= tan a, else it slides with a = g (sin a - mu cos a)."""

from math import cos, radians, sin, tan

from checking import Check

G, ANGLE, STEP, END = 9.81, radians(20), 1e-3, 0.5

with Check(__file__) as check:
    mu = 0.2
    block = check.run("slides").table("track.csv")
    expected = G * (sin(ANGLE) - mu * cos(ANGLE)) * END
    # The force is constant, so the scheme is exact in the velocity; what remains is the solver's tolerance.
    check.near("below tan a it slides with g (sin a - mu cos a)", block["vx"][-1], expected, 1e-6)
    check.near("x = v t / 2 + a h t / 2, the scheme's own exact answer", block["x"][-1], 0.5 * expected * (END + STEP), 1e-6)
    check.near("it does not rock", max(map(abs, block["wy"])), 0.0, 1e-6)
    check.near("with exact Coulomb friction it does not float", block["z"][-1], 0.01, 1e-7)

    floats = check.run("floats", time_stepper__friction="associated").table("track.csv")
    # The relaxed cone lets a sliding contact open by mu h v: known, and the reason for the other setting.
    check.near("the relaxed contact floats at mu h v", floats["z"][-1] - 0.01, mu * STEP * floats["vx"][-1],
               0.02 * mu * STEP * expected)

    for floor in ("incline", "slab"):
        for factor, sticks in ((1.02, True), (0.98, False)):
            moved = check.run(f"{floor}_mu_{factor}", body__incline__shape=floor,
                              material__wood__friction=factor * tan(ANGLE)).table("track.csv")
            slides = G * (sin(ANGLE) - factor * tan(ANGLE) * cos(ANGLE)) * END
            check.near(f"with mu = {factor} tan a it {'sticks' if sticks else 'slides'} on the {floor}", moved["vx"][-1],
                       0.0 if sticks else slides, 1e-5)
            check.near("   without rocking", max(map(abs, moved["wy"])), 0.0, 1e-6)
