// The tangential force of a contact that is led along a path: no bodies, only displacements.
#include <gtest/gtest.h>

#include <cmath>

#include "hertz_world.hpp"

namespace scree {
namespace {

using test::HertzWorld;

constexpr double kYoung = 1e9, kPoisson = 0.3, kRadius = 5e-3;
// Against a rigid wall: G = E / (2 (2 - nu)(1 + nu)).
const double kShear = kYoung / (2.0 * (2.0 - kPoisson) * (1.0 + kPoisson));

/// A contact whose overlap and slip are told; velocities are what leads there within a step of 1 s.
struct Led {
  explicit Led(const ContactLaw& contact_law) : law{contact_law} {
    batch.count = 1;
    batch.radius[0] = kRadius, batch.mass[0] = 1e-30;  // without dashpots
    batch.normal.set(0, {0, 0, 1});
    batch.spin.set(0, {});
    batch.materials[0] = 2;
  }
  /// Moves on by slip [m] along x to an overlap [m]; returns the force along x [N].
  double to(double overlap, double slip) {
    batch.overlap[0] = overlap;
    batch.velocity.set(0, {slip, 0, 0});
    batch.ahead[0] = 1.0, batch.lead = 0.0;
    law.forces(batch);
    return batch.force.x[0];
  }
  const ContactLaw& law;
  ContactBatch batch{};
};

Material plastic(double mu) {
  return test::elastic("plastic", kYoung, kPoisson, 1200, {.friction = mu, .restitution = 1.0});
}

TEST(mindlin, stiffness_is_eight_shear_moduli_times_the_radius_of_contact) {
  HertzWorld world{"", plastic(10.0)};
  for (const double overlap : {1e-7, 1e-6, 1e-5}) {
    Led contact{*world.law};
    const double slip = 0.01 * overlap, expected = -8.0 * kShear * std::sqrt(kRadius * overlap) * slip;
    EXPECT_NEAR(contact.to(overlap, slip), expected, 1e-12 * std::abs(expected));
  }
}

TEST(mindlin, force_stays_at_the_coulomb_limit_and_comes_back_at_once) {
  HertzWorld world{"", plastic(0.2)};
  Led contact{*world.law};
  const double x = 1e-6,
               normal = 4.0 / 3.0 * kYoung / (1.0 - kPoisson * kPoisson) * std::sqrt(kRadius) * std::pow(x, 1.5);
  EXPECT_NEAR(contact.to(x, 1e-6), -0.2 * normal, 1e-12 * normal);
  EXPECT_NEAR(contact.to(x, 1e-6), -0.2 * normal, 1e-12 * normal);
  const double back = 8.0 * kShear * std::sqrt(kRadius * x) * 1e-8;
  EXPECT_NEAR(contact.to(x, -1e-8), -0.2 * normal + back, 1e-12 * normal);
}

TEST(mindlin, force_shrinks_with_the_circle_of_contact_but_does_not_grow_with_it) {
  HertzWorld world{"", plastic(10.0)};
  Led contact{*world.law};
  const double force = contact.to(1e-6, 1e-8);
  EXPECT_NEAR(contact.to(4e-6, 0.0), force, 1e-12 * std::abs(force));
  EXPECT_NEAR(contact.to(1e-6, 0.0), 0.5 * force, 1e-12 * std::abs(force));
  EXPECT_NEAR(contact.to(0.25e-6, 0.0), 0.25 * force, 1e-12 * std::abs(force));
}

// Law (Elata and Berryman): no cycle of loads gives energy. Sheared under a large load, drawn back under a small one, then the
// other way round.
TEST(mindlin, cycles_of_load_and_shear_give_no_energy) {
  HertzWorld world{"", plastic(10.0)};
  for (const bool sheared_under_load : {true, false}) {
    Led contact{*world.law};
    const double high = 4e-6, low = 1e-6;
    double work = 0.0, before = 0.0;  // on the contact
    const auto shear = [&](double overlap, double slip) {
      for (int step = 0; step < 100; ++step) {
        const double after = -contact.to(overlap, slip / 100.0);
        work += 0.5 * (before + after) * slip / 100.0;
        before = after;
      }
    };
    for (int cycle = 0; cycle < 3; ++cycle) {
      before = -contact.to(sheared_under_load ? high : low, 0.0);
      shear(sheared_under_load ? high : low, 1e-8);
      before = -contact.to(sheared_under_load ? low : high, 0.0);
      shear(sheared_under_load ? low : high, -1e-8);
      EXPECT_GE(work, -1e-20) << cycle;
    }
  }
}

TEST(mindlin, asked_again_without_a_step_the_force_is_the_same) {
  HertzWorld world{"", plastic(0.5)};
  Led contact{*world.law};
  contact.batch.overlap[0] = 1e-6;
  contact.batch.velocity.set(0, {1e-3, 2e-3, 0});
  contact.batch.ahead[0] = contact.batch.lead = 5e-7;
  world.law->forces(contact.batch);
  const Vec3 once = contact.batch.force[0];
  contact.batch.ahead[0] = -5e-7;
  world.law->forces(contact.batch);
  EXPECT_LE(norm(contact.batch.force[0] - once), 1e-15 * norm(once));
}

}  // namespace
}  // namespace scree
