// Functions of time against their formulas.
#include "scree/machine/functions/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/machine/functions/testing_function.hpp"

namespace scree {
namespace {

using test::function_of;
using test::refusal_of;

constexpr double kPi = std::numbers::pi;

/// Composite trapezoids, independent of the law's own integral.
double summed(const TimeFunction& f, double a, double b) {
  constexpr int kSpans = 20000;
  const double h = (b - a) / kSpans;
  double sum = 0.5 * (f.value(a) + f.value(b));
  for (int k = 1; k < kSpans; ++k) sum += f.value(a + k * h);
  return sum * h;
}

TEST(TimeFunction, plain_quantities_are_constant) {
  EXPECT_EQ(function_of("'3 mm'").value(7.0), 3e-3);
  EXPECT_EQ(function_of("2.5").value(-1.0), 2.5);
  EXPECT_EQ(function_of("2.5").derivative(1.0), 0.0);
  EXPECT_EQ(function_of("2.5").integral(1.0, 3.0), 5.0);
  EXPECT_EQ(TimeFunction{4.0}.value(0.0), 4.0);
  EXPECT_EQ(function_of("{type = 'constant', value = '1 cm'}").value(0.0), 0.01);
}

TEST(TimeFunction, ramp_is_a_straight_line_between_held_values) {
  const TimeFunction f = function_of("{type = 'ramp', from = 1, to = 4, start = '2 s', duration = '3 s'}");
  EXPECT_EQ(f.value(0.0), 1.0);
  EXPECT_NEAR(f.value(3.0), 2.0, 1e-15);
  EXPECT_EQ(f.value(9.0), 4.0);
  EXPECT_EQ(f.derivative(1.0), 0.0);
  EXPECT_NEAR(f.derivative(3.0), 1.0, 1e-15);
  EXPECT_EQ(f.derivative(5.0), 0.0) << "from the right";
  // Two seconds of 1, three of 2.5 in the mean, one of 4.
  EXPECT_NEAR(f.integral(0.0, 6.0), 2.0 + 7.5 + 4.0, 1e-14);
  EXPECT_NEAR(f.integral(6.0, 0.0), -13.5, 1e-14);
}

// The quintic passage has no jump in value, speed or acceleration, and rises most in the middle: 15/8 of the mean slope.
TEST(TimeFunction, smooth_step_has_two_continuous_derivatives) {
  const TimeFunction f = function_of("{type = 'smooth_step', to = 2, start = 1, duration = 0.5}");
  EXPECT_EQ(f.value(1.0), 0.0);
  EXPECT_NEAR(f.value(1.25), 1.0, 1e-15);
  EXPECT_EQ(f.value(1.5), 2.0);
  EXPECT_NEAR(f.derivative(1.25), 15.0 / 8.0 * 2.0 / 0.5, 1e-13);
  const double h = 1e-4;
  for (const double end : {1.0, 1.5}) {
    EXPECT_NEAR(f.derivative(end), 0.0, 1e-14);
    // The acceleration 60 x (1 - x)(1 - 2x) D / T^2 of a time h within the end: 60 h / T^3 D.
    const double curvature = (f.derivative(end + h) - f.derivative(end - h)) / (2 * h);
    EXPECT_NEAR(curvature, 0.0, 60 * h / (0.5 * 0.5 * 0.5) * 2.0);
  }
  EXPECT_NEAR(f.integral(0.0, 3.0), 0.5 * 2.0 * 0.5 + 2.0 * 1.5, 1e-14) << "the passage is odd about its middle";
  EXPECT_NEAR(f.integral(1.1, 1.3), summed(f, 1.1, 1.3), 1e-9);
}

TEST(TimeFunction, sine_has_mean_amplitude_frequency_and_phase) {
  const TimeFunction f =
      function_of("{type = 'sine', mean = 0.5, amplitude = '2 m', frequency = '50 Hz', phase = '90 deg'}");
  EXPECT_NEAR(f.value(0.0), 2.5, 1e-15);
  EXPECT_NEAR(f.value(0.005), 0.5, 1e-12);
  EXPECT_NEAR(f.derivative(0.005), -2.0 * 2 * kPi * 50, 1e-9);
  EXPECT_NEAR(f.integral(0.0, 0.02), 0.5 * 0.02, 1e-15) << "over a period the swing cancels";
  EXPECT_NEAR(f.integral(0.001, 0.008), summed(f, 0.001, 0.008), 1e-10);
}

// Central differences of the value, h^2 f''' / 6 and eps / h of error.
TEST(TimeFunction, derivatives_are_those_of_the_values) {
  for (const char* toml :
       {"{type = 'ramp', to = 3, duration = 2}", "{type = 'smooth_step', from = 1, to = -1, duration = 2}",
        "{type = 'sine', amplitude = 1, frequency = 0.7, phase = 0.3}",
        "{type = 'table', times = [0, 0.7, 2], values = [0, 3, 4], interpolation = 'monotone_cubic'}",
        "{type = 'expression', expression = 'exp(-t)*sin(3*t)'}"}) {
    const TimeFunction f = function_of(toml);
    for (double t = 0.05; t < 2.0; t += 0.1) {
      const double h = 1e-5;
      EXPECT_NEAR(f.derivative(t), (f.value(t + h) - f.value(t - h)) / (2 * h), 1e-7) << toml << " at " << t;
    }
  }
}

TEST(TimeFunction, bad_descriptions_are_refused_at_their_place) {
  EXPECT_NE(refusal_of("{type = 'sine', amplitude = 1, frequency = 0}").find("above 0 Hz"), std::string::npos);
  EXPECT_NE(refusal_of("{type = 'ramp', to = '3 kg', duration = 1}").find("kg"), std::string::npos);
  EXPECT_NE(refusal_of("{type = 'ramp', to = 3, duration = 0}").find("'duration'"), std::string::npos);
  EXPECT_NE(refusal_of("{type = 'wiggle'}").find("smooth_step"), std::string::npos);
}

}  // namespace
}  // namespace scree
