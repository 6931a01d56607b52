"""Each rule refuses a bad file, says where, and lets a good one pass."""

import pathlib
import tempfile
import unittest

import cpp_text
import docs
import sizes
import units
import words


class RuleTest(unittest.TestCase):
    """A folder with the files of a test in it."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.root = pathlib.Path(self._folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def places(self, rule):
        return [(finding.path, finding.line) for finding in rule(self.root)]


class Sizes(RuleTest):
    def test_a_header_of_200_lines_passes_and_one_more_is_refused(self):
        self.write("a.hpp", "\n" * 200)
        self.assertEqual(self.places(sizes.rule), [])
        self.write("a.hpp", "\n" * 201)
        self.assertEqual(self.places(sizes.rule), [("a.hpp", 201)])

    def test_a_source_of_401_lines_is_refused_whatever_its_language(self):
        names = ["CMakeLists.txt", "a.cmake", "a.cpp", "a.py", "dev"]
        for name in names:
            self.write(name, "\n" * 401)
        self.assertEqual(self.places(sizes.rule), [(name, 401) for name in names])

    def test_a_function_of_61_lines_is_refused_at_its_first_line(self):
        function = "namespace scree {\n\nint f(int a) {\n" + "  // a brace in a comment }\n" * 58 + "}\n\n}\n"
        self.write("a.cpp", function)
        self.assertEqual(self.places(sizes.rule), [])
        self.write("a.cpp", function.replace(") {", ")\n{"))
        self.assertEqual(self.places(sizes.rule), [("a.cpp", 3)])

    def test_a_python_function_of_61_lines_is_refused(self):
        self.write("a.py", "def f():\n" + "    pass\n" * 60)
        self.assertEqual(self.places(sizes.rule), [("a.py", 1)])


class Functions(unittest.TestCase):
    def test_members_constructors_lambdas_tests_and_tables_are_told_apart(self):
        text = ('namespace a {\nstruct S : public B<int> {\n  S(int i) : i_{i}, j_{2} {}\n  int get() const { return i_; }\n'
                '  int i_{}, j_{3};\n};\nconst int table[] = {\n  1,\n};\ntemplate <class T>\nvoid g(T t) {\n'
                '  auto h = [&](int k) { return k; };\n}\nTEST(unit, law) {\n}\n}  // namespace a\n')
        names = [name for name, _, _ in cpp_text.functions(text)]
        self.assertIn("get", names)
        self.assertIn("g", names)
        self.assertIn("TEST(unit, law)", names)
        self.assertNotIn("h", names)
        lines = {name: (first, last) for name, first, last in cpp_text.functions(text)}
        self.assertEqual(lines["g"], (10, 13))

    def test_braces_in_strings_characters_and_directives_do_not_count(self):
        text = '#define OPEN \\\n  {\nvoid f() {\n  g("}", \'}\', R"x(}})x", 1\'000);\n}\nvoid h() {}\n'
        self.assertEqual(cpp_text.functions(text), [("f", 3, 5), ("h", 6, 6)])


class Units(unittest.TestCase):
    def lines(self, text, functions_too=False):
        return [line for line, _ in units.check(text, functions_too)]

    def test_a_number_without_a_unit_is_refused(self):
        self.assertEqual(self.lines("struct A {\n  double mass = 0.0;  ///< of the body\n};\n"), [2])
        self.assertEqual(self.lines("struct A {\n  std::span<const Vec3> position;\n};\n"), [2])
        self.assertEqual(self.lines("constexpr double kGravity = 9.81;\n"), [1])

    def test_a_unit_behind_above_or_on_the_struct_passes(self):
        self.assertEqual(self.lines("struct A {\n  double mass = 0.0;  ///< of the body [kg]\n};\n"), [])
        self.assertEqual(self.lines("struct A {\n  /// Of the body [kg].\n  std::vector<double> mass;\n};\n"), [])
        self.assertEqual(self.lines("/// In [any unit].\nstruct A {\n  double x, y;\n};\n"), [])

    def test_an_index_in_code_is_no_unit(self):
        self.assertEqual(self.lines("struct A {\n  double m = table[3];\n};\n"), [2])

    def test_private_members_and_other_types_are_free(self):
        self.assertEqual(self.lines("class A {\n  double mass_ = 0.0;\n  double more;\n public:\n  int count = 0;\n};\n"), [])
        self.assertEqual(self.lines("class A {\n public:\n  double mass = 0.0;\n};\n"), [3])

    def test_an_interface_function_with_numbers_names_a_unit(self):
        bare = "class A {\n public:\n  virtual void add(double time, int n) const = 0;\n};\n"
        self.assertEqual(self.lines(bare, functions_too=True), [3])
        self.assertEqual(self.lines(bare), [])
        said = bare.replace("  virtual", "  /// Adds at `time` [s].\n  virtual")
        self.assertEqual(self.lines(said, functions_too=True), [])


class Docs(RuleTest):
    def test_a_plugin_without_readme_or_snippet_is_refused(self):
        self.write("fields/x/CMakeLists.txt", "scree_add_plugin(x SOURCES x.cpp)\n")
        self.assertEqual(self.places(docs.rule), [("fields/x/CMakeLists.txt", 1)])
        self.write("fields/x/README.md", "# x\n")
        self.assertEqual(self.places(docs.rule), [("fields/x/README.md", 1)])
        self.write("fields/x/README.md", "# x\n```toml\n[[force_field]]\n```\n")
        self.assertEqual(self.places(docs.rule), [])

    def test_an_example_without_scene_is_refused(self):
        self.write("examples/fall/README.md", "# fall\n")
        self.assertEqual(self.places(docs.rule), [("examples/fall", 1)])

    def test_a_link_that_leads_nowhere_is_refused_with_its_line(self):
        self.write("docs/a.md", "# a\n\n[b](b.md#x) [web](https://example.org) `[code](no.md)`\n")
        self.assertEqual(self.places(docs.rule), [("docs/a.md", 3)])
        self.write("docs/b.md", "# b\n")
        self.assertEqual(self.places(docs.rule), [])

    def test_a_decision_of_41_lines_is_refused(self):
        self.write("docs/decisions/0001-x.md", "line\n" * 41)
        self.assertEqual(self.places(docs.rule), [("docs/decisions/0001-x.md", 41)])


class Words(RuleTest):
    def test_machine_paths_and_absent_documents_are_refused(self):
        self.write("a.md", "fine\nsee /home/me/x\nsee DESIGN.md\nsee ../shared/x\nGPU_WORK/a and a/work/b pass\n")
        self.assertEqual(self.places(words.rule), [("a.md", 2), ("a.md", 3), ("a.md", 4)])


if __name__ == "__main__":
    unittest.main()
