#include "granular/jkr_neck.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree::granular {
namespace {

constexpr double kAdhesion = 0.05, kModulus = 5e6, kRadius = 1e-3;
const double kUnit = std::cbrt(std::numbers::pi * kAdhesion * kRadius * kRadius / (8.0 * kModulus));

// Law: from the radius of a neck to its overlap and back, from just above the break to contacts a million times as wide.
TEST(jkr_neck, has_the_radius_that_belongs_to_its_overlap) {
  ContactBatch batch{};
  ContactLanes lanes{};
  Lane adhesion{}, modulus{};
  std::vector<double> sizes;
  for (double s = 1.0 + 1e-6; s < 1e3; s = 1.0 + 1.2 * (s - 1.0)) sizes.push_back(s);
  for (std::size_t first = 0; first < sizes.size(); first += ContactBatch::kMost) {
    batch.count = std::min(sizes.size() - first, ContactBatch::kMost);
    for (std::size_t k = 0; k < batch.count; ++k) {
      const double s = sizes[first + k];
      batch.overlap[k] = kUnit * kUnit / kRadius * (s * s * s * s - 4.0 * s);
      batch.radius[k] = kRadius, adhesion[k] = kAdhesion, modulus[k] = kModulus;
      batch.history[5][k] = 1.0;
    }
    find_necks(batch, adhesion, modulus, 5, lanes);
    for (std::size_t k = 0; k < batch.count; ++k) {
      const double s = sizes[first + k];
      // Next to the break the overlap hardly depends on the radius: its rounding, 3 eps, over 6 (s - 1).
      EXPECT_NEAR(lanes.contact_radius[k] / (kUnit * s * s), 1.0, 1e-14 + 1e-15 / (s - 1.0)) << s;
      EXPECT_EQ(batch.history[5][k], 1.0);
    }
  }
}

TEST(jkr_neck, spans_a_gap_only_where_it_was) {
  ContactBatch batch{};
  ContactLanes lanes{};
  Lane adhesion{}, modulus{};
  batch.count = 4;
  const double reach = neck_reach(kAdhesion, kModulus, kRadius);
  EXPECT_NEAR(reach, 3.0 * kUnit * kUnit / kRadius, 1e-15 * kRadius);
  const double overlap[] = {0.0, -0.9 * reach, -0.9 * reach, -1.1 * reach};
  const double before[] = {0.0, 1.0, 0.0, 1.0};
  for (std::size_t k = 0; k < 4; ++k) {
    batch.overlap[k] = overlap[k], batch.radius[k] = kRadius, adhesion[k] = kAdhesion, modulus[k] = kModulus;
    batch.history[0][k] = before[k];
  }
  find_necks(batch, adhesion, modulus, 0, lanes);
  EXPECT_EQ(batch.history[0][0], 1.0);
  EXPECT_EQ(batch.history[0][1], 1.0);
  for (std::size_t k = 2; k < 4; ++k) {
    EXPECT_EQ(batch.history[0][k], 0.0);
    EXPECT_EQ(lanes.normal[k], 0.0);
    EXPECT_EQ(lanes.contact_radius[k], 0.0);
  }
}

}  // namespace
}  // namespace scree::granular
