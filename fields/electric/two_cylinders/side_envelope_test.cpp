#include "side_envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scree/config/validate.hpp"
#include "two_cylinders.hpp"

namespace scree {
namespace {

SideEnvelope envelope_from(const std::string& toml) {
  return SideEnvelope{options_from_text(toml, SideEnvelope::parameters())};
}

TEST(side_envelope, none_is_one_everywhere) {
  const SideEnvelope g = envelope_from("");
  EXPECT_TRUE(g.is_none());
  EXPECT_EQ(g(0.0), 1.0);
  EXPECT_EQ(g(1e3), 1.0);
}

TEST(side_envelope, cutoff_ends_at_the_half_width) {
  const SideEnvelope g = envelope_from("envelope = 'cutoff'\nhalf_width = '0.25 m'");
  EXPECT_EQ(g(0.25), 1.0);
  EXPECT_EQ(g(-0.25), 1.0);
  EXPECT_EQ(g(0.2500001), 0.0);
  EXPECT_EQ(g(-0.2500001), 0.0);
}

TEST(side_envelope, tanh_halves_27_mm_past_the_side_and_decays_over_54_mm) {
  const SideEnvelope g = envelope_from("envelope = 'tanh'\nhalf_width = '150 mm'");
  EXPECT_DOUBLE_EQ(g(0.177), 0.5);
  EXPECT_DOUBLE_EQ(g(-0.177), 0.5);
  // 1/2 (1 - tanh u) = 1 / (1 + exp 2u): at one decay length further out 1 / (1 + e^2).
  EXPECT_NEAR(g(0.177 + 0.054), 1.0 / (1.0 + std::exp(2.0)), 1e-15);
  EXPECT_NEAR(g(0.0), 1.0 / (1.0 + std::exp(-2.0 * 0.177 / 0.054)), 1e-15);
}

TEST(side_envelope, tanh_takes_a_position_and_length_of_its_own) {
  const SideEnvelope g = envelope_from("envelope = 'tanh'\ndecay_position = 0.2\ndecay_length = 0.01");
  EXPECT_DOUBLE_EQ(g(0.2), 0.5);
  EXPECT_NEAR(g(0.21), 1.0 / (1.0 + std::exp(2.0)), 1e-14);
}

TEST(side_envelope, scales_field_and_potential_about_the_middle_of_the_machine) {
  const std::string machine =
      "roll_radius = 0.16\nelectrode_radius = 0.019\ndistance = 0.267\nvoltage = -35e3\ncentre = [0.0, 0.0, 1.0]\n";
  const TwoCylinders plain{options_from_text(machine, TwoCylinders::parameters())};
  const TwoCylinders faded{options_from_text(machine + "envelope = 'tanh'", TwoCylinders::parameters())};
  const Vec3 point{0.2, 0.05, 1.177};
  Vec3 e_plain;
  Vec3 e_faded;
  double v_plain = 0.0;
  double v_faded = 0.0;
  plain.evaluate({&point, 1}, 0.0, {&e_plain, 1}, {&v_plain, 1});
  faded.evaluate({&point, 1}, 0.0, {&e_faded, 1}, {&v_faded, 1});
  // z = 1.177 - 1.0 is 0.177 to 1e-16, and g' l = 1/2: g = 0.5 to 1e-14.
  EXPECT_NEAR(e_faded.x, 0.5 * e_plain.x, 1e-13 * std::abs(e_plain.x));
  EXPECT_NEAR(e_faded.y, 0.5 * e_plain.y, 1e-13 * std::abs(e_plain.y));
  EXPECT_NEAR(v_faded, 0.5 * v_plain, 1e-13 * std::abs(v_plain));
}

}  // namespace
}  // namespace scree
