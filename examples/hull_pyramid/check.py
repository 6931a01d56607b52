"""A pyramid of thirty convex hulls stands without creeping, and its layers carry what is above them: with dvi and with dem."""

from checking import Check

G, STEP, WIDTH = 9.81, 1e-3, 0.1
LAYERS = (16, 9, 4, 1)
TOLERANCE = 1e-6  # residual at which the solver of dvi stops [m/s]


def stands(check, stepper, end):
    run = check.run(stepper, time_stepper__type=stepper, simulation__end_time=end)
    track, contacts = run.table("track.csv"), run.table("contacts.csv")
    rows = {}
    for i, body in enumerate(track["id"]):
        rows.setdefault(body, []).append(i)
    drift = max(abs(track[axis][i] - track[axis][of[0]]) for of in rows.values() for i in of for axis in "xyz")
    check.holds(f"{stepper}: thirty hulls", len(rows) == sum(LAYERS))
    check.holds(f"{stepper}: no hull has moved by 1 % of its width after {end:g} s", drift < 0.01 * WIDTH,
                f"{drift / WIDTH:.2g} of a width")
    turned = max(2 * sum(track[f"q{axis}"][i] ** 2 for axis in "xyz") ** 0.5 for i in range(len(track["time"])))
    check.holds(f"{stepper}: none has turned by a hundredth", turned < 0.01, f"{turned:.2g} rad")
    late = [i for i, t in enumerate(track["time"]) if t > 0.5 * end]
    fastest = max(abs(track[key][i]) for i in late for key in ("vx", "vy", "vz"))
    # The residual of dvi; overlaps of 5 um that are known to a rounding of the places, 3e-17 m, in each sub-step of 9 us.
    rest = TOLERANCE if stepper == "dvi" else 1e-10
    check.holds(f"{stepper}: they are at rest", fastest < 10 * rest, f"{fastest:.2g} m/s")
    carries(check, stepper, contacts, 10 * rest / (G * STEP))  # what a velocity may change by in a step, over that by gravity


def carries(check, stepper, contacts, tolerance):
    """Impulses on the upper body of each contact: what rises above the layer below carries all that is above."""
    last = [i for i, t in enumerate(contacts["time"]) if t == contacts["time"][-1]]
    floor = sum(contacts["impulse_z"][i] for i in last if contacts["body_a"][i] == 0)
    first = 1
    for n, count in enumerate(LAYERS[:-1]):
        layer = range(first, first + count)
        carried = sum(contacts["impulse_z"][i] for i in last
                      if contacts["body_a"][i] in layer and contacts["body_b"][i] >= first + count)
        check.near(f"{stepper}: layer {n + 1} carries {sum(LAYERS[n + 1:])} of the floor's {sum(LAYERS)} parts", carried / floor,
                   sum(LAYERS[n + 1:]) / sum(LAYERS), tolerance)
        first += count


with Check(__file__) as check:
    for stepper, end in {"dvi": 10.0 if check.full else 1.0, "dem": 4.0 if check.full else 0.5}.items():
        stands(check, stepper, end)
