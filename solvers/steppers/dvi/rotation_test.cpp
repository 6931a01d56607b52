// Rotations of dvi: the exponential map over very many steps, and the free rigid body.
#include "rotation.hpp"

#include <gtest/gtest.h>

#include "dvi_world.hpp"

namespace scree::test {
namespace {

TEST(exponential_map, keeps_unit_length_to_rounding_over_a_million_steps) {
  Quat q;
  for (int k = 0; k < 1000000; ++k) q = dvi::turned(q, {1e-3, 2e-3 * (k % 3), -1e-3});
  EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 4e-16);
}

// A constant velocity about one axis: the angle is the sum, to the roundings of a thousand products.
TEST(exponential_map, adds_up_rotations_about_one_axis) {
  Quat q;
  const Vec3 axis = normalized(Vec3{1, -2, 3});
  for (int k = 0; k < 1000; ++k) q = dvi::turned(q, 2e-3 * axis);
  const Quat whole = from_rotation_vector(2.0 * axis);
  EXPECT_NEAR(q.w, whole.w, 1e-13);
  EXPECT_NEAR(q.x, whole.x, 1e-13);
  EXPECT_NEAR(q.z, whole.z, 1e-13);
}

// Euler's equation is met by the implicit midpoint, so energy and |I W| stay.
TEST(gyroscopic_change, keeps_energy_and_momentum) {
  const Vec3 j{1, 2, 3};
  Vec3 w{3, -20, 5};
  const double energy = dot(w, hadamard(j, w)), momentum = norm(hadamard(j, w));
  for (int k = 0; k < 10000; ++k) w += dvi::gyroscopic_change(j, w, 1e-3);
  // Each of ten thousand steps is solved to rounding.
  EXPECT_NEAR(dot(w, hadamard(j, w)), energy, 1e-11 * energy);
  EXPECT_NEAR(norm(hadamard(j, w)), momentum, 1e-11 * momentum);
}

void add_tumbler(World& w, const Vec3& spin) {
  w.host.gravity = {};
  w.bodies.add(1, Motion::dynamic, {0, 0, 10}, 0.05, 1.0, {1, 2, 3}, {});
  w.bodies.angular_velocity[1] = spin;
}

// I = (1, 2, 3), w0 = (0.01, 1, 0.01): half the period, 19.5528670987 s, from flip to flip of the middle component.
TEST(dvi_gyroscopic, free_body_flips_in_the_period_of_the_elliptic_integral) {
  World w{DviOptions{.gyroscopic = true}};
  add_tumbler(w, {0.01, 1, 0.01});
  std::vector<double> crossings;
  double before = 1.0;
  while (crossings.size() < 3) {
    w.step(1e-3);
    const double middle = rotate_back(w.bodies.orientation[1], w.bodies.angular_velocity[1]).y;
    if (before * middle < 0) crossings.push_back(w.time - 1e-3 * middle / (middle - before));
    before = middle;
  }
  EXPECT_NEAR(crossings[1] - crossings[0], 19.5528670987, 1e-3);
  EXPECT_NEAR(crossings[2] - crossings[0], 39.1057341973, 1e-3);
}

TEST(dvi_gyroscopic, free_body_keeps_energy_and_angular_momentum_in_the_world) {
  World w{DviOptions{.gyroscopic = true}};
  add_tumbler(w, {4, 30, -7});
  const Vec3 j{1, 2, 3};
  const auto momentum = [&] {
    const Quat q = w.bodies.orientation[1];
    return rotate(q, hadamard(j, rotate_back(q, w.bodies.angular_velocity[1])));
  };
  const auto energy = [&] { return 0.5 * dot(w.bodies.angular_velocity[1], momentum()); };
  const Vec3 l0 = momentum();
  const double e0 = energy();
  w.run(5000, 1e-3);
  EXPECT_NEAR(norm(momentum() - l0), 0.0, 1e-10 * norm(l0));
  EXPECT_NEAR(energy(), e0, 1e-10 * e0);
}

TEST(dvi_gyroscopic, is_off_by_default) {
  World w;
  add_tumbler(w, {0.5, 1, 0.2});
  w.run(100, 1e-3);
  EXPECT_EQ(w.bodies.angular_velocity[1], (Vec3{0.5, 1, 0.2}));
}

}  // namespace
}  // namespace scree::test
