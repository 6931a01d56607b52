// All CCP solvers give the same velocities: impulses may differ where they are not determined, velocities never do.
#include <gtest/gtest.h>

#include "conformance/ccp_solver_case.hpp"
#include "solver_by_name.hpp"

namespace scree::test {
namespace {

std::vector<Twist> velocities_of(const CcpProblem& problem, std::span<const double> gamma) {
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  std::vector<Twist> w(problem.bodies());
  delassus.body_velocities(gamma, w);
  return w;
}

double speed(const Twist& w) { return std::max(norm(w.linear), norm(w.angular)); }

// Solved to a residual of 1e-11 m/s, five decades below what is compared: the map from residual to velocity error has the
// conditioning of the problem, about 1e3 here. Masses over two decades, a third of the problems compliant.
TEST(ccp_solvers, agree_in_velocity_to_1e_6_of_the_largest_speed) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const TestingProblem t = random_problem(
        {.bodies = 12, .contacts = 24, .compliant = seed % 3 == 0, .mass_decades = 2.0, .seed = 100 + seed});
    const CcpProblem problem = t.view();
    std::vector<Twist> reference;
    double largest = 0.0;
    for (const char* const name :
         {"apgd", "pgs", "asgs", "spg", "jacobi", "admm", "interior_point", "semismooth_newton"}) {
      const Solved s = solve(*solver_named(name), problem, 1e-11, 1000000);
      EXPECT_EQ(s.summary.status, SolveStatus::converged) << name << ", seed " << seed;
      const std::vector<Twist> w = velocities_of(problem, s.gamma);
      if (reference.empty()) {
        reference = w;
        for (const Twist& v : w) largest = std::max(largest, speed(v));
      }
      for (std::size_t k = 0; k < w.size(); ++k) {
        const Twist difference{w[k].linear - reference[k].linear, w[k].angular - reference[k].angular};
        EXPECT_LE(speed(difference), 1e-6 * largest) << name << ", seed " << seed << ", body " << k;
      }
    }
  }
}

}  // namespace
}  // namespace scree::test
