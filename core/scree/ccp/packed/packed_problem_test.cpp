// PackedProblem: the same operator, projections and residual as in the frames of the contacts.
#include "scree/ccp/packed/packed_problem.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"

namespace scree::test {
namespace {

std::vector<double> impulses(const CcpProblem& problem, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal{0.3, 1.0};
  std::vector<double> gamma(problem.rows());
  for (double& g : gamma) g = normal(random);
  project_guess(problem, gamma);
  return gamma;
}

/// Residual by the passes over packed records.
double packed_residual(const CcpProblem& problem, std::span<const double> gamma) {
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  packed::PackedProblem packed;
  packed.build(delassus, packed::Scaling::block);
  packed::Impulses x;
  packed.pack(gamma, x);
  packed.load(x);
  packed.for_body_groups([&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) {
      const packed::Twists sum = packed::take_sums(packed.slots(), packed.first_slots(at));
      packed::spread(packed::times(packed.body_group(at), sum), packed.first_slots(at), packed.slots());
    }
  });
  std::vector<double> product(packed.has_matrix() ? problem.rows() : 0);
  if (packed.has_matrix()) delassus.row_velocities({}, gamma, product);
  return packed.look(x, product).residual;
}

// The frames of contacts are orthonormal to rounding: so is what goes through the world's.
TEST(packed_problem, impulses_come_back_from_the_world_to_rounding) {
  const PlantedProblem t = planted_problem({.bodies = 40, .contacts = 101, .blocks = 7, .seed = 3});
  const CcpProblem problem = t.problem.view();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  packed::PackedProblem packed;
  packed.build(delassus, packed::Scaling::block);
  const std::vector<double> gamma = impulses(problem, 1);
  packed::Impulses x;
  packed.pack(gamma, x);
  std::vector<double> back(gamma.size(), -1.0);
  packed.unpack(x, back);
  for (std::size_t k = 0; k < gamma.size(); ++k) EXPECT_NEAR(back[k], gamma[k], 1e-14);
}

// The residual needs velocities, cones, blocks and compliance all right. The tolerance is that of sums in another order.
TEST(packed_problem, residual_is_that_of_the_judge_for_every_kind_of_unit) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PlantedProblem t = planted_problem(
        {.bodies = 30, .contacts = 30 + seed, .blocks = seed % 8, .compliant = seed % 2 == 0, .seed = seed});
    const std::vector<double> gamma = impulses(t.problem.view(), seed);
    const double expected = ccp_residual(t.problem.view(), gamma);
    EXPECT_NEAR(packed_residual(t.problem.view(), gamma), expected, 1e-12 * expected) << "seed " << seed;
    if (seed <= 3) {
      EXPECT_NEAR(packed_residual(with_matrix(t.problem).view(), gamma), expected, 1e-12 * expected);
    }
  }
}

// Contacts in several runs, the last one neither full nor whole groups of four, and blocks behind them in the same run.
TEST(packed_problem, residual_is_that_of_the_judge_over_several_runs) {
  const PlantedProblem t = planted_problem({.bodies = 3001, .immovable = 3, .contacts = 9001, .blocks = 50, .seed = 8});
  const std::vector<double> gamma = impulses(t.problem.view(), 2);
  const double expected = ccp_residual(t.problem.view(), gamma);
  EXPECT_NEAR(packed_residual(t.problem.view(), gamma), expected, 1e-12 * expected);
}

// Lane by lane against the closed form of one contact, on the cone's three sides and on its axis.
TEST(packed_problem, projection_of_four_contacts_is_that_of_each) {
  std::mt19937_64 random{4};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform{0.1, 3.0};
  for (int round = 0; round < 1000; ++round) {
    Lanes g_n{}, m_n{}, m_t{}, mu{};
    Lanes3 t{};
    for (std::size_t k = 0; k < 4; ++k) {
      g_n[k] = normal(random), m_n[k] = uniform(random), m_t[k] = uniform(random);
      mu[k] = k == 0 ? 0.0 : uniform(random);
      if (round % 5 == 0) continue;  // on the axis
      t.x[k] = normal(random), t.y[k] = normal(random), t.z[k] = normal(random);
    }
    const packed::Projected to = packed::project(g_n, t, m_n, m_t, mu);
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = std::hypot(t.x[k], t.y[k], t.z[k]);
      const Vec3 expected =
          project_cone3({g_n[k], length, 0.0}, mu[k], cone_weights(1.0 / m_n[k], 1.0 / m_t[k], mu[k]));
      EXPECT_NEAR(to.along[k], expected.x, 1e-13);
      EXPECT_NEAR(to.across[k] * length, expected.y, 1e-13);
    }
  }
}

}  // namespace
}  // namespace scree::test
