"""A short run of the separator gives the same bits: charging fields, feed, sinks, bins and the apgd solver take part.

usage: separator.py SCREE SCENE
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCREE, SCENE = (os.path.abspath(argument) for argument in sys.argv[1:3])
# A thin feed near the top of the roll; some grains have left by the end.
SHORT = ["--set", "source.feed.rate='400 1/s'", "--set", "simulation.end_time='0.7 s'"]


class Separator(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.work = pathlib.Path(cls.folder.name)
        cls.reference = cls.record_of("reference", "--threads", "1")

    @classmethod
    def record_of(cls, name, *arguments):
        subprocess.run([SCREE, "run", SCENE, "-o", name, "--quiet", *SHORT, *arguments], cwd=cls.work, check=True,
                       timeout=300, stdout=subprocess.DEVNULL)
        return json.loads((cls.work / name / "run.json").read_text())

    def removed(self, name):
        return (self.work / name / "removed.csv").read_text().splitlines()[1:]

    def expect_the_reference(self, record):
        self.assertEqual(record["state_hash"], self.reference["state_hash"])
        self.assertEqual(record["tables"], self.reference["tables"])  # what was fed, removed and binned

    def test_the_run_is_worth_the_test(self):
        self.assertEqual(self.reference["steps"], 700)
        self.assertGreater(self.reference["bodies"], 100)
        self.assertGreater(self.reference["contacts"], 10)
        self.assertGreater(len(self.removed("reference")), 0)

    def test_two_runs_agree(self):
        self.expect_the_reference(self.record_of("again", "--threads", "1"))
        self.assertEqual(self.removed("again"), self.removed("reference"))

    def test_one_and_two_threads_agree(self):
        self.expect_the_reference(self.record_of("threads", "--threads", "2"))

    def test_two_halves_make_a_whole(self):
        half = self.record_of("half", "--end-time", "0.35 s")
        self.assertEqual(half["steps"], 350)
        self.expect_the_reference(self.record_of("whole", "--resume", "half/checkpoint.h5", "--threads", "2"))
        self.assertEqual(self.removed("half") + self.removed("whole"), self.removed("reference"))

    def test_charges_count(self):
        """Another charge is another state, even before it has moved a grain."""
        few = ["--end-time", "0.05 s"]
        one = self.record_of("charged", *few)
        other = self.record_of("otherwise", *few, "--set", "source.feed.families.metal_spheres.attributes.is_sphere=2")
        self.assertEqual(one["contacts"], other["contacts"])
        self.assertNotEqual(one["state_hash"], other["state_hash"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
