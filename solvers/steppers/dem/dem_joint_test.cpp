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
  // In each kick gravity gives to the hub what the bearing takes in the drift: m (g h)^2 / 2, of 5000 sub-steps 0.4 %.
  EXPECT_NEAR(work.joint_work, kinetic, 5e-3 * kinetic);
  EXPECT_NEAR(work.joint_work + work.force_work, kinetic, 1e-6 * kinetic);
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
