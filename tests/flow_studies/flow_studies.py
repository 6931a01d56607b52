"""What observers of flows say about whole runs, against closed forms, with every time stepper and through a checkpoint.

usage: flow_studies.py SCREE
"""

import sys
import unittest

from whole_runs import BALL, G, RADIUS, WholeRuns, body

FLYING = ["mass_flow.csv", "mass_flow_crossings.csv", "residence_time.csv", "residence_time_stays.csv"]
BED = ["mixing.csv", "segregation.csv", "segregation_profile.csv", "size_distribution.csv",
       "size_distribution_histogram.csv", "continuum_profile.csv", "continuum_00000120.vti"]

STEPPERS = {
    "dvi": '[time_stepper]\ntype = "dvi"\n[ccp_solver]\ntype = "asgs"\ntolerance = 1e-8\nmax_iterations = 2000\n',
    "dem": '[time_stepper]\ntype = "dem"\n[contact_law]\ntype = "linear_spring_dashpot"\noverlap_target = 0.01\n'
           'overlap_speed = "1 m/s"\n',
}

SCENE = """
[simulation]
end_time = "{end} s"
time_step = "1 ms"
{stepper}
[broad_phase]
type = "grid"
[[force_field]]
type = "gravity"
acceleration = [0.0, 0.0, {gravity}]
[material.stone]
density = "2500 kg/m3"
friction = 0.4
restitution = 0.3
[shape.slab]
type = "box"
size = ["1 m", "1 m", "0.1 m"]
[shape.ball]
type = "sphere"
radius = "10 mm"
[shape.grain]
type = "sphere"
radius = "7 mm"
[[body]]
name = "plate"
shape = "slab"
material = "stone"
position = [0.0, 0.0, -0.05]
"""

OBSERVE_FLIGHT = """
[[observer]]
type = "mass_flow"
gate = {{ type = "rectangle", corner = [0.1, -0.2, 0.0], u = [0.0, 0.4, 0.0], v = [0.0, 0.0, 0.5] }}
interval = "10 ms"
crossings = true
[[observer]]
type = "residence_time"
region = {{ lower = [0.05, -0.2, 0.0], upper = [0.15, 0.2, 0.5] }}
interval = "10 ms"
"""

OBSERVE_BED = """
[[observer]]
type = "mixing"
classes = {{ type = "side", point = [0.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0] }}
grid = {{ lower = [-0.1, -0.1, 0.0], upper = [0.1, 0.1, 0.1], cells = [4, 1, 1] }}
min_particles = 1
interval = "7 ms"
neighbours = {{ type = "nearest", count = 4 }}
[[observer]]
type = "segregation"
classes = {{ type = "size", threshold = "17 mm" }}
axis = [0.0, 0.0, 1.0]
from = 0.0
to = 0.2
interval = "7 ms"
[[observer]]
type = "size_distribution"
classes = {{ smallest = "10 mm", largest = "25 mm", count = 5 }}
interval = "7 ms"
[[observer]]
type = "continuum"
grid = {{ lower = [-0.2, -0.2, -0.05], upper = [0.2, 0.2, 0.2], cells = [20, 20, 25] }}
width = "15 mm"
interval = "1 ms"
from = "{averaged_from} s"
contact_stress = true
"""


class FlowStudies(WholeRuns, unittest.TestCase):
    def write(self, name, stepper, bodies, end, gravity=-G, averaged_from=0.0):
        scene = self.folder / f"{name}.toml"
        text = SCENE + OBSERVE_FLIGHT + OBSERVE_BED
        scene.write_text(text.format(end=end, stepper=STEPPERS[stepper], gravity=gravity, averaged_from=averaged_from) + bodies)
        return scene

    # Balls that fly evenly: the third of them passes beside the gate, the fourth comes back through it. Times to rounding.
    def test_even_flight_passes_the_gate_when_it_should(self):
        for stepper in STEPPERS:
            bodies = "".join(body(f"b{i}", "ball", (0.0, y, 0.2), (speed, 0, 0))
                             for i, (y, speed) in enumerate(((0.0, 1.5), (0.05, 2.3), (0.3, 2.0))))
            bodies += body("back", "ball", (0.2, 0.1, 0.2), (-1.7, 0, 0))
            self.run_scene(self.write(stepper, stepper, bodies, 0.12, gravity=0.0), stepper)
            crossings = sorted(self.table(stepper, "mass_flow_crossings.csv"), key=lambda row: float(row["time"]))
            expected = [(0.1 / 2.3, "forward"), (0.1 / 1.7, "backward"), (0.1 / 1.5, "forward")]
            self.assertEqual([row["direction"] for row in crossings], [direction for _, direction in expected])
            for row, (time, _) in zip(crossings, expected):
                self.near(row["time"], time, 1e-12)
                self.near(row["x"], 0.1, 1e-12)
            stays = sorted(float(row["residence_time"]) for row in self.table(stepper, "residence_time_stays.csv"))
            for stay, speed in zip(stays, (2.3, 1.7, 1.5)):
                self.near(stay, 0.1 / speed, 1e-12)
            last = self.table(stepper, "mass_flow.csv")[-1]
            self.near(last["mass_forward"], 2 * BALL, 1e-12)
            self.near(last["mass_backward"], BALL, 1e-12)

    # A ball at rest on the plate: the stress of all cells is weight times radius, and there is no shear.
    def test_stress_under_a_resting_ball_is_weight_times_radius(self):
        for stepper in STEPPERS:
            scene = self.write(stepper, stepper, body("ball", "ball", (0, 0, RADIUS)), 0.3, averaged_from=0.25)
            self.run_scene(scene, stepper)
            rows = self.table(stepper, "continuum_profile.csv")
            volume = 0.4 * 0.4 * 0.01  # of a layer
            expected = BALL * G * RADIUS
            self.near(sum(float(row["contact_stress_zz"]) for row in rows) * volume, expected, 0.01 * expected)
            self.near(sum(float(row["contact_stress_xz"]) for row in rows) * volume, 0.0, 1e-6 * expected)
            self.near(sum(float(row["density"]) for row in rows) * volume, BALL, 1e-12 * BALL)

    # Everything at once, while a heap falls together: 60 ms and 60 ms more are 120 ms, on one thread and on two.
    def test_a_resumed_run_has_the_tables_of_one_run(self):
        places = [(0.021 * (i % 4 - 1.5), 0.0215 * (i // 4 % 3 - 1), 0.012 + 0.022 * (i // 12)) for i in range(36)]
        bodies = "".join(body(f"b{i}", "ball" if i % 3 else "grain", p, (0.3 if i % 2 else -0.2, 0, -0.4))
                         for i, p in enumerate(places))
        bodies += body("flying", "ball", (-0.1, 0.15, 0.3), (2, 0, 0))
        for stepper in STEPPERS:
            whole, half, second = (f"{stepper}_{part}" for part in ("whole", "half", "second"))
            for name, end in ((whole, 0.12), (half, 0.06)):
                self.run_scene(self.write(name, stepper, bodies, end), name, "--threads", "1")
            checkpoint = str(self.folder / half / "checkpoint.h5")
            self.run_scene(self.folder / f"{whole}.toml", second, "--resume", checkpoint, "--threads", "2")
            for name in FLYING + BED:
                one, two = ((self.folder / run / name).read_bytes() for run in (whole, second))
                self.assertEqual(one, two, f"{stepper}: {name}")
                self.assertGreater(len(one), 60, name)
            self.assertEqual(len(self.table(whole, "mixing.csv")), 19, "the first step, every seventh, and the end")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
