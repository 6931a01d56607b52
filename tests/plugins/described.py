"""Every plugin describes itself: in `scree plugins`, in `scree plugins show`, and in the JSON Schema of scenes.

usage: described.py SCREE PLUGIN_FOLDER
"""

import json
import os
import pathlib
import subprocess
import sys
import unittest

SCREE, FOLDER = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])


def scree(*arguments):
    return subprocess.run([SCREE, *arguments], check=True, capture_output=True, text=True, timeout=60).stdout


def words(node):
    """Every string constant in a JSON document."""
    if isinstance(node, dict):
        return set().union(*(words(value) for value in node.values()), set())
    if isinstance(node, list):
        return set().union(*(words(value) for value in node), set())
    return {node} if isinstance(node, str) else set()


class Described(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        lines = scree("plugins").splitlines()
        cls.names = [line.split()[0] for line in lines if not line.startswith(" ")]
        cls.text = "\n".join(lines)
        cls.schema = json.loads(scree("schema"))

    def test_every_library_in_the_folder_is_listed_with_its_file(self):
        libraries = sorted(FOLDER.glob("*.so"))
        self.assertGreater(len(libraries), 0)
        for library in libraries:
            self.assertIn(str(library), self.text)

    def test_every_plugin_shows_its_settings(self):
        for name in self.names:
            shown = scree("plugins", "show", name)
            self.assertTrue(shown.startswith(name + "\n"), shown)
            self.assertTrue("It takes no settings." in shown or len(shown.splitlines()) > 4, shown)

    def test_the_schema_knows_every_plugin_in_its_section(self):
        for kind, name in (full.split(":") for full in self.names):
            self.assertIn(kind, self.schema["properties"])
            self.assertIn(name, words(self.schema["$defs"][kind]), f"{kind}:{name}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
