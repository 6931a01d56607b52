// General blocks in sweeps: the local step, and the sweep over bodies and over an explicit matrix.
#include "scree/ccp/sweep/block_sweep.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "scree/ccp/delassus.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"

namespace scree::test {
namespace {

/// One block alone, over a random positive semi-definite matrix of `rank`.
struct OneBlock {
  TestingProblem t;
  std::vector<double> a;

  OneBlock(CcpBlock block, std::size_t rank, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const std::size_t n = block.rows;
    std::vector<double> factor(n * rank);
    for (double& x : factor) x = normal(random);
    a.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < rank; ++k) a[i * n + j] += factor[i * rank + k] * factor[j * rank + k];
      }
    }
    t.blocks = {block};
    t.matrix_first = {0, 1};
    t.matrix_column = {0};
    t.matrix_value = {0};
    t.matrix_values = a;
    t.r.assign(n, 0.0);
  }
  /// a x.
  [[nodiscard]] std::vector<double> times(std::span<const double> x) const {
    std::vector<double> out(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) out[i] += a[i * x.size() + j] * x[j];
    }
    return out;
  }
};

double product(std::span<const double> x, std::span<const double> y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

std::vector<CcpBlock> all_sorts() {
  std::vector<CcpBlock> blocks;
  for (const std::uint8_t rows : std::array<std::uint8_t, 5>{1, 2, 3, 5, 6}) {
    blocks.push_back({.kind = CcpKind::cone, .rows = rows, .friction = 0.6, .spinning = 0.1, .rolling = 0.3});
    blocks.push_back({.kind = CcpKind::cone, .rows = rows, .friction = 50.0, .spinning = 2.0, .rolling = 0.0});
  }
  for (const std::uint8_t rows : std::array<std::uint8_t, 4>{1, 3, 4, 6}) {
    blocks.push_back({.kind = CcpKind::free, .rows = rows});
    blocks.push_back({.kind = CcpKind::nonnegative, .rows = rows});
    blocks.push_back({.kind = CcpKind::box, .rows = rows, .lower = -0.3, .upper = 0.2});
  }
  return blocks;
}

// x^T (diag(d) - A) x >= 0, up to the rounding of the sums, for random matrices of full and of less rank.
TEST(block_step, metric_bounds_the_block) {
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
  for (const CcpBlock& block : all_sorts()) {
    if (block.kind != CcpKind::cone || block.rolling == 0.0) continue;
    for (int trial = 0; trial < 50; ++trial) {
      const OneBlock one{block, 1 + random() % block.rows, random};
      const BlockMetric d = sweep::bounding_metric(block, one.a);
      for (int k = 0; k < 20; ++k) {
        std::vector<double> x(block.rows), weighted(block.rows);
        for (std::size_t i = 0; i < x.size(); ++i) {
          x[i] = normal(random);
          const double weight = i == 0 ? d.normal : i <= 2 ? d.tangent : block.rows == 6 && i == 3 ? d.spin : d.rolling;
          weighted[i] = weight * x[i];
        }
        const double bound = product(x, weighted);
        EXPECT_LE(product(x, one.times(x)), bound * (1.0 + 1e-12)) << "rows " << int{block.rows};
      }
    }
  }
}

// The promise that makes Gauss-Seidel monotone, for relaxations on both sides of 1, singular blocks among them. The bound of
// rounding: the terms of the sums are of order 10.
TEST(block_step, never_raises_the_objective_and_stays_in_the_set) {
  std::mt19937_64 random{2};
  std::normal_distribution<double> normal;
  for (const CcpBlock& block : all_sorts()) {
    for (int trial = 0; trial < 60; ++trial) {
      const std::size_t rank = 1 + random() % block.rows;
      const OneBlock one{block, rank, random};
      sweep::BlockSteps steps;
      steps.bind(one.t.view(),
                 {.scalar_step = trial % 5 == 0, .relaxation = trial % 3 == 0 ? 1.9 : 0.5 + 0.5 * (trial % 3)});
      std::vector<double> g(block.rows), r(block.rows);
      for (double& x : g) x = normal(random);
      for (double& x : r) x = normal(random);
      if (rank < block.rows && block.kind != CcpKind::cone) r = one.times(r);  // or nothing bounds the objective
      project_block(block, g);
      const auto objective = [&] { return 0.5 * product(g, one.times(g)) + product(g, r); };
      const double before = objective();
      std::vector<double> u = one.times(g);
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += r[i];
      steps.advance(0, u, g);
      EXPECT_LE(objective(), before + 1e-10) << "kind " << int(block.kind) << " rows " << int{block.rows};
      EXPECT_LE(violation(block, g), 1e-12);
    }
  }
}

// A free block is solved by one step, redundant rows or not: u = 0 where the velocity can be met at all.
TEST(block_step, free_block_stops_all_its_rows_at_once) {
  std::mt19937_64 random{3};
  std::normal_distribution<double> normal;
  for (std::uint8_t rows = 1; rows <= 6; ++rows) {
    for (std::size_t rank = 1; rank <= rows; ++rank) {
      const OneBlock one{{.kind = CcpKind::free, .rows = rows}, rank, random};
      sweep::BlockSteps steps;
      steps.bind(one.t.view(), {});
      std::vector<double> g(rows, 0.0), x(rows);
      for (double& k : x) k = normal(random);
      const std::vector<double> r = one.times(x);  // in the range
      steps.advance(0, r, g);
      const std::vector<double> u = one.times(g);
      // Random factors of rank 6 have conditions of up to 1e4, squared in the matrix.
      for (std::size_t i = 0; i < rows; ++i) EXPECT_NEAR(u[i] + r[i], 0.0, 1e-8) << int{rows} << " of rank " << rank;
    }
  }
}

/// Impulses after sweeps to and fro over the blocks of `t`.
std::vector<double> swept(const TestingProblem& t, int sweeps, double* largest_drift = nullptr) {
  const CcpProblem p = t.view();
  ContactSweep contacts;
  contacts.bind(p, {});
  BlockSweep blocks;
  blocks.bind(p, contacts, {});
  std::vector<double> gamma(p.rows(), 0.0), u(p.rows());
  contacts.set_velocities(std::vector<Twist>(p.bodies()));
  blocks.set_impulses(gamma);
  for (int k = 0; k < sweeps; ++k) blocks.sweep(k % 2 == 1);
  blocks.impulses(gamma);
  DelassusOperator delassus;
  CcpProblem rigid = p;
  rigid.compliance = {};
  delassus.bind(rigid, nullptr);
  delassus.apply(gamma, u);
  for (std::size_t i = 0; i < blocks.v().size() && largest_drift != nullptr; ++i) {
    *largest_drift = std::max(*largest_drift, std::abs(u[i] - blocks.v()[i]));
  }
  return gamma;
}

// Same problem, same order, two ways to know the velocities. (Cones of 5 and 6 rows go in an order of their own over bodies.)
TEST(block_sweep, over_the_matrix_does_as_over_the_bodies) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PlantedProblem planted =
        planted_problem({.contacts = 0, .blocks = 12, .compliant = seed % 2 == 0, .repeats = 0.2, .seed = seed});
    for (CcpBlock& block : planted.problem.blocks) {
      if (block.kind == CcpKind::cone && block.rows >= 5) block.kind = CcpKind::nonnegative;
    }
    const std::vector<double> bodies = swept(planted.problem, 10);
    double drift = 0.0;
    const std::vector<double> matrix = swept(with_matrix(planted.problem), 10, &drift);
    double scale = 0.0;
    for (const double g : bodies) scale = std::max(scale, std::abs(g));
    // Rounding, multiplied by the conditions of the blocks (up to 1e6 among random ones) and ten sweeps.
    for (std::size_t i = 0; i < bodies.size(); ++i) EXPECT_NEAR(bodies[i], matrix[i], 1e-8 * scale) << "seed " << seed;
    EXPECT_LE(drift, 1e-11 * (1.0 + scale));
  }
}

