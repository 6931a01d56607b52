// Functions of time as formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "scree/machine/functions/testing_function.hpp"

namespace scree {
namespace {

using test::function_of;
using test::refusal_of;

std::string expression(const std::string& text) { return "{type = 'expression', expression = '" + text + "'}"; }

TEST(expression_law, computes_in_t_and_pi) {
  const TimeFunction f = function_of(expression("0.1*sin(2*pi*5*t)"));
  // muParser's arithmetic is double's: some roundings of numbers near one.
  EXPECT_NEAR(f.value(0.05), 0.1, 1e-15);
  EXPECT_NEAR(f.value(0.1), 0.0, 1e-15);
  EXPECT_NEAR(function_of(expression("t < 1 ? t^2 : 1")).value(0.5), 0.25, 1e-15);
}

TEST(expression_law, derivative_is_a_difference_or_the_one_given) {
  // Rounding eps / h and truncation h^2 / 6 with h = 6e-6: 5e-11 relative to f and f'''.
  EXPECT_NEAR(function_of(expression("sin(t)")).derivative(0.3), std::cos(0.3), 1e-9);
  const TimeFunction given = function_of("{type = 'expression', expression = 't^2', derivative = '42*t'}");
  EXPECT_EQ(given.derivative(2.0), 84.0) << "what is given is believed";
}

TEST(expression_law, integral_of_a_short_span_is_that_of_the_formula) {
  const TimeFunction f = function_of(expression("cos(t)"));
  EXPECT_FALSE(f.has_closed_integral());
  // Gauss with five points: error (b-a)^11 (5!)^4 / (11 (10!)^3) f^(10), 1e-13 at a span of one.
  EXPECT_NEAR(f.integral(0.2, 0.7), std::sin(0.7) - std::sin(0.2), 1e-14);
  EXPECT_NEAR(f.integral(0.7, 0.2), std::sin(0.2) - std::sin(0.7), 1e-14);
}

TEST(expression_law, syntax_errors_name_the_place_in_the_scene_and_in_the_expression) {
  const std::string text = refusal_of(expression("0.1*sin(2*pi*t"));
  EXPECT_NE(text.find("scene.toml:1:40: "), std::string::npos) << text;
  EXPECT_NE(text.find("wrong at character 15: "), std::string::npos) << text;
  EXPECT_NE(text.find("arenthesis"), std::string::npos) << text;
  const std::string unknown = refusal_of(expression("2*omega"));
  EXPECT_NE(unknown.find("wrong at character 3: "), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("omega"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("the time t [s], pi"), std::string::npos) << unknown;
  EXPECT_NE(refusal_of(expression("")).find("'expression' is \"\", which is wrong"), std::string::npos);
  EXPECT_NE(refusal_of(expression("t = 3")).find("write '=='"), std::string::npos);
  EXPECT_NE(refusal_of("{type = 'expression', expression = 't', derivative = '1 +'}").find("'derivative' is \"1 +\""),
            std::string::npos);
}

TEST(expression_law, values_that_are_not_finite_name_the_function_and_the_time) {
  const TimeFunction f = function_of(expression("1 / (t - 0.5)"));
  EXPECT_NO_THROW(static_cast<void>(f.value(0.0)));
  try {
    static_cast<void>(f.value(0.5));
    FAIL() << "infinite values must be refused";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("scene.toml:1:"), std::string::npos) << text;
    EXPECT_NE(text.find("'x' is inf m at t = 0.5 s"), std::string::npos) << text;
  }
  EXPECT_THROW(static_cast<void>(function_of(expression("sqrt(t)")).value(-1.0)), Error);
}

// One formula, many askers: each gets the value of its own time.
TEST(expression_law, several_threads_may_ask_at_once) {
  const TimeFunction f = function_of(expression("t*t"));
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    threads.emplace_back([f, k, &wrong] {
      for (int i = 0; i < 20000; ++i) {
        const double t = static_cast<double>(k) + 1e-5 * i;
        wrong[k] += static_cast<int>(f.value(t) != t * t);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace scree
