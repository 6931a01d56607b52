"""Faces add up to contacts, the power is that of the drum's torque, forces carry the ore, and larger grains wear lifters faster.

A second of both sizes with bars.
"""

import subprocess
from math import pi

from checking import Check
from study import SIZES, run

G, RPM = 9.81, 2 * pi / 60
END = 1.0

FIELD = """
import sys, vtk
reader = vtk.vtkXMLPolyDataReader(); reader.SetFileName(sys.argv[1]); reader.Update()
cells = reader.GetOutput().GetCellData()
depth, area, body = (cells.GetArray(name) for name in ("depth", "area", "body"))
sums = [0.0, 0.0]
for i in range(depth.GetNumberOfTuples()): sums[int(body.GetValue(i))] += depth.GetValue(i) * area.GetValue(i)
print(*sums)
"""

with Check(__file__) as check:
    found = {size: run(check.program, check.folder / size.replace(" ", ""), "bars", size, 0.0, END) for size in SIZES}
    check.holds("8 mm wear the lifters faster than 5 mm", found["8 mm"]["lifters"] > 1.1 * found["5 mm"]["lifters"],
                f"{found['8 mm']['lifters']:.3g} and {found['5 mm']['lifters']:.3g} mm3/h")

    results = check.folder / "8mm"
    reading = check.run("8mm_again", simulation__end_time=END)  # the scene as it stands has bars and 8 mm
    wear, load = reading.table("wear.csv"), reading.table("body_load.csv")
    field = subprocess.run(["/usr/bin/python3", "-c", FIELD, str(results / "wear_00001000.vtp")], text=True,
                           capture_output=True, check=True).stdout.split()
    for slot, body in enumerate(("liner", "shell")):
        total = [v for v, b in zip(wear["volume"], wear["body"]) if b == body][-1]
        # Some ten thousand roundings.
        check.near(f"{body}: depth times area over all faces = volume of all contacts", float(field[slot]), total, 1e-10 * total)

    late = [i for i, t in enumerate(load["time"]) if t > 0.5]
    mean = lambda key: 2 * sum(load[key][i] for i in late) / len(late)  # of two bodies
    power = mean("power")
    check.near("power = torque times speed", power, mean("axial_torque") * 85 * RPM, 1e-9 * abs(power))
    weight = 270 * 2700 * pi / 6 * 8e-3**3 * G
    # The ore keeps moving: in half a second its momentum changes by less than 0.2 kg times 0.25 m/s.
    check.near("the drum carries the ore", -mean("force_y"), weight, 0.2 * 0.25 / 0.5)
