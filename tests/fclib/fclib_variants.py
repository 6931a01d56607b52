"""Every variant of FCLIB's format, written by h5py and judged by numpy: what scree answers solves the file's own equations.

usage: fclib_variants.py SCREE [SEED]
"""

import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SCREE = os.path.abspath(sys.argv[1])
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 1
SOLVERS = ("pgs", "asgs", "apgd", "spg")
CONTACTS = 8
# The residual asked for, and how far an equation may then be off: masses and impulses are of order 10.
TOLERANCE, ALLOWED = 1e-8, 1e-6


def put_matrix(place, name, matrix, storage):
    """A matrix as triplets, packed columns or packed rows."""
    rows, columns = matrix.shape
    i, j = np.nonzero(matrix)
    if storage == "columns":
        order = np.lexsort((i, j))
        i, j = i[order], j[order]
    begins = {"triplets": j, "columns": np.r_[0, np.cumsum(np.bincount(j, minlength=columns))],
              "rows": np.r_[0, np.cumsum(np.bincount(i, minlength=rows))]}[storage]
    group = place.create_group(name)
    for key, value in (("m", rows), ("n", columns), ("nzmax", len(i)), ("p", begins),
                       ("nz", {"triplets": len(i), "columns": -1, "rows": -2}[storage]),
                       ("i", j if storage == "rows" else i)):
        group[key] = np.atleast_1d(np.asarray(value, dtype="i4"))
    group["x"] = matrix[i, j]


class Problem:
    """A random feasible problem with n freedoms, and its equations."""

    def __init__(self, random, each, bilateral):
        n, m = 6 * CONTACTS, each * CONTACTS
        sparse = lambda rows, columns: random.normal(size=(rows, columns)) * (random.random((rows, columns)) < 0.3)
        root = sparse(n, n)
        self.each = each
        self.M = root @ root.T + np.diag(np.exp(random.normal(size=n)))
        self.H, self.G = sparse(n, m), sparse(n, bilateral)
        self.mu, self.rolling = random.uniform(0, 0.9, CONTACTS), random.uniform(0, 0.3, CONTACTS)
        self.mu[0] = 0
        # Some velocity has to satisfy all contacts, some of them with room.
        v = random.normal(size=n)
        self.w, self.b = -self.H.T @ v, -self.G.T @ v
        self.w[::each] += random.uniform(0, 1, CONTACTS) * (random.random(CONTACTS) < 0.5)
        self.f = self.M @ random.normal(size=n)

    def write(self, file, form, storage):
        with h5py.File(file, "w") as out:
            place = out.create_group(form)
            place["spacedim"] = np.array([self.each], dtype="i4")
            vectors = place.create_group("vectors")
            vectors["mu"] = self.mu
            if self.each == 5:
                vectors["mu_r"] = self.rolling
            if "global" in form:
                matrices, constants = {"M": self.M, "H": self.H, "G": self.G}, {"f": self.f, "w": self.w, "b": self.b}
            else:
                h, g = np.linalg.solve(self.M, self.H), np.linalg.solve(self.M, self.G)
                free = np.linalg.solve(self.M, self.f)
                matrices = {"W": self.H.T @ h, "V": self.H.T @ g, "R": self.G.T @ g}
                constants = {"q": self.w + self.H.T @ free, "s": self.b + self.G.T @ free}
            for name, matrix in matrices.items():
                if self.G.shape[1] > 0 or name in "MHW":
                    put_matrix(place, name, matrix, storage)
            for name, vector in constants.items():
                if len(vector) > 0:
                    vectors[name] = vector

    def error(self, file, coulomb):
        """The greatest error of the answer in `file` in any equation, cone or complementarity."""
        with h5py.File(file) as found:
            answer = {name: found["solution"][name][()] for name in found["solution"]}
        r, u, l = answer["r"], answer["u"], answer.get("l", np.zeros(0))
        v = np.linalg.solve(self.M, self.H @ r + self.G @ l + self.f)
        errors = [np.abs(self.H.T @ v + self.w - u).max(), *np.abs(self.G.T @ v + self.b)]
        if "v" in answer:
            errors.append(np.abs(answer["v"] - v).max())
        for c in range(CONTACTS):
            g, w = (x[c * self.each:(c + 1) * self.each].copy() for x in (r, u))
            parts = [(slice(1, min(self.each, 3)), self.mu[c])]
            if self.each == 5:
                parts.append((slice(3, 5), self.rolling[c]))
            rate = sum(mu * np.linalg.norm(w[part]) for part, mu in parts)
            w[0] += rate if coulomb else 0.0
            errors += [-g[0], rate - w[0], abs(g @ w) / (1 + np.abs(g).max())]
            errors += [np.linalg.norm(g[part]) - mu * g[0] for part, mu in parts]
        return max(errors)


class FclibVariants(unittest.TestCase):
    def test_answers_solve_the_equations_of_the_file(self):
        random = np.random.default_rng(SEED)
        solvers = itertools.cycle(SOLVERS)
        for form, each, bilateral in itertools.product(("fclib_local", "fclib_global"), (2, 3, 5), (0, 3)):
            for storage, friction in zip(("triplets", "columns", "rows"), ("associated", "coulomb", "coulomb")):
                solver = next(solvers)
                with self.subTest(form=form, each=each, bilateral=bilateral, storage=storage, solver=solver), \
                        tempfile.TemporaryDirectory() as folder:
                    file, out = pathlib.Path(folder, "problem.hdf5"), pathlib.Path(folder, "answer.hdf5")
                    problem = Problem(random, each, bilateral)
                    problem.write(file, form + ("_rolling" if each == 5 and storage == "rows" else ""), storage)
                    done = subprocess.run([SCREE, "solve", file, "--solver", solver, "--friction", friction, "--tolerance",
                                           str(TOLERANCE), "--json", "-o", out], capture_output=True, text=True, timeout=100)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(json.loads(done.stdout)["status"], "converged")
                    self.assertLess(problem.error(out, friction == "coulomb"), ALLOWED)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
