"""Problems of FCLIB through `scree solve`: answers in closed form, and one sentence for each file that is none.

usage: fclib_solve.py SCREE FCLIB_SAMPLES
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCREE, SAMPLES = (os.path.abspath(argument) for argument in sys.argv[1:3])
SOLVERS = ("pgs", "asgs")
# The residual asked for [m/s]; over masses of a few kg it leaves impulses this exact.
TOLERANCE, EXACT = 1e-9, 1e-8


class FclibSolve(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        subprocess.run([SAMPLES, self.work], check=True)

    def scree(self, *arguments):
        return subprocess.run([SCREE, "solve", *arguments], cwd=self.work, text=True, capture_output=True, timeout=120)

    def solve(self, problem, solver, *more):
        """The figures and the solution that was written."""
        done = self.scree(problem, "--solver", solver, "--tolerance", str(TOLERANCE), "--json", "-o", "out.hdf5", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(done.stdout)
        self.assertEqual((figures["solver"], figures["status"]), (solver, "converged"))
        self.assertLessEqual(figures["residual"], TOLERANCE)
        printed = subprocess.run([SAMPLES, "print", "out.hdf5"], cwd=self.work, text=True, capture_output=True, check=True)
        return figures, json.loads(printed.stdout)

    def near(self, found, wanted):
        self.assertEqual(len(found), len(wanted))
        for a, b in zip(found, wanted):
            self.assertAlmostEqual(a, b, delta=EXACT)

    def test_a_sliding_mass_keeps_to_the_wall_with_exact_friction_only(self):
        for solver in SOLVERS:
            # Exact: u_n = 0 takes r_n = m; friction mu m, against the slip.
            figures, solution = self.solve("sliding.hdf5", solver, "--friction", "coulomb")
            self.near(solution["r"], [2, -1, 0])
            self.near(solution["u"], [0, 2.5, 0])
            self.assertLess(figures["coulomb_error"], 1e-8)
            self.assertLess(figures["velocity_violation"], 1e-8)
            # Associated: it leaves the wall at mu u_t. On the cone's surface u . (1, -mu) = 0 along r = n (1, -mu):
            # q . (1, -mu) + n |(1, -mu)|^2 / m = 0 with q = (-1, 3), hence n = 2 (1 + 1.5) / 1.25 = 4, u = (1, 2).
            figures, solution = self.solve("sliding.hdf5", solver)
            self.near(solution["r"], [4, -2, 0])
            self.near(solution["u"], [1, 2, 0])
            self.assertGreater(figures["coulomb_error"], 0.1)
            # 1/2 r W r + q r
            self.assertAlmostEqual(figures["objective"], 0.25 * 20 - 4 - 6, delta=EXACT)

    def test_a_stack_at_rest_stays_at_rest(self):
        for solver in SOLVERS:
            for friction in ("associated", "coulomb"):
                _, solution = self.solve("stack.hdf5", solver, "--friction", friction)
                self.near(solution["v"], [0] * 6)
                self.near(solution["u"], [0] * 6)
                self.near(solution["r"][0::3], [6, 4])
                # What holds the upper mass sideways is the constraint or friction: their sum is determined.
                self.assertAlmostEqual(solution["r"][4] + solution["l"][0], 0, delta=EXACT)

    def test_files_that_are_no_problems_are_refused_in_one_sentence(self):
        for file, said in (
            ("nan", "nan.hdf5: /fclib_local/vectors/q has nan at entry 1; finite numbers are needed"),
            ("negative_mu", "negative_mu.hdf5: /fclib_local/vectors/mu has -0.5 at entry 0; friction is not negative"),
            ("index", "index.hdf5: /fclib_local/W/i has 3 at entry 0; the matrix has 3 rows, counted from 0"),
            ("sizes", "sizes.hdf5: /fclib_local/vectors/mu has 2 numbers for 3 rows of contacts; 3 rows a contact are needed"),
            ("pulls", "pulls.hdf5: /fclib_local/W is not positive semidefinite: an eigenvalue of the symmetric part is -0.25 "
                      "or less, and the largest number of the diagonal 0.5; what masses make has none below zero, so look "
                      "for rows with a wrong sign or of another problem"),
            ("no_mass", "no_mass.hdf5: /fclib_global/M is not positive definite: elimination leaves 0 on the diagonal of "
                        "row 3, counted from 0; a mass matrix leaves positive numbers, so mend the masses and inertias of "
                        "that degree of freedom, or take it out"),
            ("missing", "missing.hdf5: /fclib_local/vectors/q is missing; an FCLIB problem needs it"),
            ("cut", "cut.hdf5 is damaged or cut short; a contact problem of scree or of FCLIB is needed"),
            ("text", "text.hdf5 is not an HDF5 file; a contact problem of scree or of FCLIB is needed"),
            ("other", "other.hdf5 holds neither a contact problem of scree nor one of FCLIB: it has no group "
                      "\"fclib_local\" or \"fclib_global\""),
        ):
            done = self.scree(f"{file}.hdf5", "--solver", "pgs")
            self.assertEqual(done.stderr, f"scree: error: {said}\n")
            self.assertEqual(done.returncode, 4)
            self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
