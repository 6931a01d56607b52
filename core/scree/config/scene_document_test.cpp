#include "scree/config/scene_document.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "scree/config/validate.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

// A folder of scene files that goes away with the test.
class Folder {
 public:
  Folder() : path_{fs::temp_directory_path() / ("scree_scene_" + std::to_string(getpid()))} {
    fs::remove_all(path_);
    fs::create_directories(path_ / "parts");
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream{path_ / name} << text;
    return path_ / name;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

template <class Action>
std::string sentence_of(Action action, ErrorKind kind = ErrorKind::usage) {
  try {
    action();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), kind);
    return failure.what();
  }
  return "accepted";
}

TEST(scene_document, keys_keep_their_order_and_place) {
  const SceneDocument document = SceneDocument::parse("zeta = 1\nalpha = 2\n\n[roll]\n  radius = 3\n");
  EXPECT_EQ(document.root().keys(), (std::vector<std::string>{"zeta", "alpha", "roll"}));
  const SourceLocation place = document.root().table("roll").location("radius");
  EXPECT_EQ(place.file, "scene.toml");
  EXPECT_EQ(place.line, 5);
  EXPECT_EQ(place.column, 3);
  EXPECT_EQ(document.root().table("roll").location().line, 4);
}

TEST(scene_document, a_plain_table_is_a_list_of_one) {
  const SceneDocument document = SceneDocument::parse("[a]\nx = 1\n[[b]]\nx = 1\n[[b]]\nx = 2\n[[c]]\n");
  EXPECT_EQ(document.root().tables("a").size(), 1U);
  EXPECT_EQ(document.root().tables("b").size(), 2U);
  EXPECT_TRUE(document.root().tables("absent").empty());
  EXPECT_TRUE(document.root().table("c").keys().empty());
  EXPECT_EQ(sentence_of([&] { (void)document.root().table("b"); }),
            "scene.toml:3:3: 'b' must be one table [b], but is a list");
  EXPECT_EQ(sentence_of([&] { (void)document.root().table("a").text("x"); }),
            "scene.toml:2:1: 'x' must be a string, but is an integer");
  EXPECT_EQ(sentence_of([&] { (void)document.root().text("name"); }),
            "scene.toml:1:1: the required key 'name' is missing; the table has 'a', 'b' and 'c'");
}

TEST(scene_document, tables_without_keys_live_as_long_as_the_document) {
  const SceneDocument document = SceneDocument::parse("[field]\ntype = 'drag'\nlaw = 'stokes'\n");
  const std::vector<std::string_view> own{"type"};
  const SceneTable reduced = document.root().table("field").without(own);
  EXPECT_EQ(reduced.keys(), std::vector<std::string>{"law"});
  EXPECT_EQ(reduced.location().line, 1);
  EXPECT_TRUE(document.root().table("field").has("type"));
}

TEST(scene_document, own_keys_win_over_included_ones_and_lists_follow_them) {
  const Folder folder;
  folder.write("parts/base.toml", "a = 1\nb = 1\n[roll]\nradius = 1\nlength = 1\n[[source]]\nname = 'base'\n");
  folder.write("parts/more.toml", "b = 2\nc = 2\n[[source]]\nname = 'more'\n[sink]\nname = 'low'\n");
  const fs::path scene = folder.write(
      "scene.toml",
      "include = ['parts/base.toml', 'parts/more.toml']\nc = 3\n[roll]\nradius = 3\n[[source]]\nname = 'own'\n"
      "[[sink]]\nname = 'high'\n");
  const SceneDocument document = SceneDocument::load(scene);
  const SceneTable root = document.root();
  EXPECT_FALSE(root.has("include"));
  const std::vector<Parameter> numbers{Parameter::integer("a", ""), Parameter::integer("b", ""),
                                       Parameter::integer("c", "")};
  const std::vector<std::string_view> tables{"roll", "source", "sink"};
  const Options values = validate(root.without(tables), numbers, "the scene");
  EXPECT_EQ(values.integer("a"), 1);
  EXPECT_EQ(values.integer("b"), 2);  // a later include wins
  EXPECT_EQ(values.integer("c"), 3);
  EXPECT_EQ(root.table("roll").keys(), (std::vector<std::string>{"radius", "length"}));
  EXPECT_EQ(root.table("roll").location("radius").file, scene.string());
  EXPECT_EQ(root.table("roll").location("length").file, (folder.path() / "parts/base.toml").string());
  std::vector<std::string> names;
  for (const SceneTable& source : root.tables("source")) names.push_back(source.text("name"));
  EXPECT_EQ(names, (std::vector<std::string>{"base", "more", "own"}));
  EXPECT_EQ(root.tables("sink").size(), 2U);
}

