#include "scree/simulation/scene_machine.hpp"

#include <gtest/gtest.h>

#include "scree/config/scene_document.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;
using testing_parts::scene;

/// A crank and a wall, then `more`. Crank is dynamic, wall fixed.
std::string machine(const std::string& more) {
  return "[[body]]\nname = 'crank'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\nposition = [5.0, 0.0, "
         "0.0]\n"
         "frames = [{ name = 'pin', position = [0.1, 0.0, 0.0] }]\n"
         "[[body]]\nname = 'wall'\nshape = 'ball'\nmaterial = 'stone'\nposition = [9.0, 0.0, 0.0]\n"
         "[[body]]\nname = 'roof'\nshape = 'ball'\nmaterial = 'stone'\nposition = [13.0, 0.0, 0.0]\n" +
         more;
}

std::string axle(const std::string& more = "") {
  return "[[joint]]\nname = 'axle'\ntype = 'revolute'\nbetween = ['world', 'crank']\nposition = [5.0, 0.0, 0.0]\n" +
         more;
}

std::string motor(const std::string& name, const std::string& more) {
  return "[[motor]]\nname = '" + name + "'\njoint = 'axle'\n" + more;
}

void expect_refusal(const std::string& more, const std::string& sentence) {
  const Catalog catalog;
  try {
    const SceneDocument document = SceneDocument::parse(scene(machine(more)));
    const Simulation simulation{document, catalog, {}};
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(sentence), std::string::npos) << text;
    EXPECT_NE(text.find("scene.toml:"), std::string::npos) << text;
    return;
  }
  ADD_FAILURE() << "accepted, but expected: " << sentence;
}

TEST(scene_machine, joints_name_bodies_and_frames_that_exist) {
  const auto between = [](const std::string& names) {
    return "[[joint]]\nname = 'j'\ntype = 'revolute'\nbetween = " + names + "\nposition = [0.0, 0.0, 0.0]\n";
  };
  expect_refusal(between("['world', 'krank']"),
                 "'krank', which is no body of the scene; named bodies are 'world', 'crank'");
  expect_refusal(between("['world', 'crank.pim']"),
                 "body 'crank' has no frame 'pim'; its frames are 'pin'; did you mean 'pin'?");
  expect_refusal(between("['crank', 'crank']"), "one and the same; a joint ties two bodies");
  expect_refusal(between("['wall', 'roof']"), "no force moves either");
  expect_refusal(between("['wall', 'world']"), "no force moves either");
  expect_refusal(between("['crank']"), "2");
}

TEST(scene_machine, a_joint_needs_a_place_and_a_direction) {
  expect_refusal("[[joint]]\nname = 'j'\ntype = 'spherical'\nbetween = ['world', 'crank']\n", "joint 'j' has no place");
  expect_refusal(axle("axis = [0.0, 0.0, 0.0]\n"), "'axis' is zero and so has no direction");
  expect_refusal(axle("axis = [0.0, 0.0, 1.0]\nreference = [0.0, 0.0, 2.0]\n"), "no part that is square to `axis`");
  expect_refusal(axle("distance = 1.0\n"), "belongs to joints of type distance");
  expect_refusal(axle("damping = 1.0\n"), "acts with a compliance only");
  expect_refusal(axle("rotation = { lower = 1.0, upper = 0.0 }\n"), "lies above `upper`");
  expect_refusal(axle("translation = { stiffness = 1.0 }\n"), "a revolute joint has no translation");
  expect_refusal(axle("rotation = { preload = 1.0 }\n"), "needs a spring");
  expect_refusal(axle() + axle(), "names must differ");
}

TEST(scene_machine, motors_drive_what_exists_once) {
  expect_refusal(axle() + "[[motor]]\nname = 'm'\njoint = 'axel'\ntorque = 1.0\n", "did you mean 'axle'?");
  expect_refusal(axle() + motor("m", ""), "imposes nothing");
  expect_refusal(axle() + motor("m", "angle = 1.0\ntorque = 1.0\n"), "a motor imposes one of them");
  expect_refusal(axle() + motor("m", "speed = '1 m/s'\n"),
                 "drives a translation, which joint 'axle' of type revolute does not have");
  expect_refusal(axle() + motor("m", "angular_speed = '1 rpm'\nforce_limit = '1 N'\n"), "give `torque_limit`");
  expect_refusal(axle() + motor("one", "angular_speed = '1 rpm'\n") + motor("two", "angle = 0.0\n"),
                 "whose rotation motor 'one' drives already; two would contradict each other");
}

// Through two joints of one axis as well as through one, and against stops.
TEST(scene_machine, motors_that_contradict_the_machine_are_refused) {
  const std::string second =
      "[[joint]]\nname = 'axle2'\ntype = 'revolute'\nbetween = ['world', 'crank']\nposition = [5.0, 0.0, 2.0]\n";
  const std::string two = "[[motor]]\nname = 'two'\njoint = 'axle2'\nangular_speed = 2.0\n";
  expect_refusal(axle() + second + motor("one", "angular_speed = 1.0\n") + two,
                 "motor 'two' imposes what other joints and motors determine already");
  expect_refusal(axle("rotation = { upper = 1.0 }\n") + motor("m", "angular_speed = 1.0\n"),
                 "has stops, and would break through them; give the motor a `torque_limit`");
  expect_refusal(axle("rotation = { lower = 1.0, upper = 2.0 }\n"), "starts at 0 rad, outside its stops from 1 to 2");
}

TEST(scene_machine, couplings_name_two_coordinates) {
  const auto coupling = [](const std::string& more) { return "[[coupling]]\nname = 'gears'\n" + more; };
  expect_refusal(axle() + coupling("joints = ['axle', 'x']\nratio = 2.0\n"), "no joint of the scene");
  expect_refusal(axle() + coupling("joints = ['axle', 'axle']\nratio = 2.0\n"), "names one joint twice");
  expect_refusal(axle() + coupling("joints = ['axle', 'axle']\nalong = ['rotation', 'translation']\nratio = 2.0\n"),
                 "which has none");
}

TEST(scene_machine, bodies_that_cannot_meet_are_refused_with_the_joint_and_its_error) {
  const std::string rod =
      "[[joint]]\nname = 'one'\ntype = 'spherical'\nbetween = ['world', 'crank']\nposition = [5.0, 0.0, 0.0]\n"
      "[[joint]]\nname = 'two'\ntype = 'spherical'\nbetween = ['crank.pin', 'wall']\nposition = [7.0, 0.0, 0.0]\n";
  expect_refusal(rod, "however its bodies are moved");
}

TEST(scene_machine, a_stepper_that_knows_no_joints_is_refused) {
  expect_refusal(axle(), "the scene has joints, but time_stepper:");
}

}  // namespace
}  // namespace scree
