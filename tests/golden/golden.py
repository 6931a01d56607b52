"""Runs `scree` as a user would and compares exit code and message with a pinned case.

usage: golden.py CASE.toml SCREE FIXTURE_PLUGINS

A case is a TOML file:
    arguments = [...]          of the program; it runs in an empty folder that holds the case's files and base.toml
    exit = 2                   its exit code
    error = "..."              all of standard error
    output = ["...", ...]      lines that standard output must hold, optional
    absent = ["...", ...]      texts that standard output must not hold, optional
    made = {"out/x" = true}    files that must exist afterwards, or must not, optional
    record = {key = value}     entries of out/run.json, optional
    measures = {key = value}   entries of its `measures`, optional
    largest_file = 1000        bytes that a file may have, as if the disk were full, optional
    standard_output = "..."    a file that takes standard output, optional
    [files]                    name = contents
In all texts $PLUGINS is the folder of bad plugins, $OWN that of scree's own plugins, $WORK the empty folder.
"""

import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import tomllib
import unittest

HERE = pathlib.Path(__file__).parent
CASE, SCREE, FIXTURES = (os.path.abspath(argument) for argument in sys.argv[1:4])


class Golden(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name).resolve()
        own = pathlib.Path(SCREE).parent.parent / "lib" / "scree" / "plugins"
        self.places = {"$WORK": str(self.work), "$PLUGINS": FIXTURES, "$OWN": str(own)}
        self.case = tomllib.loads(self.in_full(pathlib.Path(CASE).read_text()))
        (self.work / "base.toml").write_text((HERE / "base.toml").read_text())
        for name, contents in self.case.get("files", {}).items():
            (self.work / name).parent.mkdir(parents=True, exist_ok=True)
            (self.work / name).write_text(contents)

    def in_full(self, text):
        for short, long in self.places.items():
            text = text.replace(short, long)
        return text

    def shortened(self, text):
        """The text as cases write it: folders by name, and what differs between machines masked."""
        for short, long in self.places.items():
            text = text.replace(long, short)
        text = re.sub(r"[0-9a-f]{16} here", "HERE here", text)
        text = re.sub(r"(gcc|clang) \d+ here", "COMPILER here", text)
        return re.sub(r"valid: '[^;]*", "valid: NAMES", text)

    def run_scree(self):
        def limit():
            size = self.case.get("largest_file")
            if size is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        environment = {key: value for key, value in os.environ.items() if key != "SCREE_PLUGIN_PATH"}
        with open(self.case.get("standard_output", self.work / "stdout.txt"), "w") as output:
            return subprocess.run([SCREE, *self.case["arguments"]], cwd=self.work, stdout=output, stderr=subprocess.PIPE,
                                  text=True, env=environment, preexec_fn=limit, timeout=120)

    def test_case(self):
        result = self.run_scree()
        self.assertEqual(self.shortened(result.stderr).strip(), self.shortened(self.case.get("error", "")).strip())
        self.assertEqual(result.returncode, self.case["exit"])
        if "output" in self.case or "absent" in self.case:
            written = (self.work / "stdout.txt").read_text()
            for line in self.case.get("output", []):
                self.assertIn(line, written)
            for text in self.case.get("absent", []):
                self.assertNotIn(text, written)
        for name, exists in self.case.get("made", {}).items():
            self.assertEqual((self.work / name).exists(), exists, name)
        if "record" in self.case or "measures" in self.case:
            record = json.loads((self.work / "out" / "run.json").read_text())
            for key, value in self.case.get("record", {}).items():
                self.assertEqual(record[key], value, key)
            for key, value in self.case.get("measures", {}).items():
                self.assertEqual(record["measures"][key], value, key)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