TEST(scene_document, paths_start_from_the_file_that_wrote_them) {
  const Folder folder;
  folder.write("parts/base.toml", "table = 'table.csv'\n");
  const fs::path scene = folder.write("scene.toml", "include = 'parts/base.toml'\nmesh = 'drum.stl'\n");
  const std::vector<std::string> overrides{"log=run.log"};
  const SceneDocument document = SceneDocument::load(scene, overrides);
  const Options options = validate(document.root(),
                                   {Parameter::path("table", ""), Parameter::path("mesh", ""),
                                    Parameter::path("log", ""), Parameter::path("bed", "").by_default("bed.csv")},
                                   "the scene");
  const fs::path home = fs::canonical(folder.path());
  EXPECT_EQ(options.path("table"), home / "parts/table.csv");
  EXPECT_EQ(options.path("mesh"), home / "drum.stl");
  EXPECT_EQ(options.path("bed"), home / "bed.csv");
  EXPECT_EQ(options.path("log"), fs::current_path() / "run.log");
}

TEST(scene_document, a_file_included_twice_is_merged_once) {
  const Folder folder;
  folder.write("common.toml", "[[source]]\nname = 'one'\n");
  folder.write("a.toml", "include = ['common.toml']\n");
  folder.write("b.toml", "include = ['common.toml']\n");
  const SceneDocument document = SceneDocument::load(folder.write("scene.toml", "include = ['a.toml', 'b.toml']\n"));
  EXPECT_EQ(document.root().tables("source").size(), 1U);
}

TEST(scene_document, cycles_and_missing_files_are_refused) {
  const Folder folder;
  folder.write("b.toml", "include = ['a.toml']\n");
  const fs::path scene = folder.write("a.toml", "include = ['b.toml']\n");
  const std::string base = folder.path().string() + "/";
  EXPECT_EQ(sentence_of([&] { (void)SceneDocument::load(scene); }),
            base + "b.toml:1:12: the includes form a cycle: a.toml -> b.toml -> a.toml; remove one of them");
  EXPECT_EQ(sentence_of([&] { (void)SceneDocument::load(base + "none.toml"); }, ErrorKind::io),
            "scene file '" + base + "none.toml' cannot be read: No such file or directory");
  EXPECT_EQ(sentence_of([&] { (void)SceneDocument::load(folder.path()); }, ErrorKind::io),
            "scene file '" + folder.path().string() + "' cannot be read: it is a folder");
  const fs::path lost = folder.write("lost.toml", "\ninclude = ['gone.toml']\n");
  EXPECT_EQ(sentence_of([&] { (void)SceneDocument::load(lost); }, ErrorKind::io),
            base + "lost.toml:2:12: scene file '" + base + "gone.toml' cannot be read: No such file or directory");
  const fs::path number = folder.write("number.toml", "include = [1]\n");
  EXPECT_EQ(sentence_of([&] { (void)SceneDocument::load(number); }),
            base + "number.toml:1:12: 'include' must be a list of file names, but one entry is an integer");
}

TEST(scene_document, syntax_errors_have_a_place) {
  EXPECT_TRUE(sentence_of([] {
                (void)SceneDocument::parse("a = 1\nb = \n");
              }).starts_with("scene.toml:2:5: this is not valid TOML: "));
  // Which column of the second key it is, the parser decides.
  EXPECT_TRUE(sentence_of([] { (void)SceneDocument::parse("a = 1\na = 2\n"); }).starts_with("scene.toml:2:"));
}

}  // namespace
}  // namespace scree
