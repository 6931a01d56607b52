// What core asks of observers: files of their own, and settings that a continued run keeps.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "scree/config/scene_document.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using namespace testing_parts;

std::string refusal(const std::string& text) {
  try {
    const Catalog catalog;
    const Simulation simulation{SceneDocument::parse(scene(text)), catalog, {}};
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string counter(const std::string& keys) { return "[[observer]]\ntype = 'counter'\n" + keys + "\n"; }

TEST(observer_rules, a_file_that_another_part_has_claimed_is_refused_at_the_later_one) {
  EXPECT_EQ(refusal(counter("name = 'a'") + counter("name = 'b'")), "");
  const std::string text = refusal(counter("name = 'b'") + "[[observer]]\ntype = 'writer'\nfile = 'counter_b.csv'\n");
  EXPECT_NE(text.find("'file' is 'counter_b.csv', which observer:counter 'b' writes too"), std::string::npos) << text;
  EXPECT_EQ(text.find("scene.toml:"), 0U) << text;
}

/// What a run that is continued with other settings of its observer is told.
std::string continued(const std::string& before, const std::string& after) {
  const auto file = std::filesystem::temp_directory_path() / ("scree_rules_" + std::to_string(::getpid()) + ".h5");
  const Catalog catalog;
  Simulation first{SceneDocument::parse(scene(before)), catalog, {}};
  first.step();
  first.save(file);
  Simulation second{SceneDocument::parse(scene(after)), catalog, {}};
  std::string told;
  try {
    second.resume(file);
    second.step();
  } catch (const Error& error) {
    told = error.what();
  }
  std::filesystem::remove(file);
  return told;
}

TEST(observer_rules, sums_go_on_with_the_settings_that_they_began_with) {
  EXPECT_EQ(continued(counter("unit = 2"), counter("unit = 2.0")), "");
  const std::string text = continued(counter(""), counter("unit = 2"));
  EXPECT_NE(text.find("'unit' is 2.0, but was 1.0 when the checkpoint was written"), std::string::npos) << text;
  EXPECT_EQ(text.find("scene.toml:"), 0U) << text;
}

TEST(observer_rules, observers_may_come_go_and_begin_anew) {
  EXPECT_EQ(continued(counter(""), ""), "");
  EXPECT_EQ(continued("", counter("unit = 2")), "");
  EXPECT_EQ(continued(counter(""), counter("name = 'new'\nunit = 2")), "");
  // One that keeps nothing may change.
  const std::string echo = "[[observer]]\ntype = 'writer'\n";
  EXPECT_EQ(continued(echo + "file = 'a.csv'\n", echo + "file = 'b.csv'\n"), "");
}

}  // namespace
}  // namespace scree
