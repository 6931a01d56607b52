"""The entry script refuses wrong use with a sentence, and a test that does not run is no success."""

import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def call(command, **environment):
    """Runs a command; CI and package installation are off unless asked for."""
    variables = {k: v for k, v in os.environ.items() if k != "CI"} | {"SCREE_PACKAGES": "off"} | environment
    return subprocess.run(command, capture_output=True, text=True, env=variables, check=False)


class WrongUse(unittest.TestCase):
    def assert_refused(self, arguments, *words):
        done = call([str(ROOT / "dev"), *arguments])
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, "one sentence, one line")
        for word in words:
            self.assertIn(word, done.stderr)

    def test_an_unknown_command_lists_the_valid_ones(self):
        self.assert_refused(["fly"], '"fly"', "run, test, bench, check, build, fuzz")

    def test_an_unknown_preset_lists_the_valid_ones(self):
        self.assert_refused(["build", "quick"], '"quick"', "release", "dev", "asan", "tsan")

    def test_fuzz_lists_its_targets(self):
        self.assert_refused(["fuzz"], "fuzz_fclib")
        self.assert_refused(["fuzz", "nothing"], '"nothing"', "fuzz_fclib")

    def test_run_without_a_scene_says_what_it_needs(self):
        self.assert_refused(["run"], "scene.toml", "for example")
        self.assert_refused(["run", "no/such/folder"], '"no/such/folder"', "examples/")
        self.assert_refused(["run", str(ROOT / "docs")], "has no scene.toml", "examples/")

    def test_help_names_every_command(self):
        done = call([str(ROOT / "dev"), "help"])
        self.assertEqual(done.returncode, 0)
        for command in ("run", "test", "bench", "check", "build", "fuzz"):
            self.assertIn(f"\n  {command} ", done.stdout)


class RunTests(unittest.TestCase):
    """tools/dev/run_tests on a folder with tests of this kind."""

    def status(self, tests, **environment):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(tests, encoding="utf-8")
            return call([str(ROOT / "tools/dev/run_tests"), folder], **environment).returncode

    def test_a_passing_test_is_success(self):
        self.assertEqual(self.status("add_test(good true)\n", CI="true"), 0)

    def test_a_failing_test_and_no_test_at_all_are_failures(self):
        self.assertNotEqual(self.status("add_test(bad false)\n"), 0)
        self.assertNotEqual(self.status("# nothing\n"), 0)

    def test_a_test_that_does_not_run_is_a_failure_in_ci_only(self):
        skipped = 'add_test(good true)\nadd_test(s sh -c "exit 77")\nset_tests_properties(s PROPERTIES SKIP_RETURN_CODE 77)\n'
        disabled = "add_test(good true)\nadd_test(d true)\nset_tests_properties(d PROPERTIES DISABLED TRUE)\n"
        for tests in (skipped, disabled):
            self.assertEqual(self.status(tests), 0)
            self.assertNotEqual(self.status(tests, CI="true"), 0)


if __name__ == "__main__":
    unittest.main()
