#include "scree/config/units.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "scree/base/error.hpp"

namespace scree {
namespace {

// One rounding of the factor and one of the product: relative errors of a few units in the last place.
void expect_close(double value, double exact) { EXPECT_NEAR(value, exact, 1e-15 * std::abs(exact)); }

TEST(units, rpm_is_two_pi_over_sixty_radians_a_second) {
  expect_close(parse_quantity("44.8 rpm", "rad/s"), 44.8 * 2.0 * std::numbers::pi / 60.0);
  expect_close(parse_quantity("2 rev/s", "rad/s"), 4.0 * std::numbers::pi);
}

TEST(units, degrees_become_radians) {
  expect_close(parse_quantity("180 deg", "rad"), std::numbers::pi);
  expect_close(parse_quantity("90°", "rad"), std::numbers::pi / 2);
  expect_close(parse_quantity("360 deg/s", "rad/s"), 2 * std::numbers::pi);
}

TEST(units, prefixed_and_compound_units_convert) {
  EXPECT_EQ(parse_quantity("35 kV", "V"), 35000.0);
  EXPECT_EQ(parse_quantity("3 mm", "m"), 0.003);
  EXPECT_EQ(parse_quantity("0.7mm", "m"), 0.0007);
  EXPECT_EQ(parse_quantity("  -1.5e-3 m ", "m"), -0.0015);
  expect_close(parse_quantity("2.5 g/cm3", "kg/m3"), 2500.0);
  expect_close(parse_quantity("26 µC/m^2", "C/m2"), 26e-6);
  expect_close(parse_quantity("36 kg/h", "kg/s"), 0.01);
  expect_close(parse_quantity("3 g cm2", "kg m2"), 3e-7);
  expect_close(parse_quantity("2 mm/N", "m/N"), 0.002);
  expect_close(parse_quantity("30 kV/cm", "V/m"), 3e6);
}

TEST(units, counted_things_have_no_dimension) {
  EXPECT_EQ(parse_quantity("10000 particles/s", "1/s"), 10000.0);
  EXPECT_EQ(parse_quantity("10000 1/s", "1/s"), 10000.0);
  EXPECT_EQ(parse_quantity("50 %", "1"), 0.5);
  EXPECT_EQ(parse_quantity("50 percent", "1"), 0.5);
  EXPECT_EQ(parse_quantity("2.5", "1"), 2.5);
}

TEST(units, temperatures_know_their_offset) { expect_close(parse_quantity("20 degC", "K"), 293.15); }

TEST(units, any_unit_takes_every_dimension_to_its_own_si_unit) {
  expect_close(parse_quantity("2 nC", kAnyUnit), 2e-9);
  expect_close(parse_quantity("3 mm", kAnyUnit), 3e-3);
  expect_close(parse_quantity("2.5 g/cm3", kAnyUnit), 2500.0);
  expect_close(parse_quantity("60 rpm", kAnyUnit), 2 * std::numbers::pi);
  EXPECT_EQ(parse_quantity("7", kAnyUnit), 7.0);
}

TEST(units, threads_share_the_library) {
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&wrong] {
      for (int i = 0; i < 200; ++i) wrong += parse_quantity("1 km", "m") == 1000.0 ? 0 : 1;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(units, units_of_descriptions_are_known) {
  for (const char* unit :
       {"1",   "m", "s",   "kg", "m/s",  "m/s2", "kg/m3", "kg m2", "rad", "rad/s", "N/m", "N s/m", "1/s", "kg/s",
        "m/N", "V", "V/m", "C",  "C/m2", "F/m",  "Pa",    "Pa s",  "1/m", "m3",    "m2",  "J",     "K"}) {
    EXPECT_TRUE(is_unit(unit)) << unit;
    EXPECT_NO_THROW((void)parse_quantity(quantity_example(unit), unit)) << unit;
  }
  for (const char* unit : {"", "furlongs_per", "3 m", "m^0.5", "seconds since 2000-01-01", "m @ 3", "lg(re m)", "m2x^"})
    EXPECT_FALSE(is_unit(unit)) << unit;
}

std::string sentence_of(std::string_view text, std::string_view unit) {
  try {
    (void)parse_quantity(text, unit);
  } catch (const Error& failure) {
    return failure.what();
  }
  return "accepted";
}

TEST(units, refusals_name_both_units_and_a_way_out) {
  EXPECT_EQ(sentence_of("3 kg", "m"), R"("3 kg" is in kg, which cannot be converted to m; write for example "3 mm")");
  EXPECT_EQ(sentence_of("3", "m"), R"("3" has no unit where a quantity in m is needed; write for example "3 mm")");
  EXPECT_EQ(sentence_of("3 quux", "m"), R"("3 quux" has the unknown unit 'quux'; write for example "3 mm")");
  EXPECT_EQ(sentence_of("wide", "m"), R"("wide" is not a quantity in m; write for example "3 mm")");
  EXPECT_EQ(sentence_of("nan m", "m"), R"("nan m" is not a finite number; write for example "3 mm")");
  EXPECT_EQ(sentence_of("inf m", "m"), R"("inf m" is not a finite number; write for example "3 mm")");
  EXPECT_EQ(sentence_of("1e999 m", "m"),
            R"("1e999 m" is too large or too small for a number; write for example "3 mm")");
  EXPECT_EQ(sentence_of("1e308 km", "m"), R"("1e308 km" is not a finite number in m; write for example "3 mm")");
  EXPECT_EQ(sentence_of("", "m"), R"("" is not a quantity in m; write for example "3 mm")");
  EXPECT_EQ(sentence_of("-0,1 s", "s"), R"("-0,1 s" has a decimal comma; write "-0.1 s")");
  // What can be read in two ways gets no advice that would be refused again, or be wrong.
  for (const std::string text : {"1,234.5 m", "1,2,3 m", "1.5,2 m"}) {
    EXPECT_EQ(sentence_of(text, "m"), "\"" + text + "\" has a comma, which numbers have not; a point stands before " +
                                          "decimals; write for example \"3 mm\"");
  }
  EXPECT_EQ(sentence_of("1,5e-3 m2", "m2"), R"("1,5e-3 m2" has a decimal comma; write "1.5e-3 m2")");
  EXPECT_EQ(sentence_of("3 10 m", "m"), R"("3 10 m" has the unknown unit '10 m'; write for example "3 mm")");
}

TEST(units, a_frequency_is_no_angular_velocity) {
  EXPECT_NE(sentence_of("50 Hz", "rad/s"), "accepted");
  EXPECT_NE(sentence_of("44.8 rpm", "1/s"), "accepted");
  EXPECT_NE(sentence_of("30 deg", "1"), "accepted");
}

}  // namespace
}  // namespace scree
