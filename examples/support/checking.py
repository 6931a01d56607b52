"""What the checks of the examples share: run a scene, read its tables, state a law and whether it holds.

A check is called as `check.py PROGRAM FOLDER [full]`: the scree program, and a folder for results; `full` asks for the
long form of checks that have one. It prints one line a law and exits with 1 when one of them is broken. Standard library
only.
"""

import csv
import json
import pathlib
import subprocess
import sys


STEPPERS = ("dvi", "dem")  # what scenes of granular flows are run with, one after the other


class Run:
    """The results of one run: `json` is run.json, `table(name)` a CSV table by column, without units."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.json = json.loads((self.folder / "run.json").read_text())

    def table(self, name):
        with open(self.folder / name, newline="") as file:
            rows = list(csv.reader(file))
        names = [column.split(" [")[0] for column in rows[0]]
        return {name: [number(row[i]) for row in rows[1:]] for i, name in enumerate(names)}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def run_scene(program, scene, folder, settings, arguments=()):
    """Runs a scene; `settings` are `--set` keys with double underscores for dots. Ends the script when the run fails."""
    command = [str(program), "run", str(scene), "-o", str(folder), "--overwrite", "--quiet"]
    for key, value in settings.items():
        text = str(value).lower() if isinstance(value, bool) else str(value)
        command += ["--set", f"{key.replace('__', '.')}={text}"]
    done = subprocess.run(command + list(arguments), text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")


class Check:
    """Collects laws; use as `with Check(__file__) as check:`."""

    def __init__(self, script):
        if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["full"]):
            sys.exit(f"usage: {script} PROGRAM FOLDER [full]")
        self.scene = pathlib.Path(script).resolve().parent / "scene.toml"
        self.program, self.folder = sys.argv[1], pathlib.Path(sys.argv[2])
        self.full = len(sys.argv) == 4
        self.broken = 0

    def __enter__(self):
        return self

    def __exit__(self, kind, value, trace):
        if kind is None:
            sys.exit(1 if self.broken else 0)

    def run(self, name="run", scene=None, arguments=(), **settings):
        """Runs the scene; `settings` are `--set` keys with double underscores for dots (simulation__seed=2)."""
        folder = self.folder / name
        run_scene(self.program, scene or self.scene, folder, settings, arguments)
        return Run(folder)

    def holds(self, law, condition, measured=""):
        self.broken += not condition
        print(f"{'holds ' if condition else 'BROKEN'}  {law}  {measured}")

    def near(self, law, value, expected, tolerance):
        """|value - expected| <= tolerance, absolute; say in `law` or beside it why the tolerance is what it is."""
        self.holds(law, abs(value - expected) <= tolerance,
                   f"measured {value:.9g}, expected {expected:.9g} +- {tolerance:.2g}")
