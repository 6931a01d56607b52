#include "scree/machine/joint_assembly.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scree {
namespace {

NewBody body(const Vec3& at, double mass = 1.0) {
  NewBody made;
  made.pose.position = at;
  made.mass = mass;
  made.inertia = {0.01, 0.01, 0.01};
  made.radius = 0.1;
  return made;
}

Joint joint(const char* type, const JointEnd& a, const JointEnd& b) {
  return {.name = type, .type = find_joint_type(type), .a = a, .b = b};
}

JointEnd on(BodyId id, const Vec3& at) { return {id, {at, {}}}; }

// A four-bar linkage, drawn by eye: rods of 0.1, 0.3 and 0.2 m between pivots 0.3 m apart, each some way off.
MachineDescription four_bar() {
  return {.joints = {joint("revolute", on(kWorld, {0, 0, 0}), on(0, {-0.05, 0, 0})),
                     joint("revolute", on(0, {0.05, 0, 0}), on(1, {-0.15, 0, 0})),
                     joint("revolute", on(1, {0.15, 0, 0}), on(2, {0.1, 0, 0})),
                     joint("revolute", on(2, {-0.1, 0, 0}), on(kWorld, {0.3, 0, 0}))}};
}

TEST(joint_assembly, a_linkage_drawn_by_eye_is_put_together) {
  std::vector<NewBody> bodies{body({0.0, 0.06, 0}), body({0.15, 0.12, 0.02}), body({0.3, 0.08, 0})};
  bodies[0].pose.orientation = from_rotation_vector({0, 0, 1.4});
  bodies[1].pose.orientation = from_rotation_vector({0.05, 0, 0.3});
  bodies[2].pose.orientation = from_rotation_vector({0, 0, 1.8});
  const MachineDescription machine = four_bar();
  const AssemblyReport report = assemble(machine, bodies, true);
  EXPECT_TRUE(report.together) << report.error;
  EXPECT_GT(report.error_before, 0.01);
  // Pivots coincide, by the poses themselves.
  const auto point = [&](const JointEnd& e) {
    return transform(e.body == kWorld ? Pose{} : bodies[e.body].pose, e.frame.position);
  };
  for (const Joint& j : machine.joints) EXPECT_LT(norm(point(j.a) - point(j.b)), 1e-12);
  // A plane linkage of hinges repeats three equations: shifts along the axis and tilts.
  EXPECT_EQ(report.redundant_equations, 3u);
}

TEST(joint_assembly, what_cannot_go_together_is_told_with_the_worst_joint) {
  // A rod of 0.2 m between points 1 m apart.
  const MachineDescription machine{.joints = {joint("spherical", on(kWorld, {0, 0, 0}), on(0, {-0.1, 0, 0})),
                                              joint("spherical", on(kWorld, {1, 0, 0}), on(0, {0.1, 0, 0}))}};
  std::vector<NewBody> bodies{body({0.4, 0, 0})};
  const AssemblyReport report = assemble(machine, bodies, true);
  EXPECT_FALSE(report.together);
  EXPECT_NEAR(report.error, 0.4, 1e-3);  // shared by both ends
}

TEST(joint_assembly, nothing_moves_when_it_need_not_or_may_not) {
  const MachineDescription machine{.joints = {joint("spherical", on(kWorld, {0, 0, 0}), on(0, {-0.1, 0, 0}))}};
  std::vector<NewBody> together{body({0.1, 0, 0})}, apart{body({0.2, 0, 0})};
  EXPECT_TRUE(assemble(machine, together, true).together);
  EXPECT_EQ(together[0].pose, (Pose{{0.1, 0, 0}, {}}));
  const AssemblyReport report = assemble(machine, apart, false);
  EXPECT_FALSE(report.together);
  EXPECT_EQ(apart[0].pose, (Pose{{0.2, 0, 0}, {}}));
  EXPECT_NEAR(report.error, 0.1, 1e-15);
}

// The heavier body moves less: the norm of the mass matrix.
TEST(joint_assembly, bodies_share_the_way_by_their_masses) {
  const MachineDescription machine{.joints = {joint("spherical", on(0, {0, 0, 0}), on(1, {0, 0, 0}))}};
  std::vector<NewBody> bodies{body({0, 0, 0}, 9.0), body({1, 0, 0}, 1.0)};
  EXPECT_TRUE(assemble(machine, bodies, true).together);
  EXPECT_NEAR(bodies[0].pose.position.x, 0.1, 1e-9);
  EXPECT_NEAR(bodies[1].pose.position.x, 0.1, 1e-9);
}

// A motor that imposes an angle is an equation at t = 0, counted from any number of turns.
TEST(joint_assembly, bodies_start_where_their_motors_do) {
  MachineDescription machine{.joints = {joint("revolute", on(kWorld, {}), on(0, {}))}};
  machine.motors.push_back({.name = "m", .drive = Drive::position, .value = TimeFunction{5.0}});
  std::vector<NewBody> bodies{body({})};
  EXPECT_TRUE(assemble(machine, bodies, true).together);
  const Vec3 x = rotate(bodies[0].pose.orientation, {1, 0, 0});
  EXPECT_NEAR(x.x, std::cos(5.0), 1e-10);
  EXPECT_NEAR(x.y, std::sin(5.0), 1e-10);
}

TEST(joint_assembly, repeated_equations_are_counted_and_named) {
  // Fixed twice: six equations follow from the other six.
  const MachineDescription machine{
      .joints = {joint("fixed", on(kWorld, {}), on(0, {})), joint("fixed", on(kWorld, {}), on(0, {}))}};
  std::vector<NewBody> bodies{body({})};
  const AssemblyReport report = assemble(machine, bodies, true);
  EXPECT_EQ(report.redundant_equations, 6u);
  EXPECT_FALSE(report.redundant.empty());
  const MachineDescription one{.joints = {joint("fixed", on(kWorld, {}), on(0, {}))}};
  EXPECT_EQ(assemble(one, bodies, true).redundant_equations, 0u);
}

}  // namespace
}  // namespace scree
