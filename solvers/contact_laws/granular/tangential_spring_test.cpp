#include "granular/tangential_spring.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scree::granular {
namespace {

/// One contact with a stiffness of 100 N/m along the surface and a limit of 1 N.
struct One {
  One() {
    batch.count = 1;
    batch.normal.set(0, {0, 0, 1});
    batch.velocity.set(0, {});
    batch.lead = 0.0;
    lanes.approach[0] = 0.0, lanes.normal[0] = 2.0, lanes.load[0] = 2.0;
    lanes.tangent_stiffness[0] = 100.0, lanes.tangent_damping[0] = 0.0;
    friction[0] = 0.5;
  }
  Vec3 slip(const Vec3& by) {
    batch.velocity.set(0, by);
    batch.ahead[0] = 1.0;
    lanes.approach[0] = -dot(by, batch.normal[0]);
    add_tangential_spring(batch, lanes, friction);
    return batch.force[0];
  }
  ContactBatch batch{};
  ContactLanes lanes{};
  Lane friction{};
};

TEST(tangential_spring, pulls_back_with_its_stiffness_and_leaves_the_normal_force_alone) {
  One contact;
  EXPECT_LE(norm(contact.slip({3e-3, 4e-3, 0.1}) - Vec3{-0.3, -0.4, 2.0}), 1e-15);
  EXPECT_LE(norm(contact.slip({-3e-3, -4e-3, -0.1}) - Vec3{0, 0, 2.0}), 1e-15);
}

TEST(tangential_spring, slides_at_the_limit_in_the_direction_of_the_slip) {
  One contact;
  EXPECT_LE(norm(contact.slip({0.03, 0.04, 0}) - Vec3{-0.6, -0.8, 2.0}), 1e-15);
  for (int step = 0; step < 200; ++step) contact.slip({1e-3, 0, 0});
  EXPECT_LE(norm(contact.slip({1e-3, 0, 0}) - Vec3{-1.0, 0, 2.0}), 1e-3) << "the spring turns to where the slip goes";
}

// Law: spring and dashpot together stand at Coulomb's limit while it slides; when the slip stops, the spring is what was left.
TEST(tangential_spring, of_a_sliding_contact_is_what_the_dashpot_leaves_of_the_limit) {
  One contact;
  contact.lanes.tangent_damping[0] = 2.0;
  EXPECT_LE(norm(contact.slip({0.2, 0, 0}) - Vec3{-1.0, 0, 2.0}), 1e-15);
  EXPECT_LE(norm(contact.slip({0, 0, 0}) - Vec3{-0.6, 0, 2.0}), 1e-15);
}

TEST(tangential_spring, turns_with_the_normal_and_keeps_its_length) {
  One contact;
  contact.slip({6e-3, 1e-3, 0});
  const double before = std::hypot(0.6, 0.1);
  for (int step = 1; step <= 90; ++step) {  // about y, by 45 degrees
    const double angle = step * 0.5 * 3.14159265358979 / 180.0;
    contact.batch.normal.set(0, {std::sin(angle), 0, std::cos(angle)});
    const Vec3 force = contact.slip({}) - 2.0 * contact.batch.normal[0];
    EXPECT_NEAR(norm(force), before, 1e-14 * step);
    EXPECT_NEAR(dot(force, contact.batch.normal[0]), 0.0, 1e-14);
  }
  // It turned about y with the normal, but for the little that keeping the length of projections adds: (0.5 deg)^2 a step.
  const Vec3 now = contact.slip({}) - 2.0 * contact.batch.normal[0];
  EXPECT_LE(norm(now - Vec3{-0.6 * std::cos(0.25 * 3.14159265), -0.1, 0.6 * std::sin(0.25 * 3.14159265)}), 2e-3);
}

TEST(tangential_spring, half_a_step_ahead_is_the_trapezoidal_rule) {
  One contact;
  contact.batch.lead = 0.5;
  contact.friction[0] = 1e6;
  contact.batch.velocity.set(0, {1.0, 0, 0});
  contact.batch.ahead[0] = 0.0;
  add_tangential_spring(contact.batch, contact.lanes, contact.friction);
  contact.batch.velocity.set(0, {3.0, 0, 0});
  contact.batch.ahead[0] = 0.5;
  add_tangential_spring(contact.batch, contact.lanes, contact.friction);
  EXPECT_NEAR(contact.batch.force.x[0], -100.0 * 0.5 * (1.0 + 3.0), 1e-12);
}

}  // namespace
}  // namespace scree::granular
