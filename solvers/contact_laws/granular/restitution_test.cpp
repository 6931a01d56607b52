#include "granular/restitution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree::granular {
namespace {

// The closed forms as their papers write them.
TEST(restitution, follows_from_the_damping_ratio) {
  for (const double zeta : {0.01, 0.1, 0.5, 0.9, 0.999}) {
    const double root = std::sqrt(1.0 - zeta * zeta);
    EXPECT_NEAR(restitution(zeta, EndOfContact::gap), std::exp(-std::numbers::pi * zeta / root), 1e-15);
    const double angle = std::atan2(2.0 * zeta * root, 2.0 * zeta * zeta - 1.0);
    EXPECT_NEAR(restitution(zeta, EndOfContact::no_tension), std::exp(-zeta / root * angle), 1e-14);
  }
  for (const double zeta : {1.001, 2.0, 10.0}) {  // Schwager and Poeschel, overdamped
    const double root = std::sqrt(zeta * zeta - 1.0);
    EXPECT_NEAR(restitution(zeta, EndOfContact::no_tension),
                std::exp(-zeta / root * std::log((zeta + root) / (zeta - root))), 1e-13);
  }
  EXPECT_NEAR(restitution(1.0, EndOfContact::no_tension), std::exp(-2.0), 1e-15);
  EXPECT_EQ(restitution(1.0, EndOfContact::gap), 0.0);
}

TEST(restitution, inverts_to_rounding) {
  for (const EndOfContact end : {EndOfContact::gap, EndOfContact::no_tension}) {
    for (const double e :
         {1.0, 1.0 - 1e-9, 0.999, 0.7, 0.5, 0.2, std::exp(-2.0), 0.1353352832, 0.1353352833, 0.1, 1e-3, 1e-9})
      EXPECT_NEAR(restitution(damping_ratio(e, end), end) / e, 1.0, 2e-14 * (1.0 - std::log(e))) << e;
  }
}

// From e = 1 to 0 damping only grows; without tension it takes more of it, since the tail does not pull back.
TEST(restitution, needs_more_damping_the_smaller_it_is) {
  double gap = -1.0, no_tension = -1.0;
  for (double e = 1.0; e > 1e-3; e *= 0.97) {
    EXPECT_GT(damping_ratio(e, EndOfContact::gap), gap);
    EXPECT_GT(damping_ratio(e, EndOfContact::no_tension), no_tension);
    gap = damping_ratio(e, EndOfContact::gap), no_tension = damping_ratio(e, EndOfContact::no_tension);
    if (e < 1.0) {
      EXPECT_GT(no_tension, gap);
    }
  }
}

}  // namespace
}  // namespace scree::granular
