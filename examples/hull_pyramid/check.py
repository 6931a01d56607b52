"""A pyramid of thirty convex hulls stands without creeping, and its layers carry what is above them."""

from checking import Check

G, STEP, WIDTH = 9.81, 1e-3, 0.1
LAYERS = (16, 9, 4, 1)
TOLERANCE = 1e-6  # residual at which the solver stops [m/s]

with Check(__file__) as check:
    end = 10.0 if check.full else 1.0
    run = check.run(simulation__end_time=end)
    track, contacts = run.table("track.csv"), run.table("contacts.csv")
    rows = {}
    for i, body in enumerate(track["id"]):
        rows.setdefault(body, []).append(i)
    drift = max(abs(track[axis][i] - track[axis][of[0]]) for of in rows.values() for i in of for axis in "xyz")
    check.holds("thirty hulls", len(rows) == sum(LAYERS))
    check.holds(f"no hull has moved by 1 % of its width after {end:g} s", drift < 0.01 * WIDTH, f"{drift / WIDTH:.2g} of a width")
    turned = max(2 * sum(track[f"q{axis}"][i] ** 2 for axis in "xyz") ** 0.5 for i in range(len(track["time"])))
    check.holds("none has turned by a hundredth", turned < 0.01, f"{turned:.2g} rad")

    # Impulses on the upper body of each contact: what rises above the layer below carries all that is above.
    last = [i for i, t in enumerate(contacts["time"]) if t == contacts["time"][-1]]
    floor = sum(contacts["impulse_z"][i] for i in last if contacts["body_a"][i] == 0)
    first = 1
    for n, count in enumerate(LAYERS[:-1]):
        layer = range(first, first + count)
        carried = sum(contacts["impulse_z"][i] for i in last
                      if contacts["body_a"][i] in layer and contacts["body_b"][i] >= first + count)
        # The solver's residual, a velocity, beside g h; each hull may be off by it.
        check.near(f"layer {n + 1} carries {sum(LAYERS[n + 1:])} of the floor's {sum(LAYERS)} parts", carried / floor,
                   sum(LAYERS[n + 1:]) / sum(LAYERS), TOLERANCE / (G * STEP) * 10)
        first += count
