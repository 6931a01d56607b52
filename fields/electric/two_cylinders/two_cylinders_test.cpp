#include "two_cylinders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;

// The published separator.
constexpr double kRoll = 0.16;
constexpr double kElectrode = 0.019;
constexpr double kDistance = 0.267;
constexpr double kAngle = kPi / 6.0;
constexpr double kVoltage = -35e3;
const std::string kMachine =
    "roll_radius = '160 mm'\nelectrode_radius = '19 mm'\ndistance = 0.267\nangle = '30 deg'\nvoltage = '-35 kV'\n";

TwoCylinders field_from(const std::string& toml) {
  return TwoCylinders{options_from_text(toml, TwoCylinders::parameters())};
}

Vec3 field_at(const ElectricField& field, const Vec3& point) {
  Vec3 result;
  field.evaluate({&point, 1}, 0.0, {&result, 1}, {});
  return result;
}

double potential_at(const ElectricField& field, const Vec3& point) {
  Vec3 unused;
  double result = 0.0;
  field.evaluate({&point, 1}, 0.0, {&unused, 1}, {&result, 1});
  return result;
}

Vec3 on_circle(double cx, double cy, double radius, double angle) {
  return {cx + radius * std::cos(angle), cy + radius * std::sin(angle), 0.0};
}

TEST(two_cylinders, meets_the_values_of_an_independent_computation) {
  struct Row {
    double x, y, v, ex, ey;
    double v_digit, e_digit;  // half a unit of the last digit that is known
  };
  const Row rows[] = {{0.138997, 0.080250, -163.980015570, 283624.174222, 163750.582221, 5e-10, 5e-7},
                      {0.203516, 0.117500, -26425.7003, 457259.71, 263999.25, 5e-5, 5e-3},
                      {0.0, 0.17, -655.4387, 5293.43, 63364.00, 5e-5, 5e-3},
                      {0.15, 0.259808, -11598.4646, 63242.92, -17502.39, 5e-5, 5e-3}};
  const TwoCylinders field = field_from(kMachine);
  for (const Row& row : rows) {
    const Vec3 point{row.x, row.y, 0.02};
    const Vec3 e = field_at(field, point);
    EXPECT_NEAR(potential_at(field, point), row.v, 1.1 * row.v_digit);
    EXPECT_NEAR(e.x, row.ex, 1.1 * row.e_digit);
    EXPECT_NEAR(e.y, row.ey, 1.1 * row.e_digit);
    EXPECT_EQ(e.z, 0.0);
  }
}

TEST(two_cylinders, strongest_field_on_the_roll_is_on_the_line_of_centres) {
  const TwoCylinders field = field_from(kMachine);
  double strongest = 0.0;
  double where = 0.0;
  for (int degree = 0; degree < 360; ++degree) {
    // A hair outside, so that rounding does not put the point into the roll: 1e-12 changes E by 1e-11 of itself.
    const double e = norm(field_at(field, on_circle(0, 0, kRoll * (1 + 1e-12), degree * kPi / 180.0)));
    if (e > strongest) {
      strongest = e;
      where = degree;
    }
  }
  EXPECT_EQ(where, 30.0);
  EXPECT_NEAR(strongest, 328512.0158, 1.1e-4);
}

// The next three together prove the formula: a function that is harmonic outside two circles, bounded far away, and has
// the given values on both circles is the only one.

TEST(two_cylinders, potential_is_that_of_the_conductors_on_their_surfaces) {
  const TwoCylinders field = field_from(kMachine);
  const double ex = kDistance * std::cos(kAngle);
  const double ey = kDistance * std::sin(kAngle);
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.0 * kPi * k / 64.0;
    // 1e-11 outside the surface V has moved by 1e-11 * 0.019 m * 1e6 V/m, below 1e-6 V.
    EXPECT_NEAR(potential_at(field, on_circle(0, 0, kRoll * (1 + 1e-11), angle)), 0.0, 1e-5);
    EXPECT_NEAR(potential_at(field, on_circle(ex, ey, kElectrode * (1 + 1e-11), angle)), kVoltage, 1e-5);
  }
}

TEST(two_cylinders, potential_is_harmonic_and_bounded) {
  const TwoCylinders field = field_from(kMachine);
  // Mean value property: V at a centre is the mean of V on a circle around it. The trapezoidal rule converges
  // geometrically, as (radius / distance to the nearest line charge)^64 < 1e-19 here; what is left is rounding.
  const Vec3 centres[] = {{0.2, 0.11, 0}, {0.0, 0.18, 0}, {0.19, 0.19, 0}, {-0.3, -0.1, 0}, {0.3, 0.0, 0}, {1, 2, 0}};
  for (const Vec3& c : centres) {
    double sum = 0.0;
    for (int k = 0; k < 64; ++k) sum += potential_at(field, on_circle(c.x, c.y, 0.01, 2.0 * kPi * k / 64.0));
    EXPECT_NEAR(sum / 64.0, potential_at(field, c), 1e-8) << c.x << ", " << c.y;
  }
  // Bounded: far away it tends to a constant between the two potentials, the field falling with the square of distance.
  const double far = potential_at(field, {1e5, 0, 0});
  EXPECT_LT(far, 0.0);
  EXPECT_GT(far, kVoltage);
  EXPECT_NEAR(potential_at(field, {-1e5, 1e5, 0}), far, 1.0);
}

