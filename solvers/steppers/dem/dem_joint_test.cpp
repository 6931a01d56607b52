// Joints and motors in dem, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem_world.hpp"
#include "scree/machine/joint_type.hpp"

namespace scree {
namespace {

using test::DemWorld;

constexpr double kG = 9.81, kPi = std::numbers::pi;

/// A body that touches nothing on an axle along y through the origin of the world.
struct Hinged : DemWorld {
  Hinged(const Vec3& at, const Vec3& moments, const DemOptions& options) : DemWorld{options} {
    host.gravity = {0, 0, -kG};
    PrimitiveData box;
    box.primitive.kind = ShapeKind::box, box.primitive.size = {0.01, 0.01, 0.01};
    body = bodies.add(1, Motion::dynamic, at, 0.01, 1.0, moments, {});
    bodies.shape[body] = add_shape(box, 1e-6);
  }
  [[nodiscard]] Joint axle() const {
    const Pose frame{{}, rotation_between({0, 0, 1}, {0, 1, 0})};
    return {.name = "axle",
            .type = find_joint_type("revolute"),
            .a = {kWorld, frame},
            .b = {1, inverse(Pose{bodies.position[body], bodies.orientation[body]}) * frame}};
  }
  void join(MachineDescription description) {
    machine = std::make_unique<Machine>(std::move(description));
    machine->start(bodies.view());
    host.joints = machine.get();
  }
  std::size_t body;
  std::unique_ptr<Machine> machine;
};

TEST(dem_joint, pendulum_has_the_period_of_the_elliptic_integral) {
  // T / T0 = 1.1803405990 at 90 degrees, T0 = 2 pi sqrt((m l2 + j) / (m g l)).
  const auto error_of = [](double h) {
    Hinged world{{1, 0, 0}, {1e-3, 1e-3, 1e-3}, {.sub_step = h, .force_step = true}};
    world.join({.joints = {world.axle()}});
    std::vector<double> zeros;
    while (zeros.size() < 3 && world.time < 10.0) {
      const double before = world.bodies.position[world.body].x;
      world.step(4e-3);
      const double after = world.bodies.position[world.body].x;
      if (before * after <= 0.0) zeros.push_back(world.time - 4e-3 * after / (after - before));
      EXPECT_NEAR(norm(world.bodies.position[world.body]), 1.0, 1e-12);
    }
    return (zeros[2] - zeros[0]) / (2.0 * kPi * std::sqrt(1.001 / kG)) - 1.1803405990;
  };
  const double coarse = error_of(4e-3), fine = error_of(2e-3);
  EXPECT_LT(std::abs(fine), 1e-4);
  EXPECT_GT(coarse / fine, 3.0);
}

TEST(dem_joint, torque_and_energy_obey_the_law_of_the_wheel) {
  Hinged world{{}, {0.02, 0.02, 0.02}, {.sub_step = 1e-4, .force_step = true}};
  Motor motor{.name = "motor", .drive = Drive::effort, .value = TimeFunction{0.3}};
  world.join({.joints = {world.axle()}, .motors = {motor}});
  StepWork work;
  for (int k = 0; k < 500; ++k) work += world.step(1e-3).work;
  const double w = world.bodies.angular_velocity[world.body].y;
  EXPECT_NEAR(w, 0.3 / 0.02 * 0.5, 1e-9);
  const double kinetic = 0.5 * 0.02 * w * w;
  EXPECT_NEAR(work.joint_work, kinetic, 1e-9 * kinetic);
  EXPECT_NEAR(work.force_work, 0.0, 1e-9 * kinetic) << "gravity finds the hub at rest";
  EXPECT_NEAR(world.machine->reports()[1].energy, kinetic, 1e-9 * kinetic) << "the motor's";
  EXPECT_NEAR(world.machine->reports()[0].energy, 0.0, 1e-9 * kinetic) << "the bearing's";
}

TEST(dem_joint, a_body_that_is_held_stands_still_and_nothing_does_work) {
  Hinged world{{1, 0, 0}, {0.02, 0.02, 0.02}, {.sub_step = 1e-4, .force_step = true}};
  Joint weld = world.axle();
  weld.type = find_joint_type("fixed");
  world.join({.joints = {weld}});
  StepWork work;
  for (int k = 0; k < 100; ++k) {
    work += world.step(1e-3).work;
    ASSERT_LT(norm(world.bodies.velocity[world.body]), 1e-11);
    ASSERT_LT(norm(world.bodies.angular_velocity[world.body]), 1e-11);
  }
  EXPECT_NEAR(work.force_work, 0.0, 1e-10);
  EXPECT_NEAR(work.joint_work, 0.0, 1e-10);
  const MachineReport& report = world.machine->reports()[0];
  EXPECT_NEAR(report.energy, 0.0, 1e-10);
  EXPECT_LT(norm(report.force - Vec3{0, 0, kG}), 1e-6 * kG);
  EXPECT_LT(norm(report.torque - Vec3{0, -kG, 0}), 1e-6 * kG) << "about the origin, of a weight 1 m along x";
}

// Law: at the turning points and everywhere else the energy is that at the start; velocities and poses are those of one time.
TEST(dem_joint, a_pendulum_keeps_its_energy_to_second_order) {
  const auto error_of = [](double h) {
    Hinged world{{1, 0, 0}, {1e-3, 1e-3, 1e-3}, {.sub_step = h, .force_step = true}};
    world.join({.joints = {world.axle()}});
    double worst = 0.0;
    for (int k = 0; k < 500; ++k) {
      world.step(4e-3);
      const Vec3 v = world.bodies.velocity[world.body], w = world.bodies.angular_velocity[world.body];
      const double energy = 0.5 * squared_norm(v) + 0.5e-3 * squared_norm(w) + kG * world.bodies.position[world.body].z;
      worst = std::max(worst, std::abs(energy));
      EXPECT_NEAR(dot(v, world.bodies.position[world.body]), 0.0, 1e-11) << "along its way";
    }
    return worst;
  };
  const double coarse = error_of(4e-3), fine = error_of(2e-3);
  EXPECT_LT(fine, 1e-4 * kG);
  EXPECT_GT(coarse / fine, 3.5);
}

// Law: a mass on a damped spring comes to rest where the spring bears its weight.
TEST(dem_joint, a_spring_bears_the_weight_of_what_hangs_on_it) {
  constexpr double kStiffness = 100.0;
  Hinged world{{}, {0.02, 0.02, 0.02}, {.sub_step = 1e-3, .force_step = true}};
  Joint rail = world.axle();
  rail.type = find_joint_type("prismatic");
  rail.a.frame = rail.b.frame = {};  // along z
  rail.law[static_cast<std::size_t>(Coordinate::translation)].spring = {.stiffness = kStiffness, .damping = 20.0};
  world.join({.joints = {rail}});
  for (int k = 0; k < 1000; ++k) world.step(4e-3);
  EXPECT_NEAR(world.bodies.position[world.body].z, -kG / kStiffness, 1e-9);
  EXPECT_LT(norm(world.bodies.velocity[world.body]), 1e-9);
  EXPECT_NEAR(world.machine->reports()[0].force.z, kG, 1e-6);
}

TEST(dem_joint, a_stop_is_not_passed) {
  Hinged world{{1, 0, 0}, {1e-3, 1e-3, 1e-3}, {.sub_step = 1e-4, .force_step = true}};
  Joint axle = world.axle();
  axle.law[static_cast<std::size_t>(Coordinate::rotation)].upper = 0.5;
  axle.law[static_cast<std::size_t>(Coordinate::rotation)].lower = -0.5;
  world.join({.joints = {axle}});
  for (int k = 0; k < 1000; ++k) {
    world.step(1e-3);
    ASSERT_LT(std::abs(world.machine->reports()[0].rotation), 0.5 + 1e-6);
  }
  // It fell through 0.5 rad and rests there.
  EXPECT_NEAR(world.bodies.position[world.body].z, -std::sin(0.5), 1e-6);
  EXPECT_LT(norm(world.bodies.velocity[world.body]), 1e-6);
}

TEST(dem_joint, a_motor_keeps_its_speed) {
  Hinged world{{}, {0.02, 0.02, 0.02}, {.sub_step = 1e-4, .force_step = true}};
  Motor motor{.name = "motor", .drive = Drive::speed, .value = TimeFunction{2.0}};
  world.join({.joints = {world.axle()}, .motors = {motor}});
  for (int k = 0; k < 100; ++k) world.step(1e-3);
  EXPECT_NEAR(world.machine->reports()[0].rotation, 0.2, 1e-12);
}

}  // namespace
}  // namespace scree
