"""Contact problems of a run: recorded, solved again, compared.

usage: ccp_files.py SCREE
"""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
SCREE = os.path.abspath(sys.argv[1])
STEP = 140  # the heap lies in the funnel and still moves
KEYS = ["solver", "status", "iterations", "residual", "relative_residual", "coulomb_error", "objective", "wall_time",
        "cone_violation", "velocity_violation", "complementarity_gap", "friction", "solves"]
UNITS = {"residual": "m/s", "relative_residual": "1", "coulomb_error": "1", "objective": "J", "cone_violation": "N s",
         "velocity_violation": "m/s", "complementarity_gap": "J"}


def heap():
    """Balls on a lattice above the funnel, slightly askew."""
    text = ""
    for index in range(36):
        i, j, k = index % 3, index // 3 % 3, index // 9
        text += ('\n[[body]]\nshape = "ball"\nmaterial = "grain"\nmotion = "dynamic"\n'
                 f'position = ["{9 * i - 9 + 0.3 * (k % 2)} mm", "{9 * j - 9 + 0.2 * k} mm", "{20 + 9 * k} mm"]\n')
    return text


def scree(*arguments, folder, timeout=300):
    return subprocess.run([SCREE, *arguments], cwd=folder, capture_output=True, text=True, timeout=timeout)


class CcpFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.work = pathlib.Path(cls.folder.name)
        (cls.work / "scene.toml").write_text((HERE / "heap.toml").read_text() + heap())
        run = scree("run", "scene.toml", "-o", "out", "--quiet", "--record-ccp", f"t={STEP / 1000},0.05",
                    folder=cls.work)
        assert run.returncode == 0, run.stderr
        with open(cls.work / "out" / "steps.csv") as table:
            cls.steps = {int(row["step"]): row for row in csv.DictReader(table)}

    def solve(self, solver, *arguments):
        result = scree("solve", f"out/ccp_{STEP}.h5", "--solver", solver, "--json", *arguments, folder=self.work)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_the_scene_is_worth_the_test(self):
        self.assertGreater(int(self.steps[STEP]["contacts"]), 40)
        self.assertGreater(int(self.steps[STEP]["iterations"]), 3)

    def test_every_time_asked_for_leaves_a_file(self):
        self.assertTrue((self.work / "out" / "ccp_50.h5").exists())

    def test_recording_changes_nothing(self):
        plain = scree("run", "scene.toml", "-o", "plain", "--quiet", folder=self.work)
        self.assertEqual(plain.returncode, 0, plain.stderr)
        hashes = [json.loads((self.work / name / "run.json").read_text())["state_hash"] for name in ("out", "plain")]
        self.assertEqual(*hashes)

    def test_a_warm_solve_does_what_the_run_did(self):
        # Bit for bit the same problem and guess: the same iterations, and the same residual.
        again = self.solve("pgs", "--warm")
        self.assertEqual(list(again), KEYS)
        self.assertEqual(again["status"], self.steps[STEP]["status"])
        self.assertEqual(again["iterations"], int(self.steps[STEP]["iterations"]))
        self.assertEqual(again["residual"], float(self.steps[STEP]["residual [m/s]"]))

    def test_two_solvers_agree(self):
        # Impulses may be indeterminate; the velocities, and with them the objective, are not. At a residual of 1e-9 m/s the
        # objective is off by about (1e-9 / 1e-1)^2 of itself, far below what is asked.
        pgs = self.solve("pgs", "--tolerance", "1e-9", "--max-iterations", "100000")
        apgd = self.solve("apgd", "--tolerance", "1e-9", "--max-iterations", "100000")
        for answer in (pgs, apgd):
            self.assertEqual(answer["status"], "converged")
            self.assertLessEqual(answer["residual"], 1e-9)
        self.assertLess(pgs["objective"], 0.0)
        self.assertAlmostEqual(pgs["objective"] / apgd["objective"], 1.0, delta=1e-6)

    def test_threads_do_not_show(self):
        one, two = (self.solve("apgd", "--threads", threads) for threads in "12")
        for key in KEYS[:7] + KEYS[8:]:
            self.assertEqual(one[key], two[key], key)

    def test_a_solver_that_runs_out_of_iterations_says_so(self):
        short = self.solve("pgs", "--tolerance", "1e-12", "--max-iterations", "2")
        self.assertEqual((short["status"], short["iterations"]), ("iteration_limit", 2))

    def test_settings_reach_the_solver(self):
        self.assertNotEqual(self.solve("pgs", "--set", "relaxation=0.5")["iterations"], self.solve("pgs")["iterations"])

    def test_a_file_cut_short_is_refused(self):
        whole = (self.work / "out" / f"ccp_{STEP}.h5").read_bytes()
        (self.work / "cut.h5").write_bytes(whole[: len(whole) // 2])
        result = scree("solve", "cut.h5", "--solver", "pgs", folder=self.work)
        self.assertEqual(result.returncode, 4)
        self.assertIn("cut.h5 is damaged or cut short", result.stderr)

    def test_an_answer_that_cannot_be_kept_is_refused_before_the_solve(self):
        (self.work / "folder.hdf5").mkdir()
        refusals = {"nowhere/answer.hdf5": (4, "cannot create nowhere/answer.hdf5: No such file or directory; make its folder "
                                               "first, or choose another one."),
                    "folder.hdf5": (4, "cannot write folder.hdf5: Is a directory."),
                    "answer.csv": (2, "--output: 'answer.csv' is to hold the problem and its answer as FCLIB does, which is "
                                      "an HDF5 file; end its name in .hdf5 or .h5")}
        for name, (code, sentence) in refusals.items():
            # The solve itself would never end: it is asked for a residual of zero.
            result = scree("solve", f"out/ccp_{STEP}.h5", "--solver", "jacobi", "--tolerance", "0", "--max-iterations",
                           "1000000000", "-o", name, folder=self.work, timeout=60)
            self.assertEqual((result.returncode, result.stderr), (code, f"scree: error: {sentence}\n"))
        self.assertEqual(list(self.work.glob("*.part")), [])

    def test_contacts_that_roll_count_as_contacts(self):
        # They are blocks of six rows in the problem; the step counts what collision found.
        rolls = ("--set", "material.grain.rolling_friction=0.1 mm")
        run = scree("run", "scene.toml", "-o", "rolls", "--quiet", "--end-time", "0.05", "--record-ccp", "t=0.05", *rolls,
                    folder=self.work)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.work / "rolls" / "steps.csv") as table:
            contacts = list(csv.DictReader(table))[-1]["contacts"]
        self.assertGreater(int(contacts), 1)
        self.assertEqual(json.loads((self.work / "rolls" / "run.json").read_text())["contacts"], int(contacts))
        solve = scree("solve", "rolls/ccp_50.h5", "--solver", "pgs", folder=self.work)
        self.assertIn(f" {contacts} contacts, 0 other blocks, step 50", solve.stdout)
        _, rows = self.table("--vary", "ccp_solver=pgs", "--at", "0.05", *rolls)
        self.assertEqual({row["contacts"] for row in rows}, {contacts})

    def table(self, *arguments):
        """comparison.csv of a comparison in a folder of its own."""
        folder = tempfile.mkdtemp(dir=self.work)
        result = scree("compare", "scene.toml", "-o", f"{folder}/out", "--quiet", *arguments, folder=self.work)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(f"{folder}/out/comparison.csv") as table:
            return pathlib.Path(folder) / "out", list(csv.DictReader(table))

    def test_solvers_are_compared_on_the_problem_of_the_run(self):
        folder, rows = self.table("--vary", "ccp_solver=pgs,apgd", "--at", str(STEP / 1000))
        self.assertEqual([(row["solver"], row["start"]) for row in rows],
                         [("pgs", "cold"), ("apgd", "cold"), ("pgs", "warm"), ("apgd", "warm")])
        for row in rows:  # as `scree solve` finds it
            alone = self.solve(row["solver"], *(["--warm"] if row["start"] == "warm" else []))
            self.assertEqual(int(row["iterations"]), alone["iterations"])
            # Every figure under the same name, with its unit, and with the same bits.
            for name, unit in UNITS.items():
                self.assertEqual(float(row[f"{name} [{unit}]"]), alone[name])
            self.assertGreater(float(row["wall_time [s]"]), 0)
            self.assertAlmostEqual(float(row["time_per_iteration [s]"]) * int(row["iterations"]), float(row["wall_time [s]"]))
        for start in ("cold", "warm"):
            for axis in ("iterations", "time"):
                for ending in ("svg", "png"):
                    self.assertTrue((folder / f"convergence_{STEP}_{start}_{axis}.{ending}").exists())
        with open(folder / "convergence.csv") as table:
            curve = [row for row in csv.DictReader(table) if (row["solver"], row["start"]) == ("pgs", "cold")]
        # Watched, pgs tells the residual of every sweep, and ends at the one that the table has.
        self.assertEqual([int(row["iteration"]) for row in curve], list(range(len(curve))))
        self.assertEqual(len(curve) - 1, int(rows[0]["iterations"]))
        self.assertAlmostEqual(float(curve[-1]["residual [m/s]"]), float(rows[0]["residual [m/s]"]), delta=1e-9)

    def test_broad_phases_find_the_same_contacts_in_one_state(self):
        _, rows = self.table("--vary", "broad_phase=grid,bullet_dbvt", "--at", "0.05")
        self.assertEqual([row["broad_phase"] for row in rows], ["grid", "bullet_dbvt"])
        self.assertEqual(rows[0]["contacts"], rows[1]["contacts"])
        self.assertGreater(int(rows[0]["contacts"]), 0)
        self.assertEqual({(row["missed"], row["extra"]) for row in rows}, {("0", "0")})

    def test_settings_are_exchanged_too(self):
        _, rows = self.table("--vary", "simulation.time_step=0.001,0.002", "--at", "0.05")
        self.assertEqual([row["steps"] for row in rows], ["50", "25"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
