"""The energy account of steps.csv closes: grains that settle in a box, and grains in a turning drum.

usage: energy.py SCREE
"""

import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCREE = os.path.abspath(sys.argv[1])
G, STEP, RADIUS, DENSITY = 9.81, 1e-3, 4e-3, 2500.0
GRAIN = DENSITY * 4 / 3 * math.pi * RADIUS**3  # [kg]

COMMON = """
[simulation]
end_time = "{end} s"
time_step = "1 ms"
[time_stepper]
type = "dvi"
friction = "{friction}"
[ccp_solver]
type = "asgs"
tolerance = 1e-4
max_iterations = 200
[broad_phase]
type = "grid"
[[force_field]]
type = "gravity"
[material.grain]
density = "2500 kg/m3"
friction = 0.4
restitution = 0.3
rolling_friction = "{rolling}"
[shape.ball]
type = "sphere"
radius = "4 mm"
"""

DRUM = """
[shape.drum]
type = "cylinder"
radius = "50 mm"
length = "1 m"
hollow = true
[[body]]
shape = "drum"
material = "grain"
motion = "kinematic"
rotation_axis = [1, 0, 0]
rotation_angle = "90 deg"
angular_velocity = ["0 rad/s", "40 rpm", "0 rad/s"]
"""


def walls():
    """A box of 40 mm by 40 mm, open above."""
    text = '[shape.wall]\ntype = "plane"\n'
    for axis, angle, x, y in [("[0, 0, 1]", 0, 0, 0), ("[0, 1, 0]", 90, -20, 0), ("[0, 1, 0]", -90, 20, 0),
                              ("[1, 0, 0]", -90, 0, -20), ("[1, 0, 0]", 90, 0, 20)]:
        text += (f'[[body]]\nshape = "wall"\nmaterial = "grain"\nposition = ["{x} mm", "{y} mm", "0 mm"]\n'
                 f'rotation_axis = {axis}\nrotation_angle = "{angle} deg"\n')
    return text


def grains(count, across, along, low):
    """On a loose lattice, slightly askew, with some speed."""
    text = ""
    for index in range(count):
        i, j, k = index % across, index // across % along, index // (across * along)
        x, y = (9.5 * (n - (of - 1) / 2) + 0.2 * ((k + n) % 3 - 1) for n, of in ((i, across), (j, along)))
        text += (f'[[body]]\nshape = "ball"\nmaterial = "grain"\nmotion = "dynamic"\n'
                 f'position = ["{x} mm", "{y} mm", "{low + 9.5 * k} mm"]\n'
                 f'velocity = ["{10 * (index % 5 - 2)} mm/s", "{8 * (index % 7 - 3)} mm/s", "-50 mm/s"]\n')
    return text


class Energy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)

    def run_scene(self, name, *arguments):
        subprocess.run([SCREE, "run", "scene.toml", "-o", name, "--quiet", "--threads", "1", *arguments], cwd=self.work,
                       check=True, timeout=300, stdout=subprocess.DEVNULL)
        with open(self.work / name / "steps.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {key.split(" ")[0]: [float(row[key]) for row in rows] for key in rows[0] if key.endswith(" [J]")}

    def write_scene(self, text, **values):
        (self.work / "scene.toml").write_text(COMMON.format(**values) + text)

    def check_account(self, energy, count):
        """The two identities, in every row against the first."""
        kinetic, potential = energy["kinetic_energy"], energy["potential_energy"]
        done = [work - loss for work, loss in zip(energy["boundary_work"], energy["contact_loss"])]
        most = max(max(kinetic), max(energy["contact_loss"]))
        for k in range(len(kinetic)):
            change = done[k] - done[0] + energy["force_work"][k] - energy["force_work"][0]
            # Thousands of sums, each rounded at 1e-16 of the whole.
            self.assertAlmostEqual(kinetic[k] - kinetic[0], change, delta=1e-10 * most)
            # h sum m g . (v - v0) / 2, where |sum m v| <= sqrt(2 M T).
            bound = 0.5 * STEP * G * sum(math.sqrt(2 * count * GRAIN * kinetic[n]) for n in (0, k))
            drift = kinetic[k] + potential[k] - done[k] - (kinetic[0] + potential[0] - done[0])
            self.assertLessEqual(abs(drift), bound + 1e-10 * most)
        return done

    def test_grains_that_settle_lose_what_they_had(self):
        for friction, rolling in (("associated", "0.1 mm"), ("coulomb", "0 m")):
            self.write_scene(walls() + grains(100, 4, 4, 6), end=0.4, friction=friction, rolling=rolling)
            energy = self.run_scene(friction)
            self.check_account(energy, 100)
            had = energy["potential_energy"][0] - energy["potential_energy"][-1]
            self.assertAlmostEqual(energy["contact_loss"][-1], had + energy["kinetic_energy"][0], delta=0.02 * had)
            self.assertEqual(energy["boundary_work"][-1], 0.0)

    def test_turning_drum_drives_what_its_grains_lose(self):
        for friction in ("associated", "coulomb"):
            self.write_scene(DRUM + grains(150, 5, 6, -25), end=1.0, friction=friction, rolling="0 m")
            energy = self.run_scene(friction)
            self.check_account(energy, 150)
            first, last = len(energy["kinetic_energy"]) // 2, -1
            work, loss, *stored = (energy[name][last] - energy[name][first] for name in
                                   ("boundary_work", "contact_loss", "kinetic_energy", "potential_energy"))
            self.assertGreater(work, 0.5 * loss)
            self.assertLessEqual(abs(sum(stored) + loss - work), 0.01 * work)

    def test_account_goes_on_after_a_restart_bit_for_bit(self):
        self.write_scene(DRUM + grains(60, 4, 4, -25), end=0.1, friction="associated", rolling="0 m")
        whole = self.run_scene("whole")
        self.run_scene("first", "--end-time", "50 ms")
        rest = self.run_scene("rest", "--resume", "first/checkpoint.h5")
        for column, values in rest.items():
            self.assertEqual(values, whole[column][-len(values):], column)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
