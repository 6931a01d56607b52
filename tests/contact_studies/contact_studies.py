"""Loads, wear, networks and collisions of whole runs against closed forms, and through a checkpoint.

usage: contact_studies.py SCREE
"""

import math
import subprocess
import sys
import unittest

from whole_runs import BALL, DENSITY, G, RADIUS, SCREE, WholeRuns, body

FRICTION = 0.4
CUBE = DENSITY * 0.02**3

COMMON = """
[simulation]
end_time = "{end} s"
time_step = "{step} ms"
{stepper}
[broad_phase]
type = "grid"
[[force_field]]
type = "gravity"
[material.stone]
density = "2500 kg/m3"
friction = 0.4
restitution = {restitution}
[shape.slab]
type = "box"
size = ["1 m", "1 m", "0.1 m"]
[shape.ball]
type = "sphere"
radius = "10 mm"
[shape.cube]
type = "box"
size = ["20 mm", "20 mm", "20 mm"]
[[body]]
name = "plate"
shape = "slab"
material = "stone"
position = [0.0, 0.0, -0.05]
[[observer]]
type = "body_load"
bodies = ["plate"]
interval = "{interval} ms"
[[observer]]
type = "wear"
bodies = ["plate"]
hardness = "1 GPa"
wear_coefficient = 1e-3
field_interval = "0.1 s"
interval = "{interval} ms"
[[observer]]
type = "contact_network"
interval = "{interval} ms"
[[observer]]
type = "collision_energy"
interval = "{interval} ms"
"""


DVI = """
[time_stepper]
type = "dvi"
friction = "coulomb"
friction_tolerance = 1e-7
[ccp_solver]
type = "asgs"
tolerance = 1e-8
max_iterations = 2000
"""

DEM = """
[time_stepper]
type = "dem"
[contact_law]
type = "linear_spring_dashpot"
rolling = "elastic_plastic"
overlap_target = 0.01
overlap_speed = "5 m/s"
"""


