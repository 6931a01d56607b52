"""The same scene gives the same bits: for 1 and 2 threads, run twice, in two halves, and with somebody looking.

usage: reproducible.py SCREE [balls a side of the heap]
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).parent
SCREE = os.path.abspath(sys.argv[1])
HEAP = int(sys.argv[2]) if len(sys.argv) > 2 else 6  # balls a side of the heap


def heap():
    """Bodies on a lattice, slightly askew so that no symmetry hides a difference; every third is a cluster."""
    text = ""
    for index in range(HEAP**3):
        i, j, k = index % HEAP, index // HEAP % HEAP, index // HEAP**2
        # Pitch 11 mm against a width of 10 mm of the longer shape; the heap begins above the drum.
        middle = 5.5 * (HEAP - 1)
        x, y, z = 11 * i - middle + 0.3 * (k % 3), 11 * j - middle + 0.2 * ((i + k) % 4), 55 + 11 * k
        shape = "pair" if index % 3 == 0 else "ball"
        text += (f'\n[[body]]\nshape = "{shape}"\nmaterial = "grain"\nmotion = "dynamic"\n'
                 f'position = ["{x} mm", "{y} mm", "{z} mm"]\n')
    return text


class Reproducible(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.work = pathlib.Path(cls.folder.name)
        (cls.work / "scene.toml").write_text((HERE / "mixed.toml").read_text() + heap())
        cls.reference = cls.record_of("reference", "--threads", "1")

    @classmethod
    def record_of(cls, name, *arguments, scene="scene.toml"):
        subprocess.run([SCREE, "run", scene, "-o", name, "--quiet", *arguments], cwd=cls.work, check=True, timeout=300,
                       stdout=subprocess.DEVNULL)
        return json.loads((cls.work / name / "run.json").read_text())

    def test_the_scene_is_worth_the_test(self):
        self.assertEqual(self.reference["exit_status"], 0)
        self.assertEqual(self.reference["steps"], 200)
        self.assertGreater(self.reference["contacts"], HEAP**3 / 2)  # the heap has come to lie on something

    def test_two_runs_agree(self):
        self.assertEqual(self.record_of("again", "--threads", "1")["state_hash"], self.reference["state_hash"])

    def test_one_and_two_threads_agree(self):
        self.assertEqual(self.record_of("threads", "--threads", "2")["state_hash"], self.reference["state_hash"])

    def test_another_scene_differs(self):
        other = self.record_of("other", "--set", "material.grain.friction=0.41")
        self.assertNotEqual(other["state_hash"], self.reference["state_hash"])

    def test_two_halves_make_a_whole(self):
        half = self.record_of("half", "--end-time", "0.1 s")
        self.assertEqual(half["steps"], 100)
        self.assertNotEqual(half["state_hash"], self.reference["state_hash"])
        whole = self.record_of("whole", "--resume", "half/checkpoint.h5", "--threads", "2")
        self.assertEqual(whole["steps"], 200)
        self.assertEqual(whole["state_hash"], self.reference["state_hash"])

    def test_rolling_friction_goes_through_threads_and_checkpoints_too(self):
        rolling = [part for key, arm in (("rolling", "0.1 mm"), ("spinning", "0.05 mm"))
                   for part in ("--set", f"material.grain.{key}_friction='{arm}'")]
        one = self.record_of("rolling", "--threads", "1", *rolling)
        self.assertNotEqual(one["state_hash"], self.reference["state_hash"])
        self.record_of("rolling_half", "--end-time", "0.1 s", *rolling)
        whole = self.record_of("rolling_whole", "--resume", "rolling_half/checkpoint.h5", "--threads", "2", *rolling)
        self.assertEqual(whole["state_hash"], one["state_hash"])

    def test_an_observer_changes_nothing(self):
        (self.work / "observed.toml").write_text('include = ["scene.toml"]\n[[observer]]\ntype = "vtk"\n')
        observed = self.record_of("observed", scene="observed.toml")
        self.assertIn("vtk", [plugin["name"] for plugin in observed["plugins"]])
        self.assertEqual(observed["state_hash"], self.reference["state_hash"])

    def test_an_interrupted_run_is_continued(self):
        run = subprocess.Popen([SCREE, "run", "scene.toml", "-o", "broken", "--set", "simulation.end_time='1000 s'"],
                               cwd=self.work, stdout=subprocess.PIPE, text=True)
        log = self.work / "broken" / "steps.csv"
        deadline = time.monotonic() + 60
        while not (log.exists() and log.read_text().count("\n") > 3) and time.monotonic() < deadline:
            time.sleep(0.02)
        run.send_signal(signal.SIGINT)
        output, _ = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertIn("interrupted at", output)
        broken = json.loads((self.work / "broken" / "run.json").read_text())
        self.assertEqual(broken["exit_status"], 130)
        self.assertGreater(broken["steps"], 0)
        end = ("--end-time", f"{(broken['steps'] + 20) * 1e-3} s")
        mended = self.record_of("mended", "--resume", "broken/checkpoint.h5", *end)
        whole = self.record_of("uninterrupted", *end)
        self.assertEqual(mended["steps"], broken["steps"] + 20)
        self.assertEqual(mended["state_hash"], whole["state_hash"])

    def test_a_checkpoint_of_another_scene_is_refused(self):
        result = subprocess.run([SCREE, "run", "scene.toml", "-o", "foreign", "--resume", "reference/checkpoint.h5",
                                 "--set", "material.grain.friction=0.41"], cwd=self.work, capture_output=True, text=True)
        self.assertEqual(result.returncode, 2)
        self.assertIn("was written by another scene", result.stderr)
        self.assertFalse((self.work / "foreign").exists())

    def test_resuming_at_or_past_the_end_says_so(self):
        for end in ("0.2 s", "0.1 s"):
            result = subprocess.run([SCREE, "run", "scene.toml", "-o", f"past {end}", "--quiet", "--end-time", end, "--resume",
                                     "reference/checkpoint.h5"], cwd=self.work, capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"nothing to do: the checkpoint is at 0.2 s, and the run ends at {end}", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
