#include "scree/model/material.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace scree {
namespace {

Materials two_materials() {
  Materials materials;
  materials.add({"steel", 7800.0, {.friction = 0.2, .restitution = 0.8, .compliance = 1e-6}, {}});
  materials.add({"rubber", 1100.0, {.friction = 0.8, .restitution = 0.2, .compliance = 3e-6}, {}});
  return materials;
}

TEST(Materials, unlisted_pairs_follow_the_rule) {
  Materials m = two_materials();
  EXPECT_DOUBLE_EQ(m.pair(0, 1).friction, 0.2);
  m.set_rule(PairRule::maximum);
  EXPECT_DOUBLE_EQ(m.pair(0, 1).friction, 0.8);
  m.set_rule(PairRule::mean);
  EXPECT_DOUBLE_EQ(m.pair(0, 1).friction, 0.5);
  m.set_rule(PairRule::geometric_mean);
  EXPECT_DOUBLE_EQ(m.pair(1, 0).friction, 0.4);
}

// Springs in series: compliances add, whatever the rule.
TEST(Materials, compliances_add) { EXPECT_DOUBLE_EQ(two_materials().pair(0, 1).compliance, 4e-6); }

TEST(Materials, listed_pairs_win_in_both_orders) {
  Materials m = two_materials();
  m.set_pair(1, 0, {.friction = 0.33});
  m.add({"glass", 2500.0, {}, {}});
  EXPECT_DOUBLE_EQ(m.pair(0, 1).friction, 0.33);
  EXPECT_DOUBLE_EQ(m.pair(1, 0).friction, 0.33);
  EXPECT_TRUE(m.is_listed(0, 1));
  EXPECT_FALSE(m.is_listed(0, 2));
}

TEST(Materials, refuses_a_name_twice) {
  Materials m = two_materials();
  EXPECT_THROW(m.add({"steel", 1.0, {}, {}}), std::logic_error);
}

}  // namespace
}  // namespace scree