/// -dV/dx along an axis, by differences over 2e-5 m. Error delta^2 / 6 of V's third derivative, about 2 E / (0.05 m)^2: 1e-8
/// of E; rounding eps V / delta: 1e-6 V/m.
double minus_slope(const ElectricField& field, const Vec3& point, int axis) {
  constexpr double kDelta = 1e-5;
  Vec3 above = point;
  Vec3 below = point;
  above[axis] += kDelta;
  below[axis] -= kDelta;
  return (potential_at(field, below) - potential_at(field, above)) / (2.0 * kDelta);
}

constexpr Vec3 kOffsets[] = {{0.2, 0.11, 0.1}, {0.0, 0.18, 0.18}, {-0.1, -0.2, -0.3}, {0.26, 0.2, 0.0}};
constexpr Vec3 kCentre{0.5, -0.25, 0.0};

TEST(two_cylinders, field_is_minus_the_gradient_of_the_potential) {
  const TwoCylinders field = field_from(kMachine + "centre = [0.5, -0.25, 0.0]\n");
  for (const Vec3& offset : kOffsets) {
    const Vec3 e = field_at(field, kCentre + offset);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(e[axis], minus_slope(field, kCentre + offset, axis), 1e-7 * norm(e) + 1e-5) << axis;
    }
  }
}

// Under an envelope g(z) that holds in planes of constant z. Along z there is no field, though the potential g V falls: what
// is left out is -V g'(z), of tanh V / (2 l cosh^2((|z| - z0) / l)), away from the machine's middle.
TEST(two_cylinders, envelope_keeps_the_gradient_in_planes_across_the_roll_and_leaves_out_its_axial_part) {
  const double z0 = 0.177, l = 0.054;
  const TwoCylinders plain = field_from(kMachine + "centre = [0.5, -0.25, 0.0]\n");
  const TwoCylinders field = field_from(kMachine + "centre = [0.5, -0.25, 0.0]\nenvelope = 'tanh'\n");
  for (const Vec3& offset : kOffsets) {
    const Vec3 point = kCentre + offset, e = field_at(field, point);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(e[axis], minus_slope(field, point, axis), 1e-7 * norm(e) + 1e-5) << axis;
    }
    EXPECT_EQ(e.z, 0.0);
    if (offset.z == 0.0) continue;  // the envelope has a kink there
    const double steepness = std::cosh((std::abs(offset.z) - z0) / l);
    const double v = potential_at(plain, point);
    const double left_out = std::copysign(1.0, offset.z) * v / (2.0 * l * steepness * steepness);
    // The third derivative along z is V / l^3 at most: an error of 1e-8 V / l.
    EXPECT_NEAR(minus_slope(field, point, 2), left_out, 1e-7 * std::abs(v) / l);
  }
}

TEST(two_cylinders, inside_the_conductors_there_is_no_field_and_one_potential) {
  const TwoCylinders field = field_from(kMachine);
  const double ex = kDistance * std::cos(kAngle);
  const double ey = kDistance * std::sin(kAngle);
  for (const double inside : {0.0, 0.5, 0.999}) {
    for (const double angle : {0.0, 0.5, 3.0}) {
      const Vec3 in_roll = on_circle(0, 0, kRoll * inside, angle);
      const Vec3 in_electrode = on_circle(ex, ey, kElectrode * inside, angle);
      EXPECT_EQ(field_at(field, in_roll), Vec3{});
      EXPECT_EQ(potential_at(field, in_roll), 0.0);
      EXPECT_EQ(field_at(field, in_electrode), Vec3{});
      EXPECT_EQ(potential_at(field, in_electrode), kVoltage);
    }
  }
}

TEST(two_cylinders, field_is_proportional_to_the_voltage) {
  const TwoCylinders field = field_from(kMachine);
  const TwoCylinders twice =
      field_from("roll_radius = 0.16\nelectrode_radius = 0.019\ndistance = 0.267\nangle = '30 deg'\nvoltage = '70 kV'");
  const Vec3 point{0.2, 0.12, 0.0};
  const Vec3 e = field_at(field, point);
  // Factors of -2 are exact.
  EXPECT_EQ(field_at(twice, point), -2.0 * e);
}

TEST(two_cylinders, points_from_the_grounded_roll_to_a_negative_electrode) {
  const TwoCylinders field = field_from(kMachine);
  const Vec3 to_electrode{std::cos(kAngle), std::sin(kAngle), 0.0};
  EXPECT_GT(dot(field_at(field, 0.2 * to_electrode), to_electrode), 0.0);
}

TEST(two_cylinders, touching_cylinders_are_refused_where_the_distance_is_written) {
  try {
    field_from("roll_radius = 0.16\nelectrode_radius = 0.019\ndistance = 0.179\nvoltage = 1.0");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string{error.what()}.find(":3:"), std::string::npos) << error.what();
    EXPECT_NE(std::string{error.what()}.find("0.179 m"), std::string::npos) << error.what();
  }
}

TEST(two_cylinders, setup_logs_the_strongest_field_on_the_roll) {
  TwoCylinders field = field_from(kMachine);
  test::FakeSceneServices services;
  field.setup(services);
  ASSERT_EQ(services.log_lines().size(), 1u);
  EXPECT_NE(services.log_lines()[0].find("328.512 kV/m"), std::string::npos) << services.log_lines()[0];
}

}  // namespace
}  // namespace scree
