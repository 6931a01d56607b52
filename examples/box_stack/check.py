"""Ten boxes on each other stand for 10 s without creeping, and the floor of each carries all that is above it."""

from checking import Check

G, STEP, SIDE, DENSITY = 9.81, 1e-3, 0.1, 700.0
BOXES = 10
TOLERANCE = 9e-8  # residual at which the solver stops [m/s]

with Check(__file__) as check:
    run = check.run()
    track, contacts = run.table("track.csv"), run.table("contacts.csv")
    rows = {}
    for i, body in enumerate(track["id"]):
        rows.setdefault(body, []).append(i)
    drift = max(abs(track[axis][i] - track[axis][of[0]]) for of in rows.values() for i in of for axis in "xyz")
    check.holds("ten boxes", len(rows) == BOXES)
    check.holds("no box has moved by 1 % of its side after 10 s", drift < 0.01 * SIDE, f"{drift / SIDE:.2g} of a side")
    turned = max(2 * sum(track[f"q{axis}"][i] ** 2 for axis in "xyz") ** 0.5 for i in range(len(track["time"])))
    check.holds("none has turned by a hundredth", turned < 0.01, f"{turned:.2g} rad")

    weight = DENSITY * SIDE**3 * G * STEP  # of one box over a step [N s]
    last = [i for i, t in enumerate(contacts["time"]) if t == contacts["time"][-1]]
    for below in range(BOXES):
        of = [i for i in last if contacts["body_a"][i] == below]
        carried = sum(contacts["impulse_z"][i] for i in of)
        # The residual is a velocity: before and after the step that of a box above n others may be n of it. What all boxes
        # gain so is missing in the balance.
        change = 2 * TOLERANCE * BOXES * (BOXES + 1) / 2
        check.near(f"what lies on body {below} is carried by {len(of)} points", carried, (BOXES - below) * weight,
                   change / (G * STEP) * weight)
        check.holds("   and there are at least three of them", len(of) >= 3)
