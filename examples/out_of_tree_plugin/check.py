"""check.py RESULTS: the end of the pushed ball against the closed form of a constant acceleration."""

import json
import pathlib
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

ACCELERATION = (0.5, 0.0, -0.2)  # [m/s2]
TIME_STEP = 1e-3  # [s]


def last_particle(results):
    """Position [m] and velocity [m/s] of the only particle in the last file of the series."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(sorted(results.glob("particles_*.vtp"))[-1]))
    reader.Update()
    cloud = reader.GetOutput()
    assert cloud.GetNumberOfPoints() == 1, f"one ball was expected, not {cloud.GetNumberOfPoints()}"
    return cloud.GetPoint(0), cloud.GetPointData().GetArray("velocity").GetTuple(0)


def main():
    results = pathlib.Path(sys.argv[1])
    run = json.loads((results / "run.json").read_text(encoding="utf-8"))
    assert run["exit_status"] == 0, run["exit_status"]
    time = run["simulated_time"]
    assert abs(time - 1.0) < 1e-9, time
    position, velocity = last_particle(results)
    for axis, a in enumerate(ACCELERATION):
        # A thousand additions, and files of single precision at worst: 1e-6 is several times both.
        assert abs(position[axis] - 0.5 * a * time * (time + TIME_STEP)) < 1e-6, (axis, position)
        assert abs(velocity[axis] - a * time) < 1e-6, (axis, velocity)
    print(f"the ball is where it should be: {position}")


if __name__ == "__main__":
    main()
