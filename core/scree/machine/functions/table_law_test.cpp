// Functions of time through points.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scree/machine/functions/testing_function.hpp"

namespace scree {
namespace {

using test::function_of;
using test::refusal_of;

std::string table(const std::string& rest) { return "{type = 'table', " + rest + "}"; }

/// A file of its own, gone afterwards.
struct TableFile {
  explicit TableFile(const std::string& text) {
    file = std::filesystem::path{testing::TempDir()} /
           ("table_" + std::string{testing::UnitTest::GetInstance()->current_test_info()->name()} + ".csv");
    std::ofstream{file} << text;
  }
  ~TableFile() { std::filesystem::remove(file); }
  [[nodiscard]] std::string toml() const { return table("file = '" + file.string() + "'"); }
  std::filesystem::path file;
};

TEST(table_law, goes_straight_from_point_to_point_and_holds_the_ends) {
  const TimeFunction f = function_of(table("times = [1, 2, 4], values = [0, '1 m', '-1 m']"));
  EXPECT_EQ(f.value(0.0), 0.0);
  EXPECT_NEAR(f.value(1.5), 0.5, 1e-15);
  EXPECT_EQ(f.value(2.0), 1.0);
  EXPECT_NEAR(f.value(3.0), 0.0, 1e-15);
  EXPECT_EQ(f.value(9.0), -1.0);
  EXPECT_EQ(f.derivative(2.0), -1.0) << "from the right";
  EXPECT_EQ(f.derivative(9.0), 0.0);
  // Areas of the triangles, and one second of -1.
  EXPECT_NEAR(f.integral(0.0, 5.0), 0.5 + 0.5 - 0.5 - 1.0, 1e-15);
  EXPECT_NEAR(f.integral(-3.0, 1.5), 0.125, 1e-15);
}

TEST(table_law, repeats_its_points_over_and_over) {
  const TimeFunction f = function_of(table("times = [0, 1, 2], values = [0, 1, 0], outside = 'repeat'"));
  for (const double lap : {-4.0, 0.0, 2.0, 200.0}) {
    EXPECT_NEAR(f.value(lap + 0.25), 0.25, 1e-12);
    EXPECT_NEAR(f.value(lap + 1.25), 0.75, 1e-12);
    EXPECT_NEAR(f.integral(0.0, lap + 1.0), 0.5 * lap + 0.5, 1e-12);
  }
}

// Fritsch & Carlson: where the points rise, so does the curve, and it passes through them with a continuous slope.
TEST(table_law, monotone_cubic_does_not_overshoot) {
  const std::vector<double> times{0, 1, 1.2, 3, 4}, values{0, 0.1, 5, 5, 9};
  const TimeFunction f =
      function_of(table("times = [0, 1, 1.2, 3, 4], values = [0, 0.1, 5, 5, 9], interpolation = 'monotone_cubic'"));
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(f.value(times[k]), values[k], 1e-14);
  double last = 0.0;
  for (double t = 0.0; t <= 4.0; t += 1e-3) {
    EXPECT_GE(f.value(t), last - 1e-12) << t;
    EXPECT_GE(f.derivative(t), -1e-9) << t;
    last = f.value(t);
  }
  for (std::size_t k = 1; k + 1 < times.size(); ++k) {
    // Second derivatives are below 6 |slope| / span, 6 * 24.5 / 0.2: over 2e-9 s that is 2e-6.
    EXPECT_NEAR(f.derivative(times[k] - 1e-9), f.derivative(times[k] + 1e-9), 2e-6);
  }
  EXPECT_NEAR(f.value(2.0), 5.0, 1e-14) << "flat between equal values";
}

// The cubic's mean by Simpson's rule, which is exact for cubics.
TEST(table_law, integral_of_cubics_is_exact) {
  const TimeFunction f = function_of(table("times = [0, 1, 3], values = [0, 2, 3], interpolation = 'monotone_cubic'"));
  const auto simpson = [&](double a, double b) {
    return (b - a) / 6.0 * (f.value(a) + 4.0 * f.value(0.5 * (a + b)) + f.value(b));
  };
  EXPECT_NEAR(f.integral(0.0, 3.0), simpson(0, 1) + simpson(1, 3), 1e-14);
  EXPECT_NEAR(f.integral(0.2, 0.7), simpson(0.2, 0.7), 1e-14);
}

TEST(table_law, reads_a_file_of_time_and_value) {
  const TableFile file{"time [s], value [m]\n0, 0\n# a remark\n\n1.0, 2.0\n2.0; 1.0\n"};
  const TimeFunction f = function_of(file.toml());
  EXPECT_NEAR(f.value(0.5), 1.0, 1e-15);
  EXPECT_NEAR(f.value(1.5), 1.5, 1e-15);
}

TEST(table_law, bad_rows_of_a_file_are_named_by_their_line) {
  const auto refused = [](const std::string& text) { return refusal_of(TableFile{text}.toml()); };
  EXPECT_NE(refused("t, x\n0, 0\n1, two\n").find(".csv:3: 'two' is no number"), std::string::npos);
  EXPECT_NE(refused("0, 0\n1, 2, 3\n").find(".csv:2: the row has 3 numbers; it needs two"), std::string::npos);
  EXPECT_NE(refused("0, 0\n1, 2\n1, 3\n").find(".csv:3: the time 1 s does not come after 1 s"), std::string::npos);
  EXPECT_NE(refused("0, 0\n1, nan\n").find(".csv:2: nan is no finite number"), std::string::npos);
  EXPECT_NE(refused("0, 0\n").find("has 1 rows of numbers; two are the least"), std::string::npos);
  EXPECT_NE(refusal_of(table("file = '/no/such.csv'")).find("/no/such.csv cannot be read"), std::string::npos);
}

TEST(table_law, points_that_are_no_function_are_refused) {
  EXPECT_NE(refusal_of(table("times = [0, 1], values = [0]")).find("'values' has 1 entries, but 'times' has 2"),
            std::string::npos);
  EXPECT_NE(refusal_of(table("times = [0, 0], values = [0, 1]")).find("'times' must ascend"), std::string::npos);
  EXPECT_NE(refusal_of(table("times = [0], values = [0]")).find("two are the least"), std::string::npos);
  EXPECT_NE(refusal_of(table("times = [0, 1]")).find("either 'times' and 'values', or 'file'"), std::string::npos);
  EXPECT_NE(refusal_of(table("times = [0, 1], values = [0, 1], file = 'x.csv'")).find("either"), std::string::npos);
}

}  // namespace
}  // namespace scree
