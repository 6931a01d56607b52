"""A block, a rod and a ball slide at 2 m/s over a flat floor of irregular triangles exactly as over a plane or a slab."""

from checking import Check

G, MU, V0, END = 9.81, 0.2, 2.0, 0.4
BODIES = {1: "block", 2: "rod", 3: "ball"}
COLUMNS = [f"{kind}{axis}" for kind in "vw" for axis in "xyz"]

with Check(__file__) as check:
    plane = check.run("plane", body__floor__shape="plane").table("track.csv")
    ends = {body: i for i, body in enumerate(plane["id"])}
    for body in (1, 2):
        # The step is exact under a constant force; 1e-6 is for the solver.
        check.near(f"on the plane the {BODIES[body]} has lost mu g t", plane["vx"][ends[body]], V0 - MU * G * END, 1e-6)
    check.near("and the ball rolls with 5/7 of its speed", plane["vx"][ends[3]], 5 / 7 * V0, 1e-6)

    for floor in ("triangles", "slab"):
        other = check.run(floor, body__floor__shape=floor).table("track.csv")
        for body, name in BODIES.items():
            rows = [i for i, owner in enumerate(plane["id"]) if owner == body]
            worst = max(abs(other[c][i] - plane[c][i]) for i in rows for c in COLUMNS)
            # Both runs meet a residual of 1e-9 m/s and a friction error of 1e-8 m/s; turning adds a lever of 1/r, below 100.
            check.holds(f"on the {floor} the {name} moves as on the plane at every step", worst <= 1e-6,
                        f"velocities differ by {worst:.2g}")
            rise = max(abs(other["z"][i] - plane["z"][i]) for i in rows)
            check.holds("   and neither rises nor sinks", rise <= 1e-8, f"{rise:.2g} m")
