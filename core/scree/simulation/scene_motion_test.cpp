// Prescribed motions as a scene writes them, in a run.
#include "scree/simulation/scene_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "scree/config/scene_document.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;
using testing_parts::scene;

/// A kinematic ball `chute` at (0, 0, 1), a fixed one `wall`, and `more`.
std::string chute(const std::string& more) {
  return scene(
      "[[body]]\nname = 'chute'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'kinematic'\nposition = [0.0, 0.0, 1.0]\n"
      "[[body]]\nname = 'wall'\nshape = 'ball'\nmaterial = 'stone'\nposition = [5.0, 0.0, 0.0]\n" +
      more);
}

std::string motion(const std::string& keys, const std::string& body = "chute") {
  return "[[prescribed_motion]]\nbody = '" + body + "'\n" + keys + "\n";
}

void expect_refusal(const std::string& toml, const std::string& sentence) {
  const Catalog catalog;
  std::string text;
  try {
    const SceneDocument document = SceneDocument::parse(toml);
    Simulation simulation{document, catalog, {}};
  } catch (const Error& error) {
    text = error.what();
  }
  EXPECT_NE(text.find(sentence), std::string::npos) << text;
  EXPECT_TRUE(text.starts_with("scene.toml:")) << text;
}

constexpr const char* kSwing =
    "translation = {along = [0, 0, 2], by = {type = 'sine', mean = 0.1, amplitude = 0.3, frequency = 0.5, phase = "
    "1.0}}\n"
    "rotation = {about = [0, 1, 0], through = [1, 0, 1], speed = {type = 'expression', expression = 'exp(-t)'}}";

// z = 1 + R + way, from the start on; a turn by a about y through (1, 0, 1) takes (-1, 0, 0) to (-cos a, 0, sin a).
TEST(prescribed_motion_of_a_scene, body_follows_its_functions_from_the_start) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(chute(motion(kSwing)));
  Simulation simulation{document, catalog, {}};
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k, a = 1 - std::exp(-t);
    const double way = 0.1 + 0.3 * std::sin(std::numbers::pi * t + 1.0);
    const Vec3 expected{1 - std::cos(a), 0, 1 + std::sin(a) + way};
    // Ten integrals by five points over 0.1 s: far below rounding.
    EXPECT_LT(norm(simulation.bodies().view().position[0] - expected), 1e-14) << t;
    if (k < 10) simulation.step();
  }
  EXPECT_EQ(simulation.bodies().view().position[1], (Vec3{5, 0, 0})) << "others stay";
}

TEST(prescribed_motion_of_a_scene, goes_on_bit_for_bit_after_a_restart) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(chute(motion(kSwing)));
  const std::filesystem::path file = std::filesystem::path{testing::TempDir()} / "scree_scene_motion_test.h5";
  Simulation whole{document, catalog, {}}, second{document, catalog, {}};
  for (int k = 0; k < 4; ++k) whole.step();
  whole.save(file);
  second.resume(file);
  for (int k = 0; k < 5; ++k) {
    whole.step();
    second.step();
    EXPECT_EQ(second.state_hash(), whole.state_hash());
  }
  std::filesystem::remove(file);
  const SceneDocument other = SceneDocument::parse(chute(motion("translation = {along = [0, 0, 1], speed = 1.0}")));
  EXPECT_NE(Simulation(other, catalog, {}).scene_hash(), whole.scene_hash());
}

TEST(prescribed_motion_of_a_scene, function_that_becomes_infinite_ends_the_run_and_leaves_no_trace) {
  const Catalog catalog;
  const std::string keys =
      "translation = {along = [1, 0, 0], by = {type = 'expression', expression = 't < 0.25 ? t : 1/0'}}";
  const SceneDocument document = SceneDocument::parse(chute(motion(keys)));
  Simulation simulation{document, catalog, {}};
  simulation.step();
  simulation.step();
  const std::uint64_t before = simulation.state_hash();
  try {
    simulation.step();
    ADD_FAILURE() << "the step has to fail";
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("'by' is inf m at t = 0.3"), std::string::npos) << error.what();
  }
  EXPECT_EQ(simulation.state_hash(), before);
}

TEST(prescribed_motion_of_a_scene, bad_descriptions_are_refused_at_their_line) {
  const std::string shift = "translation = {along = [0, 0, 1], by = '1 mm'}";
  expect_refusal(chute(motion(shift, "chut")),
                 "'body' is 'chut', which is no body of the scene; named kinematic bodies are 'chute'");
  expect_refusal(chute(motion(shift, "wall")), "'body' is 'wall', which is fixed; only kinematic bodies move as told");
  expect_refusal(chute(motion(shift) + motion(shift)), "an earlier [[prescribed_motion]] moves already");
  expect_refusal(chute(motion("translation = {along = [0, 0, 0], by = 1.0}")), "'along' is zero and so no direction");
  expect_refusal(chute(motion("rotation = {about = [0, 0, 0], by = 1.0}")), "'about' is zero and so no direction");
  expect_refusal(chute(motion("translation = {along = [0, 0, 1]}")), "but has neither");
  expect_refusal(chute(motion("rotation = {about = [0, 0, 1], by = 1.0, speed = 1.0}")), "but has both");
  expect_refusal(chute(motion("")), "needs at least one of 'translation', 'rotation' and 'path'");
  expect_refusal(chute(motion(shift + "\npath = 'x.csv'")), "a path says the whole motion");
  expect_refusal(chute(motion("path = '/no/such/path.csv'")), "/no/such/path.csv cannot be read");
  expect_refusal(chute(motion("translation = {along = [0, 0, 1], by = {type = 'expression', expression = '2*'}}")),
                 "'expression' is \"2*\", which is wrong at character 3");
  expect_refusal(chute(motion("rotation = {about = [0, 0, 1], speed = '1 m/s'}")), "rad/s");
  expect_refusal(scene("[[body]]\nname = 'belt'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'kinematic'\n"
                       "velocity = [1.0, 0.0, 0.0]\n" +
                       motion(shift, "belt")),
                 "a [[prescribed_motion]] moves body 'belt'; keep one");
}

}  // namespace
}  // namespace scree
