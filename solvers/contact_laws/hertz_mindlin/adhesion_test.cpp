// Adhesive elastic spheres: JKR and DMT.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hertz_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::HertzWorld;

constexpr double kPi = std::numbers::pi, kRadius = 1e-3, kYoung = 1e7, kPoisson = 0.3, kAdhesion = 0.1, kMu = 0.4;
const double kModulus = kYoung / (1.0 - kPoisson * kPoisson);
const double kBreak =
    std::cbrt(kPi * kAdhesion * kRadius * kRadius / (8.0 * kModulus));  // radius of the breaking neck [m]
const double kPullOff = 1.5 * kPi * kAdhesion * kRadius;

Material sticky(double adhesion = kAdhesion) {
  return test::elastic("rubber", kYoung, kPoisson, 1000,
                       {.friction = kMu, .restitution = 1.0, .surface_energy = adhesion});
}

/// A contact that is drawn apart, slipping fast along x.
struct Drawn {
  explicit Drawn(const HertzWorld& world) : law{*world.law} {
    batch.count = 1;
    batch.radius[0] = kRadius, batch.mass[0] = 1e-30;
    batch.normal.set(0, {0, 0, 1});
    batch.spin.set(0, {});
    batch.materials[0] = 2;
    batch.velocity.set(0, {1.0, 0, 0});
    batch.ahead[0] = batch.lead = 0.5;
  }
  Vec3 to(double overlap) {
    batch.overlap[0] = overlap;
    law.forces(batch);
    return batch.force[0];
  }
  const ContactLaw& law;
  ContactBatch batch{};
};

// Johnson, Kendall and Roberts' equations as they stand in the paper, from the radius of the neck to overlap and force.
TEST(jkr, force_is_that_of_the_neck_with_the_same_overlap) {
  const HertzWorld world{"cohesion = \"jkr\"", sticky()};
  Drawn contact{world};
  contact.to(0.0);
  for (double a = 20.0 * kBreak; a > 1.001 * kBreak; a *= 0.98) {
    const double overlap = a * a / kRadius - std::sqrt(2.0 * kPi * kAdhesion * a / kModulus);
    const double force =
        4.0 * kModulus * a * a * a / (3.0 * kRadius) - std::sqrt(8.0 * kPi * kAdhesion * kModulus * a * a * a);
    EXPECT_NEAR(contact.to(overlap).z, force, 1e-10 * (kPullOff + std::abs(force))) << a / kBreak;
  }
}

TEST(jkr, jumps_into_contact_pulls_off_and_breaks_where_the_theory_says) {
  const HertzWorld world{"cohesion = \"jkr\"", sticky()};
  Drawn contact{world};
  const double reach = 3.0 * kBreak * kBreak / kRadius;
  EXPECT_EQ(contact.to(-0.5 * reach), Vec3{}) << "surfaces that have not touched do not attract";
  EXPECT_NEAR(contact.to(0.0).z, -4.0 / 3.0 * kPi * kAdhesion * kRadius, 1e-12);
  double least = 0.0;
  for (double gap = 0.0; gap < 0.9999 * reach; gap += 1e-4 * reach) least = std::min(least, contact.to(-gap).z);
  EXPECT_NEAR(least, -kPullOff, 1e-6 * kPullOff);
  EXPECT_NEAR(contact.to(-reach * (1.0 - 1e-12)).z, -5.0 / 9.0 * kPullOff, 1e-5 * kPullOff);
  EXPECT_EQ(contact.to(-1.0001 * reach), Vec3{});
  EXPECT_EQ(contact.to(-0.5 * reach), Vec3{}) << "a broken neck does not come back";
  // That of the softest pair, rubber on rubber with half of the modulus, to the power -2/3.
  EXPECT_NEAR(world.law->reach(kRadius), std::cbrt(4.0) * reach, 1e-12 * reach);
}

TEST(jkr, friction_is_limited_by_the_force_and_twice_the_pull_off_force) {
  const HertzWorld world{"cohesion = \"jkr\"", sticky()};
  Drawn contact{world};
  for (const double overlap : {0.0, 1e-6, -1e-7}) {
    const Vec3 force = contact.to(overlap);
    EXPECT_NEAR(force.x, -kMu * (force.z + 2.0 * kPullOff), 1e-9 * kPullOff) << overlap;
  }
}

TEST(jkr, without_surface_energy_is_hertz) {
  const HertzWorld world{"cohesion = \"jkr\"", sticky(0.0)},
      hertz{"", test::elastic("rubber", kYoung, kPoisson, 1000, {.friction = kMu})};
  Drawn contact{world}, plain{hertz};
  for (const double overlap : {0.0, 1e-8, 1e-5}) EXPECT_LE(norm(contact.to(overlap) - plain.to(overlap)), 1e-15);
  EXPECT_EQ(contact.to(-1e-9), Vec3{});
}

// Law: an elastic impact loses what the neck takes, W = 7.09 (w^5 R^4 / E^2)^(1/3) (Thornton and Ning, Powder Technology 99
// (1998) 154); exactly (24/5 4^(1/3) + 4/5) (pi / 2) (pi / 8)^(2/3), the integral of the force over the gap up to the break.
TEST(jkr, an_elastic_impact_loses_the_work_of_the_neck) {
  const HertzWorld world{"cohesion = \"jkr\"", sticky()};
  const double work = (4.8 * std::cbrt(4.0) + 0.8) * 0.5 * kPi * std::pow(kPi / 8.0, 2.0 / 3.0) *
                      std::cbrt(std::pow(kAdhesion, 5) * std::pow(kRadius, 4) / (kModulus * kModulus));
  EXPECT_NEAR(work / std::cbrt(std::pow(kAdhesion, 5) * std::pow(kRadius, 4) / (kModulus * kModulus)), 7.09, 0.01);
  const double m = world.mass(kRadius), sticks = std::sqrt(2.0 * work / m);
  for (const double speed : {1.05 * sticks, 2.0 * sticks}) {
    ContactDrive drive = world.on_wall(world.touching(kRadius, {0, 0, -speed}));
    ASSERT_TRUE(drive.run(2e-8)) << "above the speed of sticking";
    EXPECT_NEAR(drive.ball.velocity.z / sticks, std::sqrt(speed * speed / (sticks * sticks) - 1.0), 2e-3);
  }
  ContactDrive stays = world.on_wall(world.touching(kRadius, {0, 0, -0.95 * sticks}));
  EXPECT_FALSE(stays.run(1e-7, 200000)) << "below the speed of sticking";
}

TEST(dmt, pulls_off_with_two_pi_w_r_and_does_not_reach_beyond_the_surfaces) {
  const HertzWorld world{"cohesion = \"dmt\"", sticky()};
  Drawn contact{world};
  const double attraction = 2.0 * kPi * kAdhesion * kRadius, x = 1e-6;
  const double hertz = 4.0 / 3.0 * kModulus * std::sqrt(kRadius) * std::pow(x, 1.5);
  EXPECT_NEAR(contact.to(x).z, hertz - attraction, 1e-12 * attraction);
  EXPECT_NEAR(contact.to(x).x, -kMu * hertz, 1e-9 * hertz);
  EXPECT_NEAR(contact.to(1e-16).z, -attraction, 1e-9 * attraction);
  EXPECT_EQ(contact.to(-1e-9), Vec3{});
  EXPECT_EQ(world.law->reach(kRadius), 0.0);
}

}  // namespace
}  // namespace scree
