// The laws against their papers.
#include "wear_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"

namespace scree {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// 10 N over 3 m, k = 1e-3, H = 1.5 GPa: 2e-11 m3.
TEST(wear_law, archard_is_load_times_way_over_hardness) {
  EXPECT_DOUBLE_EQ(archard_volume({.wear_coefficient = 1e-3, .hardness = 1.5e9}, 10.0 * 3.0), 2e-11);
}

double finnie(double mass, double speed, double degrees, const WearPair& pair) {
  return finnie_volume(pair, mass, speed * std::sin(degrees * kDegree), speed * std::cos(degrees * kDegree));
}

// K = psi = 2: V = m U^2 / (4 p) (sin 2a - 3 sin^2 a) up to tan a = 1/3, then m U^2 / (4 p) cos^2 a / 3.
TEST(wear_law, finnie_by_hand_at_four_angles) {
  const WearPair steel{.flow_stress = 2e9};
  const double m = 1e-3, u = 10.0, unit = m * u * u / (4.0 * 2e9);
  EXPECT_NEAR(finnie(m, u, 90.0, steel), 0.0, 1e-16 * unit);  // cos 90 deg is 6e-17
  EXPECT_NEAR(finnie(m, u, 30.0, steel), unit * 0.25, 1e-14 * unit);
  EXPECT_NEAR(finnie(m, u, 60.0, steel), unit / 12.0, 1e-14 * unit);
  const double s = std::sin(10.0 * kDegree);
  EXPECT_NEAR(finnie(m, u, 10.0, steel), unit * (std::sin(20.0 * kDegree) - 3.0 * s * s), 1e-14 * unit);
  EXPECT_EQ(finnie(m, u, 0.0, steel), 0.0);
}

// Both branches meet at tan a = K / 6, and most is worn at tan 2a = K / 3, for any K.
TEST(wear_law, finnie_is_continuous_and_greatest_where_it_should_be) {
  for (const double k : {1.5, 2.0, 4.0}) {
    const WearPair pair{.flow_stress = 1e9, .force_ratio = k, .cut_ratio = 1.7};
    const double join = std::atan(k / 6.0) / kDegree, most = 0.5 * std::atan(k / 3.0) / kDegree;
    const double at = finnie(1.0, 1.0, join, pair);
    EXPECT_NEAR(finnie(1.0, 1.0, join - 1e-9, pair), at, 1e-9 * at);
    EXPECT_NEAR(finnie(1.0, 1.0, join + 1e-9, pair), at, 1e-9 * at);
    for (const double beside : {-0.5, 0.5}) {
      EXPECT_LT(finnie(1.0, 1.0, most + beside, pair), finnie(1.0, 1.0, most, pair)) << k;
    }
  }
}

TEST(wear_law, nothing_is_cut_by_what_leaves) {
  EXPECT_EQ(finnie_volume({}, 1.0, -1.0, 2.0), 0.0);
  EXPECT_EQ(finnie_volume({}, 1.0, 0.0, 2.0), 0.0);
}

TEST(wear_law, pairs_take_what_they_leave_out_from_the_observer) {
  test::FakeSceneServices services;
  for (const char* name : {"liner", "ore", "steel"}) services.materials().add({name, 1000.0, {}, {}});
  const auto table = [&](const std::string& text) {
    WearTable laws;
    laws.setup(options_from_text("hardness = 2e9\nwear_coefficient = 1e-4\n" + text, WearTable::parameters()),
               services);
    return laws;
  };
  const WearTable laws = table("pair = [{ worn = 'liner', by = 'ore', hardness = '5 GPa', force_ratio = 3 }]");
  EXPECT_EQ(laws.pair(0, 1).hardness, 5e9);
  EXPECT_EQ(laws.pair(0, 1).flow_stress, 5e9);
  EXPECT_EQ(laws.pair(0, 1).force_ratio, 3.0);
  EXPECT_EQ(laws.pair(0, 1).wear_coefficient, 1e-4);
  EXPECT_EQ(laws.pair(1, 0).hardness, 2e9);
  EXPECT_EQ(laws.pair(0, 2).flow_stress, 2e9);
  EXPECT_EQ(laws.pair(0, 2).force_ratio, 2.0);
  EXPECT_THROW(table("pair = [{ worn = 'linr', by = 'ore' }]"), Error);
  EXPECT_THROW(table("pair = [{ worn = 'liner', by = 'ore' }, { worn = 'liner', by = 'ore' }]"), Error);
}

}  // namespace
}  // namespace scree
