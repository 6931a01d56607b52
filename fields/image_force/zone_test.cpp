#include "zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scree/config/validate.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
const Roll kRoll{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, 0.16, 0.15};

Zone zone_from(const std::string& members) {
  const std::vector<Parameter> parameters{Parameter::variant("zone", Zone::variants(), "a zone")};
  Zone zone{options_from_text("zone = {" + members + "}", parameters).table("zone")};
  zone.attach(kRoll);
  return zone;
}

bool holds(const Zone& zone, const Vec3& point, const Roll& roll = kRoll) {
  return zone.contains(point, to_roll(roll, point));
}

Vec3 at(double degrees, double radius = 0.16, double along = 0.0) {
  const double angle = degrees * kPi / 180.0;
  return kRoll.centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), along};
}

/// Every degree but the ends themselves, where rounding decides.
void expect_exactly(const Zone& zone, double from, double to) {
  for (int degree = 0; degree < 360; ++degree) {
    double beyond = std::fmod(degree - from + 720.0, 360.0);
    if (beyond == 0.0 || beyond == std::fmod(to - from, 360.0)) continue;
    EXPECT_EQ(holds(zone, at(degree)), beyond < to - from) << degree << " in " << from << ".." << to;
  }
}

TEST(zone, sector_holds_the_angles_from_its_first_to_its_last_counter_clockwise) {
  expect_exactly(zone_from("type = 'sector', from = '60 deg', to = '100 deg'"), 60, 100);
  expect_exactly(zone_from("type = 'sector', from = '-30 deg', to = '30 deg'"), -30, 30);
  expect_exactly(zone_from("type = 'sector', from = '10 deg', to = '190 deg'"), 10, 190);
  expect_exactly(zone_from("type = 'sector', from = '90 deg', to = '350 deg'"), 90, 350);
  expect_exactly(zone_from("type = 'sector', from = '0 deg', to = '360 deg'"), 0, 360);
}

TEST(zone, sector_ends_at_its_radii_and_width) {
  const Zone zone = zone_from(
      "type = 'sector', from = '0 deg', to = '90 deg', inner_radius = 0.15, outer_radius = 0.17, half_width = 0.1");
  EXPECT_TRUE(holds(zone, at(45, 0.16, 0.09)));
  EXPECT_FALSE(holds(zone, at(45, 0.14)));
  EXPECT_FALSE(holds(zone, at(45, 0.18)));
  EXPECT_FALSE(holds(zone, at(45, 0.16, 0.11)));
  EXPECT_FALSE(holds(zone, at(45, 0.16, -0.11)));
}

TEST(zone, sector_about_a_roll_along_y_counts_from_x_too) {
  Roll roll = kRoll;
  roll.centre = {};
  roll.axis = {0.0, 1.0, 0.0};
  Zone zone = zone_from("type = 'sector', from = '80 deg', to = '100 deg'");
  zone.attach(roll);
  // y x x = -z: a quarter turn counter-clockwise about y from +x.
  EXPECT_TRUE(holds(zone, {0.0, 0.5, -0.16}, roll));
  EXPECT_FALSE(holds(zone, {0.0, 0.5, 0.16}, roll));
  EXPECT_FALSE(holds(zone, {0.16, 0.5, 0.0}, roll));
}

TEST(zone, box_holds_what_lies_between_its_corners) {
  const Zone zone = zone_from("type = 'box', lower = [0.0, 0.0, 0.0], upper = ['1 m', 0.5, 0.25]");
  EXPECT_TRUE(holds(zone, {0.0, 0.5, 0.1}));
  EXPECT_FALSE(holds(zone, {0.5, 0.51, 0.1}));
  EXPECT_FALSE(holds(zone, {-0.01, 0.2, 0.1}));
}

TEST(zone, empty_zones_are_refused) {
  EXPECT_THROW(zone_from("type = 'box', lower = [0.0, 0.0, 0.0], upper = [1.0, -1.0, 1.0]"), Error);
  EXPECT_THROW(zone_from("type = 'sector', from = '90 deg', to = '60 deg'"), Error);
  EXPECT_THROW(zone_from("type = 'sector', from = 0.0, to = 1.0, inner_radius = 0.2, outer_radius = 0.1"), Error);
}

}  // namespace
}  // namespace scree
