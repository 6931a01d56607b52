"""check.py RESULTS: the way of the pushed ball against the closed form of a constant acceleration."""

import csv
import json
import pathlib
import sys

ACCELERATION = {"x": 0.5, "y": 0.0, "z": -0.2}  # [m/s2]
TIME_STEP = 1e-3  # [s]


def last_row(path):
    """The last row of a table, by column without its unit."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name.split(" [")[0]: value for name, value in zip(rows[0], rows[-1])}


def main():
    results = pathlib.Path(sys.argv[1])
    run = json.loads((results / "run.json").read_text(encoding="utf-8"))
    assert run["exit_status"] == 0, run["exit_status"]
    end = last_row(results / "track.csv")
    time = float(end["time"])
    assert abs(time - 1.0) < 1e-9, time
    for axis, a in ACCELERATION.items():
        # A symplectic step of constant force is exact at its ends but for rounding: a thousand additions of 1e-16.
        position, velocity = 0.5 * a * time * (time + TIME_STEP), a * time
        assert abs(float(end[axis]) - position) < 1e-9, (axis, end[axis], position)
        assert abs(float(end["v" + axis]) - velocity) < 1e-9, (axis, end["v" + axis], velocity)
    print(f"after {time} s the ball is at x = {end['x']} m, z = {end['z']} m, as it should be")


if __name__ == "__main__":
    main()