class Studies(WholeRuns):
    """What holds with every stepper; hard contacts are nearer to the closed forms."""

    stepper = DVI
    rolling = ""
    work_tolerance = 1e-10  # some thousand roundings

    def write(self, name, bodies, end, step=1, restitution=0.0, interval=10):
        scene = self.folder / name
        scene.write_text(COMMON.format(stepper=self.stepper, end=end, step=step, restitution=restitution, interval=interval) + bodies)
        return scene

    def test_a_resting_ball_loads_the_plate_with_its_weight_and_its_moment(self):
        scene = self.write("rest.toml", body("ball", "ball", (0.2, -0.1, RADIUS)), 0.1)
        self.run_scene(scene, "rest")
        weight = BALL * G
        for row in self.table("rest", "body_load.csv"):
            self.near(row["force_z"], -weight, 1e-6 * weight)
            self.near(row["torque_x"], -0.1 * -weight, 1e-6 * weight)
            self.near(row["torque_y"], -0.2 * -weight, 1e-6 * weight)
            self.near(row["power"], 0, 0)
        last = self.table("rest", "contact_network.csv")[-1]
        self.assertEqual((last["grains"], last["links"], last["coordination"]), ("1", "1", "1"))
        self.near(last["mean_normal_force"], weight, 1e-6 * weight)
        self.assertEqual(float(self.table("rest", "wear.csv")[-1]["volume"]), 0.0)

    # Its weight breaks the weld in the first step; then it falls 0.3 mm, and never has more energy than that height gives.
    def test_a_ball_whose_weld_breaks_lands_on_what_held_it(self):
        ball = body("ball", "ball", (0.2, -0.1, RADIUS + 3e-4))
        weld = 'name = "weld"\ntype = "fixed"\nbetween = ["plate", "ball"]\nposition = [0.2, -0.1, 0.0]\nbreaking_force = "0.05 N"\n'
        self.run_scene(self.write("weld.toml", ball + "[[joint]]\n" + weld, 0.3), "weld")
        weight = BALL * G
        energies = [float(row["kinetic_energy"]) for row in self.table("weld", "steps.csv")]
        self.assertGreater(max(energies), 0.5 * weight * 3e-4)
        self.assertLess(max(energies), 1.01 * weight * 3e-4)
        self.near(self.table("weld", "body_load.csv")[-1]["force_z"], -weight, 0.01 * weight)

    # A cube slides to rest: way v^2 / (2 mu g), V = k m g s / H; what friction takes is its energy. A step of 1 ms of 0.25 s.
    def test_a_sliding_cube_wears_as_archard_says(self):
        scene = self.write("slide.toml", body("cube", "cube", (-0.2, 0.1, 0.01), (1, 0, 0)), 0.4)
        self.run_scene(scene, "slide")
        last = self.table("slide", "wear.csv")[-1]
        way = 1 / (2 * FRICTION * G)
        volume = 1e-3 * CUBE * G * way / 1e9
        self.near(last["sliding_volume"], volume, 0.01 * volume)
        self.near(last["sliding_energy"], 0.5 * CUBE, 0.01 * 0.5 * CUBE)
        self.assertEqual(float(last["impacts"]), 0.0)

    # At 30 degrees, without rebound: m U^2 / (4 p) cos^2(30) / 3; at 90 degrees nothing. Gravity adds 0.1 m/s on the way.
    def test_impacts_wear_as_finnie_says(self):
        speed = 5.0
        for degrees, factor in ((30, 0.25), (90, 0.0)):
            angle = math.radians(degrees)
            velocity = (speed * math.cos(angle), 0, -speed * math.sin(angle))
            start = [p - 0.01 * v for p, v in zip((0, 0, RADIUS), velocity)]
            scene = self.write(f"hit{degrees}.toml", body("ball", "ball", start, velocity), 0.02)
            self.run_scene(scene, f"hit{degrees}")
            last = self.table(f"hit{degrees}", "wear.csv")[-1]
            unit = BALL * speed**2 / (4 * 1e9)
            self.near(last["impact_volume"], factor * unit, 0.02 * unit)
            self.near(last["impacts"], 1, 1e-12)
            down = speed * math.sin(angle) + G * 0.01
            self.near(last["impact_energy"], 0.5 * BALL * down**2, 0.01 * BALL * down**2)

    # From 0.2 m with restitution 0.5: m g h, then a quarter of it each time; 1 - e^2 of each is lost.
    def test_bounces_of_a_dropped_ball_are_its_spectrum(self):
        height, e = 0.2, 0.5
        scene = self.write("drop.toml", body("ball", "ball", (0, 0, RADIUS + height)), 0.8, 0.25, e)
        self.run_scene(scene, "drop")
        rows = [row for row in self.table("drop", "collision_energy.csv") if int(row["collisions"]) > 0]
        energy = BALL * G * height
        normal = sorted((float(row["sum"]) for row in rows if row["energy"] == "normal"), reverse=True)
        self.near(normal[0], energy, 0.01 * energy)
        self.near(normal[1], energy / 4, 0.02 * energy / 4)
        lost = sum(float(row["sum"]) for row in rows if row["energy"] == "dissipated")
        self.near(lost, energy, 0.01 * energy)

    def turning_drum(self):
        drum = """
[shape.drum]
type = "cylinder"
radius = "60 mm"
length = "80 mm"
hollow = true
[[body]]
name = "drum"
shape = "drum"
material = "stone"
motion = "kinematic"
position = [0.0, 0.0, 0.5]
rotation_axis = [1, 0, 0]
rotation_angle = "90 deg"
angular_velocity = ["0 rad/s", "60 rpm", "0 rad/s"]
"""
        grains = "".join(body(f"b{i}", "ball", (-0.03 + 0.03 * (i % 3), -0.02 + 0.03 * (i // 3 % 2), 0.47 + 0.022 * (i // 6)))
                         for i in range(18))
        scene = self.write("drum.toml", drum + grains, 0.5)
        text = scene.read_text().replace('type = "body_load"\nbodies = ["plate"]', 'type = "body_load"\nbodies = ["drum"]')
        text = text.replace('type = "collision_energy"', 'type = "collision_energy"\nmin_speed = 0').replace("1e-8", "1e-6")
        scene.write_text(text.replace('restitution = 0.0', f"restitution = 0.0\n{self.rolling}"))
        self.run_scene(scene, "drum")
        return self.table("drum", "steps.csv")[-1]

    # What a turning drum gives to grains: summed here contact by contact, and by the stepper in its account of energies.
    def test_work_of_a_drum_is_that_of_the_energy_account(self):
        work = float(self.turning_drum()["boundary_work"])
        self.assertGreater(work, 0.0)
        loads = self.table("drum", "body_load.csv")
        self.near(loads[-1]["work"], -work, self.work_tolerance * work)
        for row in loads:  # about its axis of rotation, y
            self.near(row["power"], float(row["axial_torque"]) * 2 * math.pi, 1e-12)
            self.near(row["axial_torque"], float(row["torque_y"]), 1e-15)

    def dissipated(self, results):
        return 0.01 * sum(float(row["dissipated_rate"]) for row in self.table(results, "collision_energy_series.csv"))

    # Everything at once, in the middle of bounces and sliding: 0.1 s and 0.1 s more are 0.2 s.
    def test_a_resumed_run_has_the_tables_of_one_run(self):
        bodies = body("ball", "ball", (0.2, -0.1, 0.03)) + body("cube", "cube", (-0.2, 0.1, 0.02), (1, 0, -0.5))
        bodies += "".join(body(f"b{i}", "ball", (0.021 * i, 0.01 * i, 0.012 + 0.02 * i), (0.3, 0, -0.2)) for i in range(5))
        for name, end in (("whole", 0.2), ("half", 0.1)):
            self.run_scene(self.write(f"{name}.toml", bodies, end, restitution=0.4, interval=7), name)
        self.run_scene(self.folder / "whole.toml", "second", "--resume", str(self.folder / "half" / "checkpoint.h5"))
        for name in ("body_load.csv", "wear.csv", "wear_00000200.vtp", "contact_network.csv",
                     "contact_network_forces.csv", "collision_energy.csv", "collision_energy_series.csv"):
            whole, second = ((self.folder / run / name).read_bytes() for run in ("whole", "second"))
            self.assertEqual(whole, second, name)
            self.assertGreater(len(whole), 100, name)


class HardContacts(Studies, unittest.TestCase):
    def test_an_unknown_body_is_named_with_what_there_is(self):
        scene = self.write("wrong.toml", "", 0.1)
        scene.write_text(scene.read_text().replace('bodies = ["plate"]\nhardness', 'bodies = ["plat"]\nhardness'))
        done = subprocess.run([SCREE, "run", str(scene), "-o", str(self.folder / "wrong")], text=True, capture_output=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("plate", done.stderr + done.stdout)
        self.assertIn("plat'", done.stderr + done.stdout)


class SoftContacts(Studies, unittest.TestCase):
    stepper = DEM
    rolling = 'rolling_friction = "0.2 mm"'

    # Every collision, the slowest and those that last included. The stepper sums forces times the velocities that they were found
    # with, half a sub-step ahead, and so comes near to its account of energies as sub-steps get short.
    def test_what_collisions_dissipate_is_the_loss_of_the_energy_account(self):
        loss = float(self.turning_drum()["contact_loss"])
        self.assertGreater(loss, 0.0)
        self.near(self.dissipated("drum"), loss, 0.01 * loss)

    def test_with_short_sub_steps_the_loss_is_that_of_the_account_more_nearly(self):
        scene = self.write("bounce.toml", body("ball", "ball", (0, 0, 0.0101), (0.5, 0, -1)), 0.01, 1, 0.5)
        for sub_step, tolerance in (("1.6e-6", 0.01), ("2e-7", 1e-3)):
            self.run_scene(scene, sub_step, "--set", f"time_stepper.sub_step={sub_step}")
            loss = float(self.table(sub_step, "steps.csv")[-1]["contact_loss"])
            self.assertGreater(loss, 0.3 * 0.5 * BALL)
            self.near(self.dissipated(sub_step), loss, tolerance * loss)

    # A ball falls into a neck, is pressed and pulled back: one collision from 0.1 m/s on, which takes what the neck keeps.
    def test_a_collision_lasts_while_a_neck_pulls(self):
        scene = self.write("neck.toml", body("ball", "ball", (0, 0, 0.0102), (0, 0, -0.1)), 0.02, 0.02, 1.0)
        text = scene.read_text().replace('type = "collision_energy"', 'type = "collision_energy"\nmin_speed = 0')
        law = text[text.index("[contact_law]"):text.index("[broad_phase]")]
        text = text.replace(law, '[contact_law]\ntype = "hertz_mindlin"\ncohesion = "jkr"\n')
        stone = 'density = "2500 kg/m3"\nyoung_modulus = "10 MPa"\nsurface_energy = "2 J/m2"'
        text += '[[observer]]\ntype = "contacts"\n[[observer]]\ntype = "track"\n'
        scene.write_text(text.replace('density = "2500 kg/m3"', stone).replace('[[force_field]]\ntype = "gravity"\n', ""))
        self.run_scene(scene, "neck")
        series = self.table("neck", "collision_energy_series.csv")
        self.assertEqual(sum(float(row["collisions"]) for row in series), 1)
        energy = 0.5 * BALL * 0.1**2
        loss = float(self.table("neck", "steps.csv")[-1]["contact_loss"])
        self.assertGreater(loss, 0.01 * energy)
        self.near(self.dissipated("neck"), loss, 0.01 * loss)
        self.near(0.01 * sum(float(row["normal_energy_rate"]) for row in series), energy, 1e-9 * energy)
        # The table of contacts has those that pull: only with them its impulses are all that changed the ball's velocity.
        pushes = [float(row["impulse_z"]) for row in self.table("neck", "contacts.csv")]
        self.assertLess(min(pushes), 0.0)
        gained = BALL * (float(self.table("neck", "track.csv")[-1]["vz"]) + 0.1)
        self.near(sum(pushes), gained, 1e-9 * gained)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
