// Masses that no scene has, from 1e-300 to 1e300 kg and such beside each other: a solver need not solve them, but what it calls
// converged the judge has to find within the tolerance, and what it returns has to be numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "conformance/ccp_solver_case.hpp"
#include "scree/ccp/guess.hpp"
#include "solver_by_name.hpp"

namespace scree::test {
namespace {

constexpr double kTolerance = 1e-8;  // [m/s]

/// Contacts between bodies of masses around those of `masses`; with `rows` also a joint, a limit and a contact that resists
/// rolling, which may ask for what the contacts do not allow.
TestingProblem extreme_problem(const std::vector<double>& masses, bool compliant, bool rows, std::uint64_t seed) {
  TestingProblem t = random_problem({.bodies = 6, .contacts = 10, .compliant = compliant, .seed = seed});
  std::mt19937_64 random{seed};
  for (std::size_t k = 1; k < t.inverse_mass.size(); ++k) {
    const double m = masses[random() % masses.size()];
    t.inverse_mass[k] /= m;
    t.inverse_inertia[k] = Mat3{(1.0 / m) * t.inverse_inertia[k].row0, (1.0 / m) * t.inverse_inertia[k].row1,
                                (1.0 / m) * t.inverse_inertia[k].row2};
  }
  if (!rows) return t;
  const std::size_t before = t.r.size();
  t.add_block({.kind = CcpKind::free, .a = 1, .b = 2},
              rows_at_a_point(3, false, {0, 0, 1}, {0.1, 0, 0}, {0, 0.1, 0}, 1.0), {0.0, 0.0, 0.0});
  t.add_block({.kind = CcpKind::cone, .a = 2, .b = 3, .friction = 0.5, .spinning = 0.1, .rolling = 0.1},
              rows_at_a_point(6, true, {1, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, 0.1), {-0.5, 0.3, -0.2, 0.1, 0.0, 0.0});
  t.add_block({.kind = CcpKind::nonnegative, .a = 0, .b = 4}, rows_at_a_point(1, false, {0, 1, 0}, {}, {}, 1.0),
              {-0.25});
  if (compliant) t.compliance.resize(t.compliance.size() + t.r.size() - before, 0.01);
  return t;
}

class ExtremeMasses : public testing::TestWithParam<const char*> {
 protected:
  /// Solves, from zero and from a large guess, and compares what is said with what the judge says.
  void expect_honest(const TestingProblem& t, const std::string& what) {
    const CcpProblem problem = t.view();
    for (const double size : {0.0, 1.0, 1e150}) {
      std::mt19937_64 random{7};
      std::normal_distribution<double> normal;
      std::vector<double> gamma(problem.rows());
      for (double& g : gamma) g = size * normal(random);
      SolveContext context;
      context.tolerance = kTolerance;
      context.max_iterations = 300;
      const SolveSummary summary = solver_->solve(problem, context, gamma);
      for (const double g : gamma) EXPECT_TRUE(std::isfinite(g)) << what << ", guess " << size;
      if (summary.status != SolveStatus::converged) continue;
      ++converged_;
      EXPECT_LE(summary.residual, kTolerance) << what << ", guess " << size;
      EXPECT_LE(ccp_residual(problem, gamma), kTolerance) << what << ", guess " << size;
    }
  }

  std::unique_ptr<CcpSolver> solver_ = solver_named(GetParam());
  int converged_ = 0;
};

TEST_P(ExtremeMasses, are_solved_or_not_said_to_be) {
  const std::map<std::string, std::vector<double>> masses{
      {"1e-300", {1e-300}},
      {"1e300", {1e300}},
      {"1e-160", {1e-160}},
      {"1e160", {1e160}},
      {"1e-40", {1e-40}},
      {"1e40", {1e40}},
      {"1e-5 and 1e5", {1e-5, 1e5}},
      {"1e-10 and 1e10", {1e-10, 1e10}},
      {"1e-20 and 1e20", {1e-20, 1.0, 1e20}},
      {"1e-100 and 1e100", {1e-100, 1e100}},
      {"1 and 1e-300", {1.0, 1e-300}},
      {"1 and 1e300", {1.0, 1e300}},
      {"1e-300 and 1e300", {1e-300, 1e-100, 1.0, 1e100, 1e300}},
      {"1e-307, whose inverse inertia is none", {1e-307}},
  };
  for (const auto& [name, each] : masses) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const bool compliant = seed % 3 == 0, rows = seed % 2 == 0;
      const TestingProblem t = extreme_problem(each, compliant, rows, seed);
      const std::string what = name + ", seed " + std::to_string(seed);
      expect_honest(t, what);
      bool finite = true;
      for (const double x : t.inverse_mass) finite = finite && std::isfinite(x);
      if (rows && finite) expect_honest(with_matrix(t), what + ", matrix");
    }
  }
  EXPECT_GT(converged_, 50) << "the test has to see answers";
}

// One body alone: nothing in such a problem is large or small in its own unit, and the judge sees in any unit what it sees in
// kilograms, as far as 1/m and 1/(m r^2) have room.
TEST_P(ExtremeMasses, of_one_sphere_slide_as_one_kilogram_does) {
  const double mu = 0.2, v = 1.0, w = 4.0;
  const double impulse = (v + mu * w) / (1.0 + 3.5 * mu * mu);  // of a mass of 1 kg (conformance suite)
  for (const double m : {1e-300, 1e-250, 1e-170, 1e-120, 1e-60, 1e-20, 1.0, 1e20, 1e60, 1e120, 1e170, 1e250, 1e300}) {
    const TestingProblem t = sphere_on_floor(m, 0.1, mu, {-v, w, 0.0});
    const Solved s = solve(*solver_, t.view(), kTolerance, 1000);
    if (s.summary.status != SolveStatus::converged) continue;
    // A residual of 1e-8 m/s, through the condition of one contact, 3.5.
    EXPECT_NEAR(s.gamma[0] / m, impulse, 1e-6) << m;
    EXPECT_NEAR(s.gamma[1] / m, -mu * impulse, 1e-6) << m;
  }
}

std::string solver_name(const testing::TestParamInfo<const char*>& info) { return info.param; }
INSTANTIATE_TEST_SUITE_P(solvers, ExtremeMasses,
                         testing::Values("admm", "apgd", "asgs", "interior_point", "jacobi", "pgs", "spg",
                                         "semismooth_newton"),
                         solver_name);

}  // namespace
}  // namespace scree::test
