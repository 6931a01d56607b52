// Motors, couplings, springs and stops in a step of dvi, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "jointed_world.hpp"
#include "scree/machine/functions/testing_function.hpp"

namespace scree::test {
namespace {

constexpr double kG = 9.81;
constexpr Vec3 kPivot{0, 0, kHigh};
constexpr double kH = 1e-3;  // [s]

/// A wheel of moment `j` on an axle along y.
struct Wheel : JointedWorld {
  explicit Wheel(double j) : body{add_body(kPivot, {j, j, j})} {}
  [[nodiscard]] Joint axle() const { return joint_at("revolute", kWorld, body, kPivot, {0, 1, 0}); }
  BodyId body;
};

TEST(dvi_motor, angle_is_imposed_exactly_at_every_step) {
  Wheel w{0.02};
  Motor drive = motor(0, Coordinate::rotation, Drive::position, 0.0);
  drive.value = function_of("{ type = 'expression', expression = '7 * sin(5 * t)' }");
  w.join({.joints = {w.axle()}, .motors = {drive}});
  for (int k = 0; k < 1000; ++k) {
    w.step(kH);
    ASSERT_NEAR(w.report(0).rotation, 7.0 * std::sin(5.0 * w.time), 1e-11);
  }
}

// tau = I dw / dt; the work is that of the kinetic energy, to rounding.
TEST(dvi_motor, torque_and_speed_obey_the_law_of_the_wheel) {
  Wheel w{0.02};
  w.join({.joints = {w.axle()}, .motors = {motor(0, Coordinate::rotation, Drive::effort, 0.3)}}, true);
  w.run(500, kH);
  EXPECT_NEAR(w.report(0).rotation_rate, 0.3 / 0.02 * 0.5, 1e-10);
  EXPECT_NEAR(w.report(1).effort_torque, 0.3, 1e-12);
  EXPECT_NEAR(w.report(1).energy, 0.5 * 0.02 * std::pow(0.3 / 0.02 * 0.5, 2), 1e-9);
}

TEST(dvi_motor, speed_comes_at_the_limit_of_the_torque) {
  Wheel w{0.02};
  Motor drive = motor(0, Coordinate::rotation, Drive::speed, 10.0);
  drive.limit = 0.5;
  w.join({.joints = {w.axle()}, .motors = {drive}}, true);
  w.run(200, kH);
  EXPECT_NEAR(w.report(0).rotation_rate, 0.5 / 0.02 * 0.2, 1e-9);
  EXPECT_NEAR(w.report(1).effort_torque, 0.5, 1e-9);
  w.run(300, kH);
  EXPECT_NEAR(w.report(0).rotation_rate, 10.0, 1e-9);
  EXPECT_NEAR(w.report(1).effort_torque, 0.0, 1e-6);
  EXPECT_NEAR(w.report(1).energy, 0.5 * 0.02 * 100.0, 1e-8);
}

// Whatever the solver leaves to the machine's own pass.
TEST(dvi_motor, limit_is_never_exceeded) {
  Wheel w{0.02};
  Motor drive = motor(0, Coordinate::rotation, Drive::speed, 10.0);
  drive.limit = 0.5;
  w.join({.joints = {w.axle()}, .motors = {drive}});
  w.host.tolerance = 1e-2;
  for (int k = 0; k < 500; ++k) {
    w.step(kH);
    ASSERT_LE(std::abs(w.report(1).effort_torque), 0.5 * (1 + 1e-12));
  }
  EXPECT_GT(w.report(0).rotation_rate, 9.0);
}

// Law of the account: the kinetic energy changes by the work of forces and joints, whatever springs and motors do.
TEST(dvi_motor, work_of_joints_closes_the_account) {
  JointedWorld w;
  const BodyId arm = w.add_body(kPivot + Vec3{0.4, 0, 0}, {0.01, 0.05, 0.05}, 2.0);
  Joint hinge = w.joint_at("revolute", kWorld, arm, kPivot, {0, 1, 0});
  hinge.law[0] = {.spring = {3.0, 0.2}};
  w.join({.joints = {hinge}, .motors = {motor(0, Coordinate::rotation, Drive::effort, 2.0)}}, true);
  double work = 0.0;
  for (int k = 0; k < 500; ++k) {
    const StepWork step = w.step(kH).work;
    work += step.force_work + step.joint_work;
    const Vec3 v = w.bodies.velocity[arm], turn = w.bodies.angular_velocity[arm];
    ASSERT_NEAR(work, 0.5 * 2.0 * squared_norm(v) + 0.5 * 0.05 * squared_norm(turn), 1e-10);
  }
}

// Two wheels, the second turns -2 times as fast: the torque sees I1 + 4 I2.
TEST(dvi_motor, gear_pair_turns_as_one_wheel_with_the_moments_added_by_the_ratio) {
  Wheel w{0.02};
  const BodyId second = w.add_body(kPivot + Vec3{0.3, 0, 0}, {0.01, 0.01, 0.01});
  w.join({.joints = {w.axle(), w.joint_at("revolute", kWorld, second, kPivot + Vec3{0.3, 0, 0}, {0, 1, 0})},
          .motors = {motor(0, Coordinate::rotation, Drive::effort, 0.6)},
          .couplings = {{.name = "gears", .first = 0, .second = 1, .ratio = -2.0}}},
         true);
  w.run(2000, kH);
  EXPECT_NEAR(w.report(0).rotation_rate, 0.6 / 0.06 * 2.0, 1e-8);
  EXPECT_NEAR(w.report(1).rotation_rate, -2.0 * w.report(0).rotation_rate, 1e-9);
  EXPECT_NEAR(w.report(1).rotation, -2.0 * w.report(0).rotation, 1e-10);
}

// A pinion of 50 mm lifts a rack: its weight m g asks for the torque m g r.
TEST(dvi_motor, rack_moves_by_the_radius_of_the_pinion) {
  Wheel w{0.02};
  const BodyId rack = w.add_body(kPivot + Vec3{0.05, 0, 0}, {0.01, 0.01, 0.01}, 3.0);
  w.join({.joints = {w.axle(), w.joint_at("prismatic", kWorld, rack, kPivot + Vec3{0.05, 0, 0}, {0, 0, 1})},
          .motors = {motor(0, Coordinate::rotation, Drive::speed, 4.0)},
          .couplings = {{.name = "rack",
                         .first = 0,
                         .second = 1,
                         .of_first = Coordinate::rotation,
                         .of_second = Coordinate::translation,
                         .ratio = 0.05}}});
  w.run(500, kH);
  EXPECT_NEAR(w.bodies.position[rack].z, kHigh + 0.05 * 4.0 * 0.5, 1e-10);
  EXPECT_NEAR(w.report(2).effort_torque, 3.0 * kG * 0.05, 1e-6);
}

// Implicit Euler of spring, damper and preload: k x + d v = -F at the end of the step.
TEST(dvi_motor, spring_step_is_implicit_euler) {
  JointedWorld w;
  const BodyId block = w.add_body(kPivot, {0.01, 0.01, 0.01}, 2.0);
  Joint slide = w.joint_at("prismatic", kWorld, block, kPivot, {0, 0, 1});
  const double k = 400.0, d = 3.0, rest = 0.05, preload = 7.0;
  slide.law[1] = {.spring = {k, d}, .rest = rest, .preload = preload};
  w.join({.joints = {slide}});
  double x = 0.0, v = 0.0;
  for (int i = 0; i < 500; ++i) {
    w.step(kH);
    v = (v + kH * (-kG + (preload - k * (x - rest)) / 2.0)) / (1.0 + kH * (kH * k + d) / 2.0);
    x += kH * v;
    ASSERT_NEAR(w.bodies.position[block].z - kHigh, x, 1e-11) << i;
  }
}

// A stiff hinge bends by its compliance under a load, and no further.
TEST(dvi_motor, compliant_joint_gives_way_by_the_load_over_its_stiffness) {
  JointedWorld w;
  const BodyId block = w.add_body(kPivot, {0.01, 0.01, 0.01}, 2.0);
  Joint weld = w.joint_at("fixed", kWorld, block, kPivot);
  weld.shift = {1e4, 100.0};
  w.join({.joints = {weld}});
  w.run(3000, kH);
  EXPECT_NEAR(w.bodies.position[block].z - kHigh, -2.0 * kG / 1e4, 1e-9);
}

TEST(dvi_motor, stop_holds_what_falls_on_it_and_gives_back_its_restitution) {
  for (const double e : {0.0, 0.5}) {
    JointedWorld w;
    const BodyId block = w.add_body(kPivot, {0.01, 0.01, 0.01}, 2.0);
    Joint slide = w.joint_at("prismatic", kWorld, block, kPivot, {0, 0, 1});
    slide.law[1].lower = -0.2;
    slide.law[1].stop_restitution = e;
    w.join({.joints = {slide}}, true);
    double lowest = 0.0, rebound = 0.0;
    while (w.time < 0.5) {
      const double before = w.bodies.velocity[block].z;
      w.step(kH);
      lowest = std::min(lowest, w.bodies.position[block].z - kHigh);
      if (rebound == 0.0 && w.bodies.velocity[block].z > 1e-6) rebound = -w.bodies.velocity[block].z / before;
    }
    EXPECT_NEAR(lowest, -0.2, 0.2 * kH * 10) << e;
    EXPECT_NEAR(rebound, e, 1e-9);
    if (e > 0.0) continue;
    EXPECT_NEAR(w.bodies.position[block].z - kHigh, -0.2, 1e-9);
  }
}

// A step that failed leaves no trace: what is saved is the state before it, and a joint that broke in it holds.
TEST(dvi_motor, undone_step_leaves_the_machine_as_it_was) {
  Wheel w{0.02};
  Joint axle = w.axle();
  axle.breaking_force = 1.0;
  w.join({.joints = {axle}, .motors = {motor(0, Coordinate::rotation, Drive::speed, 30.0)}});
  w.machine->keep();
  w.step(kH);
  ASSERT_TRUE(w.machine->is_gone(0));
  MemoryState after, before;
  MemoryWriter write_after{after}, write_before{before};
  w.machine->save(write_after);
  w.machine->undo();
  w.machine->save(write_before);
  EXPECT_FALSE(w.machine->is_gone(0));
  EXPECT_NE(MemoryReader{after}.doubles("angle"), MemoryReader{before}.doubles("angle"));
  EXPECT_EQ(MemoryReader{before}.doubles("energy"), (std::vector<double>{0.0, 0.0}));
}

// A restart in the middle goes on with the same bits.
TEST(dvi_motor, restart_keeps_every_bit) {
  const auto make = [] {
    auto w = std::make_unique<Wheel>(0.02);
    Motor drive = motor(0, Coordinate::rotation, Drive::speed, 30.0);
    drive.limit = 0.5;
    w->join({.joints = {w->axle()}, .motors = {drive}}, true);
    return w;
  };
  const auto straight = make(), first = make(), second = make();
  straight->run(1000, kH);
  first->run(500, kH);
  MemoryState state;
  MemoryWriter writer{state};
  first->machine->save(writer);
  second->resume(*first);
  second->machine->load(MemoryReader{state});
  second->run(500, kH);
  EXPECT_EQ(straight->bodies.orientation[1], second->bodies.orientation[1]);
  EXPECT_EQ(straight->report(1).energy, second->report(1).energy);
  EXPECT_EQ(straight->report(0).rotation, second->report(0).rotation);
}

}  // namespace
}  // namespace scree::test
