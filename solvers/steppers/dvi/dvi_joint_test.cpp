// Joints in a step of dvi, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "jointed_world.hpp"

namespace scree::test {
namespace {

constexpr double kG = 9.81;
constexpr double kPi = std::numbers::pi;
constexpr Vec3 kPivot{0, 0, kHigh};

/// Period of a physical pendulum of length 1 m and a small bob, let go at `angle`, by its returns through the lowest point.
double pendulum_period(double angle, double h) {
  JointedWorld w;
  const BodyId bob = w.add_body(kPivot + Vec3{std::sin(angle), 0, -std::cos(angle)}, {1e-3, 1e-3, 1e-3});
  w.join({.joints = {w.joint_at("revolute", kWorld, bob, kPivot, {0, 1, 0})}});
  std::vector<double> crossings;
  while (crossings.size() < 5 && w.time < 20.0) {
    const double before = w.bodies.position[bob].x;
    w.step(h);
    const double after = w.bodies.position[bob].x;
    if (before * after <= 0.0) crossings.push_back(w.time - h * after / (after - before));
  }
  return (crossings[4] - crossings[0]) / 2.0;
}

// T / T0 = 1.0174087976 at 30 degrees and 1.1803405990 at 90 (elliptic integrals), of a bob with moment j:
// T0 = 2 pi sqrt((m l2 + j) / (m g l)).
TEST(dvi_joint, pendulum_has_the_period_of_the_elliptic_integral) {
  const double t0 = 2 * kPi * std::sqrt((1.0 + 1e-3) / kG);
  for (const auto& [angle, ratio] : {std::pair{kPi / 6, 1.0174087976}, std::pair{kPi / 2, 1.1803405990}}) {
    const double error = pendulum_period(angle, 1e-3) / t0 - ratio;
    // The leapfrog rule shortens the period of a linear oscillation by (h w)^2 / 24; wide swings a few times that.
    const double hw = 1e-3 * 2 * kPi / t0;
    EXPECT_LT(std::abs(error), hw * hw / 4);
    const std::array<double, 2> errors{pendulum_period(angle, 8e-3) / t0 - ratio,
                                       pendulum_period(angle, 4e-3) / t0 - ratio};
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.2) << errors[0] << " " << errors[1];
  }
}

// Drift below 1e-6 of the link over 1e5 steps asked: settle() leaves 1e-10 m/s times the step.
TEST(dvi_joint, links_do_not_drift_in_a_hundred_thousand_steps) {
  JointedWorld w;
  const BodyId upper = w.add_body(kPivot + Vec3{0.5, 0, 0}, {0.01, 0.08, 0.08});
  const BodyId lower = w.add_body(kPivot + Vec3{1.5, 0, 0}, {0.01, 0.08, 0.08});
  w.join({.joints = {w.joint_at("revolute", kWorld, upper, kPivot, {0, 1, 0}),
                     w.joint_at("revolute", upper, lower, kPivot + Vec3{1, 0, 0}, {0, 1, 0})}});
  double worst = 0.0;
  for (int k = 0; k < 100000; ++k) {
    w.step(1e-3);
    worst = std::max({worst, w.report(0).position_error, w.report(1).position_error});
  }
  EXPECT_LT(worst, 1e-11);
  const Vec3 elbow = w.bodies.position[upper] + rotate(w.bodies.orientation[upper], {0.5, 0, 0});
  EXPECT_NEAR(norm(elbow - kPivot), 1.0, 1e-11);
}

/// Greatest change of the energy of a double pendulum let go level, over 10 s, by the energy scale; positions taken in the
/// middle of the step, to which the velocity belongs.
double energy_error(double h) {
  JointedWorld w;
  const std::array<BodyId, 2> link{w.add_body(kPivot + Vec3{0.5, 0, 0}, {0.01, 0.08, 0.08}),
                                   w.add_body(kPivot + Vec3{1.5, 0, 0}, {0.01, 0.08, 0.08})};
  w.join({.joints = {w.joint_at("revolute", kWorld, link[0], kPivot, {0, 1, 0}),
                     w.joint_at("revolute", link[0], link[1], kPivot + Vec3{1, 0, 0}, {0, 1, 0})}});
  double worst = 0.0;
  while (w.time < 10.0) {
    std::array<double, 2> z{};
    for (int k = 0; k < 2; ++k) z[k] = w.bodies.position[link[k]].z;
    w.step(h);
    double energy = 0.0;
    for (int k = 0; k < 2; ++k) {
      const BodyId i = link[k];
      energy += 0.5 * squared_norm(w.bodies.velocity[i]) + kG * (0.5 * (z[k] + w.bodies.position[i].z) - kHigh);
      energy += 0.5 * dot(w.bodies.angular_velocity[i], hadamard({0.01, 0.08, 0.08}, w.bodies.angular_velocity[i]));
    }
    worst = std::max(worst, std::abs(energy));
  }
  return worst / (2 * kG);
}

TEST(dvi_joint, double_pendulum_keeps_its_energy_to_second_order) {
  const double coarse = energy_error(2e-3), fine = energy_error(1e-3);
  // h^2 w^2 with w up to 12 rad/s in its fastest flips.
  EXPECT_LT(fine, 1.5e-4);
  EXPECT_GT(coarse / fine, 3.0);
}

// A top with a level axis, held at one end, precesses at m g l / (I w) when it starts in that motion.
TEST(dvi_joint, gyroscope_precesses_at_the_closed_form_rate) {
  const double l = 0.1, spin = 200.0, inertia = 2e-3;
  const double rate = 1.0 * kG * l / (inertia * spin);
  std::array<double, 2> error{};
  for (std::size_t k = 0; k < 2; ++k) {
    JointedWorld w{DviOptions{.gyroscopic = true}};
    const double h = k == 0 ? 1e-3 : 0.5e-3;
    const BodyId top = w.add_body(kPivot + Vec3{l, 0, 0}, {inertia, 1.2e-3, 1.2e-3});
    w.bodies.angular_velocity[top] = {spin, 0, rate};
    w.bodies.velocity[top] = {0, rate * l, 0};
    w.join({.joints = {w.joint_at("spherical", kWorld, top, kPivot)}});
    double angle = 0.0, sag = 0.0;
    while (w.time < 2.0 - 1e-9) {
      w.step(h);
      const Vec3 axis = w.bodies.position[top] - kPivot;
      angle = nearest_turn(std::atan2(axis.y, axis.x), angle);
      sag = std::max(sag, std::abs(axis.z));
    }
    error[k] = std::abs(angle - rate * 2.0);
    EXPECT_LT(error[k], 0.01 * rate * 2.0) << h;
    EXPECT_LT(sag, 0.02 * l) << h;
  }
  EXPECT_LT(error[1], 0.6 * error[0]);
}

/// Four-bar linkage in the x y plane: pivots at 0 and (d, 0), crank a, coupler b, rocker c. The rocker's pin for the crank's
/// angle: where the circles of coupler and rocker meet, above.
Vec3 rocker_pin(double a, double b, double c, double d, double angle) {
  const Vec3 crank{a * std::cos(angle), a * std::sin(angle), 0}, pivot{d, 0, 0};
  const Vec3 apart = pivot - crank;
  const double distance = norm(apart), along = (b * b - c * c + distance * distance) / (2 * distance);
  const double up = std::sqrt(b * b - along * along);
  const Vec3 x = apart / distance;
  return crank + along * x + up * Vec3{-x.y, x.x, 0};
}

TEST(dvi_joint, four_bar_linkage_follows_the_circles_of_its_links) {
  const double a = 0.1, b = 0.3, c = 0.2, d = 0.3, start = 0.7, speed = 8.0;
  JointedWorld w;
  const Vec3 pin{a * std::cos(start), a * std::sin(start), 0}, far = rocker_pin(a, b, c, d, start), end{d, 0, 0};
  const auto link = [&](const Vec3& from, const Vec3& to) {
    return w.add_body(kPivot + 0.5 * (from + to), {0.01, 0.01, 0.01});
  };
  const BodyId crank = link({}, pin), coupler = link(pin, far), rocker = link(far, end);
  const Vec3 pin_on_rocker = far - 0.5 * (far + end);
  w.join(
      {.joints = {w.joint_at("revolute", kWorld, crank, kPivot), w.joint_at("revolute", crank, coupler, kPivot + pin),
                  w.joint_at("revolute", coupler, rocker, kPivot + far),
                  w.joint_at("revolute", rocker, kWorld, kPivot + end)},
       .motors = {motor(0, Coordinate::rotation, Drive::speed, speed)}});
  for (int k = 0; k < 2000; ++k) {
    w.step(1e-3);
    const Vec3 now = w.bodies.position[rocker] + rotate(w.bodies.orientation[rocker], pin_on_rocker) - kPivot;
    ASSERT_LT(norm(now - rocker_pin(a, b, c, d, start + speed * w.time)), 1e-10) << w.time;
  }
}

// Shafts at an angle b, joined by a universal joint. With the first arm at the angle a from square to the plane of the
// shafts, (0, -sin a, cos a), and the second at c in that plane, their product vanishes for tan c = cos b tan a, so that
// w2 / w1 = cos b / (1 - sin^2 b sin^2 a).
TEST(dvi_joint, universal_joint_transmits_by_its_law) {
  const double b = kPi / 6;
  JointedWorld w;
  w.host.gravity = {};
  const Vec3 second{std::cos(b), std::sin(b), 0};
  const BodyId one = w.add_body(kPivot - Vec3{0.2, 0, 0}, {0.01, 0.02, 0.02});
  const BodyId two = w.add_body(kPivot + 0.2 * second, {0.01, 0.02, 0.02}, 1.0, from_rotation_vector({0, 0, b}));
  Joint cross = w.joint_at("universal", one, two, kPivot);
  // Arms: of the first shaft along z, of the second in the plane, square to its shaft.
  cross.a.frame.orientation = conjugate(w.bodies.orientation[one]) * rotation_between({1, 0, 0}, {0, 0, 1});
  cross.b.frame.orientation =
      conjugate(w.bodies.orientation[two]) * rotation_between({0, 1, 0}, {-std::sin(b), std::cos(b), 0});
  w.join({.joints = {w.joint_at("revolute", kWorld, one, kPivot - Vec3{0.2, 0, 0}, {1, 0, 0}),
                     w.joint_at("cylindrical", kWorld, two, kPivot + 0.2 * second, second), cross},
          .motors = {motor(0, Coordinate::rotation, Drive::speed, 3.0)}});
  for (int k = 0; k < 2000; ++k) {
    w.step(1e-3);
    // The rate over the step belongs to the angle in its middle.
    const double a = w.report(0).rotation - 0.5e-3 * 3.0;
    const double law = std::cos(b) / (1 - std::pow(std::sin(b) * std::sin(a), 2));
    ASSERT_NEAR(w.report(1).rotation_rate / 3.0, law, 1e-5) << a;
  }
}

// At rest a hinge carries the weight, and its moment about the hinge.
TEST(dvi_joint, reactions_are_those_of_statics) {
  JointedWorld w;
  const BodyId beam = w.add_body(kPivot + Vec3{0.4, 0, 0}, {0.01, 0.1, 0.1}, 2.0);
  w.join({.joints = {w.joint_at("fixed", kWorld, beam, kPivot)}});
  w.run(10, 1e-3);
  // Positions near 100 m round by 1e-14 m; what that is in a step as velocity, as momentum over the step.
  const double rounding = 2.0 * 1e-13 / 1e-6;
  EXPECT_NEAR(w.report(0).force.z, 2.0 * kG, rounding);
  EXPECT_NEAR(w.report(0).torque.y, -0.4 * 2.0 * kG, rounding);
  EXPECT_NEAR(norm(w.bodies.velocity[beam]), 0.0, 1e-10);
}

TEST(dvi_joint, breaks_above_its_load_only) {
  for (const double strength : {0.99, 1.01}) {
    JointedWorld w;
    const BodyId bob = w.add_body(kPivot - Vec3{0, 0, 1}, {0.01, 0.01, 0.01}, 2.0);
    Joint joint = w.joint_at("spherical", kWorld, bob, kPivot);
    joint.breaking_force = strength * 2.0 * kG;
    w.join({.joints = {joint}});
    w.step(1e-3);
    EXPECT_EQ(w.machine->news().size(), strength < 1.0 ? 1u : 0u);
    w.run(99, 1e-3);
    EXPECT_NEAR(w.bodies.velocity[bob].z, strength < 1.0 ? -kG * 0.099 : 0.0, 1e-9);
    // Told of once; what is gone carries nothing and does no work.
    EXPECT_TRUE(w.machine->news().empty());
    EXPECT_EQ(w.report(0).gone, strength < 1.0);
    EXPECT_EQ(norm(w.report(0).force) > 0.0, strength > 1.0);
    const double work = w.step(1e-3).work.joint_work;
    EXPECT_EQ(work == 0.0, strength < 1.0) << work;
  }
}

TEST(dvi_joint, spring_breaks_above_its_load_too) {
  JointedWorld w;
  const BodyId bob = w.add_body(kPivot - Vec3{0, 0, 1}, {0.01, 0.01, 0.01}, 2.0);
  Joint spring = w.joint_at("spring_damper", kWorld, bob, kPivot);
  spring.b.frame.position = {};
  spring.law[1] = {.spring = {100.0, 0.0}, .rest = 1.0};
  spring.breaking_force = 1.5 * 2.0 * kG;  // twice the weight at the lowest point
  w.join({.joints = {spring}});
  w.run(400, 1e-3);
  EXPECT_TRUE(w.report(0).gone);
}

}  // namespace
}  // namespace scree::test
