"""Ten boxes on each other stand without creeping, and the floor of each carries what is above: dvi for 10 s, dem for 2 s.

With dem they stand on springs, and each has sunk by what the springs below it give.
"""

from checking import Check

G, STEP, SIDE, DENSITY = 9.81, 1e-3, 0.1, 700.0
BOXES = 10
TOLERANCE = 9e-8  # residual at which the solver stops [m/s]
STIFFNESS = 1e6   # of the springs [N/m]
CENTRES = [(0.0, 0.0), (8e-3, -5e-3), (-6e-3, 4e-3), (3e-3, 9e-3), (-9e-3, -2e-3), (5e-3, -8e-3), (0.0, 6e-3), (-4e-3, -7e-3),
           (9e-3, 1e-3), (-2e-3, 3e-3)]  # of the boxes, as the scene puts them [m]


def stands(check, stepper, track):
    """No box moves or turns after the first frame."""
    rows = {}
    for i, body in enumerate(track["id"]):
        rows.setdefault(body, []).append(i)
    drift = max(abs(track[axis][i] - track[axis][of[0]]) for of in rows.values() for i in of for axis in "xyz")
    check.holds(f"{stepper}: ten boxes", len(rows) == BOXES)
    check.holds(f"{stepper}: no box has moved by 1 % of its side", drift < 0.01 * SIDE, f"{drift / SIDE:.2g} of a side")
    turned = max(2 * sum(track[f"q{axis}"][i] ** 2 for axis in "xyz") ** 0.5 for i in range(len(track["time"])))
    check.holds(f"{stepper}: none has turned by a hundredth", turned < 0.01, f"{turned:.2g} rad")


def carries(check, stepper, contacts, change):
    """What lies on each body presses with its weight; `change`: velocity that all boxes may gain together in a step [m/s]."""
    weight = DENSITY * SIDE**3 * G * STEP  # of one box over a step [N s]
    last = [i for i, t in enumerate(contacts["time"]) if t == contacts["time"][-1]]
    for below in range(BOXES):
        of = [i for i in last if contacts["body_a"][i] == below]
        carried = sum(contacts["impulse_z"][i] for i in of)
        check.near(f"{stepper}: what lies on body {below} is carried by {len(of)} points", carried, (BOXES - below) * weight,
                   change / (G * STEP) * weight)
        check.holds("   and there are at least three of them", len(of) >= 3)


def sinking():
    """How far each box has sunk on its springs [m]: the four corners of what two faces share carry what is above, off centre."""
    sunk, slope, middle, found = 0.0, [0.0, 0.0], CENTRES[0], []
    for n, centre in enumerate(CENTRES):
        below = CENTRES[n - 1] if n else centre
        above = CENTRES[n:]
        load = len(above) * DENSITY * SIDE**3 * G
        shared = [0.5 * (a + b) for a, b in zip(below, centre)]
        half = [0.5 * (SIDE - abs(a - b)) for a, b in zip(below, centre)]
        lever = [sum(c[k] for c in above) / len(above) - shared[k] for k in (0, 1)]
        sunk += load / (4 * STIFFNESS) + sum(slope[k] * (shared[k] - middle[k]) for k in (0, 1))
        slope = [slope[k] + load * lever[k] / (4 * STIFFNESS * half[k] ** 2) for k in (0, 1)]
        sunk += sum(slope[k] * (centre[k] - shared[k]) for k in (0, 1))
        middle = centre
        found.append(sunk)
    return found


with Check(__file__) as check:
    run = check.run()
    stands(check, "dvi", run.table("track.csv"))
    # The residual is a velocity: before and after the step that of a box above n others may be n of it. What all boxes
    # gain so is missing in the balance.
    carries(check, "dvi", run.table("contacts.csv"), 2 * TOLERANCE * BOXES * (BOXES + 1) / 2)

    run = check.run("dem", time_stepper__type="dem", simulation__end_time=2.0)
    track = run.table("track.csv")
    stands(check, "dem", track)
    late = [i for i, t in enumerate(track["time"]) if t > 1.0]
    # Boxes still sway a little: in a step each gains no more than from one way to the other.
    carries(check, "dem", run.table("contacts.csv"), 2 * BOXES * max(abs(track["vz"][i]) for i in late))
    for body, sunk in enumerate(sinking(), 1):
        z = [track["z"][i] for i in late if track["id"][i] == body]
        # Mean over the swaying. Springs that stand obliquely, and how far boxes shift, matter to a millionth.
        check.near(f"dem: box {body} has sunk on its springs [um]", 1e6 * ((body - 0.5) * SIDE - sum(z) / len(z)), 1e6 * sunk,
                   1e6 * sunk * 2e-3)
