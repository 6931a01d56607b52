"""What tests of whole runs share: a temporary folder, runs of the program in it, their tables, and balls of stone."""

import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile

SCREE = os.path.abspath(sys.argv[1])
G, DENSITY, RADIUS = 9.81, 2500.0, 0.01
BALL = DENSITY * 4 / 3 * math.pi * RADIUS**3  # [kg]


def body(name, shape, position, velocity=(0, 0, 0)):
    """A [[body]] of stone that moves by forces."""
    return (f'[[body]]\nname = "{name}"\nshape = "{shape}"\nmaterial = "stone"\nmotion = "dynamic"\n'
            f"position = {[float(p) for p in position]}\nvelocity = {[float(v) for v in velocity]}\n")


class WholeRuns:
    """Mixed into a unittest.TestCase."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def run_scene(self, scene, results, *arguments):
        command = [SCREE, "run", str(scene), "-o", str(self.folder / results), "--quiet", *arguments]
        done = subprocess.run(command, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def table(self, results, name):
        """Rows of a CSV table as dictionaries, without units."""
        with open(self.folder / results / name, newline="") as file:
            rows = list(csv.reader(file))
        names = [column.split(" [")[0] for column in rows[0]]
        return [dict(zip(names, row)) for row in rows[1:]]

    def near(self, value, expected, tolerance):
        self.assertLessEqual(abs(float(value) - expected), tolerance, f"{value} is not {expected}")
