#include "scree/simulation/scene_filter.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "scree/config/scene_document.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;
using testing_parts::scene;

/// The text of the Error that a scene gives, or "" when it is accepted.
std::string refusal(const std::string& more) {
  const Catalog catalog;
  try {
    const SceneDocument document = SceneDocument::parse(scene(more));
    Simulation simulation{document, catalog, {}};
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void expect_refusal(const std::string& more, const std::string& sentence) {
  const std::string text = refusal(more);
  EXPECT_NE(text.find(sentence), std::string::npos) << text;
}

/// Two balls at one place: refused for their overlap as long as they meet.
std::string heap(const std::string& group_a, const std::string& group_b) {
  const auto body = [](const std::string& name, const std::string& group) {
    return "[[body]]\nname = '" + name + "'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\n" +
           (group.empty() ? "" : "collision_group = '" + group + "'\n");
  };
  return body("a", group_a) + body("b", group_b);
}

constexpr const char* kOverlap = "overlap by";

TEST(SceneFilter, without_groups_all_meet) { expect_refusal(heap("", ""), kOverlap); }

TEST(SceneFilter, a_group_without_a_list_meets_all) {
  expect_refusal("[collision_group.x]\n" + heap("", "x"), kOverlap);
  expect_refusal("[collision_group.x]\n" + heap("x", "x"), kOverlap);
}

// Law: two bodies meet only when both groups say so; a group that does not list itself does not meet itself.
TEST(SceneFilter, both_groups_have_to_agree) {
  const std::string groups = "[collision_group.x]\ncollides_with = ['default']\n[collision_group.y]\n";
  expect_refusal(groups + heap("x", ""), kOverlap);
  expect_refusal(groups + heap("y", "y"), kOverlap);
  EXPECT_EQ(refusal(groups + heap("x", "x")), "");
  EXPECT_EQ(refusal(groups + heap("y", "x")), "");
  EXPECT_EQ(refusal("[collision_group.x]\ncollides_with = []\n" + heap("", "x")), "");
  EXPECT_EQ(refusal("[collision_group.default]\ncollides_with = []\n" + heap("", "")), "");
}

TEST(SceneFilter, an_excluded_pair_does_not_touch) {
  EXPECT_EQ(refusal(heap("", "") + "[[excluded_pair]]\nbetween = ['b', 'a']\n"), "");
}

TEST(SceneFilter, unknown_names_are_refused_with_a_suggestion) {
  expect_refusal("[collision_group.walls]\n" + heap("", "wall"),
                 "'collision_group' names 'wall', which is no collision group of the scene; it has 'default' and "
                 "'walls'; did you mean 'walls'?");
  expect_refusal("[collision_group.walls]\ncollides_with = ['defautl']\n", "did you mean 'default'?");
  expect_refusal("[[source]]\ntype = 'drip'\ncollision_group = 'x'\n", "is no collision group of the scene");
  expect_refusal(heap("", "") + "[[excluded_pair]]\nbetween = ['a', 'c']\n",
                 "'between' names 'c', which is no body of the scene; named bodies are 'a' and 'b'");
  expect_refusal(heap("", "") + "[[excluded_pair]]\nbetween = ['a', 'a']\n", "names 'a' twice");
}

TEST(SceneFilter, groups_are_counted) {
  std::string groups;
  for (int k = 1; k < 32; ++k) groups += "[collision_group.g" + std::to_string(k) + "]\n";
  EXPECT_EQ(refusal(groups), "");
  expect_refusal(groups + "[collision_group.one_more]\n", "at most 32");
}

// Law: what a source feeds has the source's group, and keeps it through a checkpoint.
TEST(SceneFilter, fed_bodies_have_the_group_of_their_source) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(
      scene("[collision_group.x]\n[collision_group.y]\n[[source]]\ntype = 'drip'\ncollision_group = 'y'\n"));
  Simulation simulation{document, catalog, {}};
  simulation.step();
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "scree_scene_filter_test.h5";
  simulation.save(file);
  Simulation second{document, catalog, {}};
  second.resume(file);
  second.step();
  simulation.step();
  ASSERT_EQ(second.bodies().size(), 2u);
  for (const CollisionGroup group : second.bodies().view().collision_group) EXPECT_EQ(group, 2);
  EXPECT_EQ(second.state_hash(), simulation.state_hash());
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace scree