// A matrix from a file need not be symmetric to the last digits: v has to be W g, not its transpose's product.
TEST(block_sweep, keeps_the_velocities_of_a_matrix_that_is_not_symmetric) {
  TestingProblem t = with_matrix(planted_problem({.contacts = 0, .blocks = 8, .seed = 4}).problem);
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> uniform{0.99, 1.01};
  for (double& value : t.matrix_values) value *= uniform(random);
  double drift = 0.0, scale = 0.0;
  for (const double g : swept(t, 6, &drift)) scale = std::max(scale, std::abs(g));
  EXPECT_GT(scale, 0.0);
  EXPECT_LE(drift, 1e-12 * (1.0 + scale));
}

// A joint between bodies that contacts touch as well: after the blocks' sweep the bodies have the velocities of its impulses,
// and an immovable body has none.
TEST(block_sweep, pushes_the_bodies_that_the_contacts_share) {
  const PlantedProblem planted = planted_problem({.contacts = 6, .blocks = 6, .seed = 7});
  const CcpProblem p = planted.problem.view();
  ContactSweep contacts;
  contacts.bind(p, {});
  BlockSweep blocks;
  blocks.bind(p, contacts, {});
  std::vector<double> gamma(p.rows(), 0.0);
  std::vector<Twist> w(p.bodies()), expected(p.bodies());
  contacts.set_impulses(gamma);
  contacts.set_velocities(w);
  blocks.set_impulses(gamma);
  blocks.sweep(false);
  blocks.impulses(gamma);
  contacts.velocities(w);
  DelassusOperator delassus;
  delassus.bind(p, nullptr);
  delassus.body_velocities(gamma, expected);
  double largest = 0.0;
  for (std::size_t k = 0; k < w.size(); ++k) {
    // The same sums in another order.
    EXPECT_LE(norm(w[k].linear - expected[k].linear), 1e-12);
    EXPECT_LE(norm(w[k].angular - expected[k].angular), 1e-12);
    largest = std::max(largest, norm(w[k].linear));
  }
  EXPECT_GT(largest, 0.0);
}

}  // namespace
}  // namespace scree::test
