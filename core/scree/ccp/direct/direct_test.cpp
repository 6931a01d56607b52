// The sparse factorisation against dense linear algebra, and the derivative of projections against differences of them.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <random>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/direct/block_cholesky.hpp"
#include "scree/ccp/direct/direct_system.hpp"
#include "scree/ccp/direct/projection_derivative.hpp"
#include "support/ccp_problems.hpp"

namespace scree::direct {
namespace {

using Dense = Eigen::MatrixXd;

Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

/// A random sparse matrix of blocks of 1 to 6 unknowns, the same in dense form.
struct RandomMatrix {
  std::vector<std::uint32_t> size, first;
  std::vector<Edge> edges;
  BlockCholesky sparse;
  Dense dense;

  RandomMatrix(std::size_t nodes, std::size_t reach, std::uint64_t seed) {
    std::mt19937_64 random{seed};
    std::uint32_t all = 0;
    for (std::size_t k = 0; k < nodes; ++k) {
      first.push_back(all);
      size.push_back(1 + static_cast<std::uint32_t>(random() % 6));
      all += size.back();
    }
    for (std::uint32_t a = 0; a < nodes; ++a) {
      for (std::uint32_t b = a + 1; b < nodes; ++b) {
        if (random() % nodes < (b - a < reach ? nodes / 2 : 1)) edges.push_back({a, b});
      }
    }
    sparse.analyse(size, edges);
    dense = Dense::Zero(all, all);
    fill(random);
  }

  void fill(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    sparse.clear();
    dense.setZero();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [a, b] = edges[e];
      Eigen::Map<Dense> block(sparse.off_diagonal(e).data(), size[b], size[a]);
      for (double& x : block.reshaped()) x = normal(random);
      dense.block(first[b], first[a], size[b], size[a]) = block;
      dense.block(first[a], first[b], size[a], size[b]) = block.transpose();
    }
    // Diagonally dominant, so positive definite; scales over six decades, which a Cholesky factor does not mind.
    const Eigen::VectorXd sums = dense.cwiseAbs().rowwise().sum().array() + 1.0;
    dense += sums.asDiagonal();
    Eigen::VectorXd scale(dense.rows());
    for (double& s : scale) s = std::pow(10.0, 3.0 * std::tanh(normal(random)));
    dense = scale.asDiagonal() * dense * scale.asDiagonal();
    for (std::size_t k = 0; k < size.size(); ++k) {
      Eigen::Map<Dense>(sparse.diagonal(k).data(), size[k], size[k]) =
          dense.block(first[k], first[k], size[k], size[k]);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [a, b] = edges[e];
      Eigen::Map<Dense>(sparse.off_diagonal(e).data(), size[b], size[a]) =
          dense.block(first[b], first[a], size[b], size[a]);
    }
  }
};

TEST(block_cholesky, solves_what_the_dense_factorisation_solves) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    RandomMatrix m(seed == 6 ? 120 : 5 + 20 * seed, 2 + seed, seed);
    ASSERT_TRUE(m.sparse.factor());
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(m.dense.rows(), -1.0, 2.0);
    const Eigen::VectorXd expected = m.dense.llt().solve(b);
    Eigen::VectorXd x = b;
    m.sparse.solve({x.data(), static_cast<std::size_t>(x.size())});
    // Backward stable, row by row in its own scale: the dominant diagonal leaves a condition of a few hundred.
    const Eigen::VectorXd root = m.dense.diagonal().cwiseSqrt();
    EXPECT_LE((x - expected).cwiseProduct(root).norm(), 1e-11 * expected.cwiseProduct(root).norm()) << "seed " << seed;
  }
}

TEST(block_cholesky, another_matrix_of_the_same_structure_leaves_no_trace_of_the_first) {
  RandomMatrix m(60, 4, 7);
  ASSERT_TRUE(m.sparse.factor());
  std::mt19937_64 random{8};
  m.fill(random);
  ASSERT_TRUE(m.sparse.factor());
  const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(m.dense.rows(), 1.0, 3.0);
  const Eigen::VectorXd root = m.dense.diagonal().cwiseSqrt();
  Eigen::VectorXd x = m.dense * truth;
  m.sparse.solve({x.data(), static_cast<std::size_t>(x.size())});
  EXPECT_LE((x - truth).cwiseProduct(root).norm(), 1e-11 * truth.cwiseProduct(root).norm());
}

TEST(block_cholesky, says_when_a_matrix_is_indefinite) {
  RandomMatrix m(20, 3, 9);
  m.sparse.diagonal(4)[0] *= -1.0;
  EXPECT_FALSE(m.sparse.factor());
  m.sparse.diagonal(4)[0] = std::nan("");
  EXPECT_FALSE(m.sparse.factor());
}

/// N - E of a problem, column by column from the core's operator.
Dense dense_operator(const CcpProblem& problem) {
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  Dense n(index(problem.rows()), index(problem.rows()));
  std::vector<double> unit(problem.rows(), 0.0), column(problem.rows());
  for (std::size_t k = 0; k < problem.rows(); ++k) {
    unit[k] = 1.0;
    delassus.apply(unit, column);
    unit[k] = 0.0;
    n.col(index(k)) = Eigen::Map<Eigen::VectorXd>(column.data(), n.rows());
  }
  return n;
}

// x = (N + B^-1)^-1 b against a dense solve, for B far from a multiple of N.
TEST(direct_system, solves_the_regularised_problem) {
  const test::TestingProblem t = test::random_problem({.bodies = 20, .immovable = 2, .contacts = 60, .seed = 4});
  const CcpProblem problem = t.view();
  DirectSystem system;
  system.bind(problem);
  std::mt19937_64 random{3};
  std::normal_distribution<double> normal;
  Dense b_inverse = Dense::Zero(index(problem.rows()), index(problem.rows()));
  std::vector<double> c(system.block_numbers());
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    Eigen::Map<Eigen::Matrix3d> root(c.data() + system.block_at(i));
    for (double& x : root.reshaped()) x = normal(random);
    root += 3.0 * Eigen::Matrix3d::Identity();
    b_inverse.block<3, 3>(index(3 * i), index(3 * i)) = (root * root.transpose()).inverse();
  }
  ASSERT_TRUE(system.factor(c));
  std::vector<double> rhs(problem.rows()), x(problem.rows());
  for (double& value : rhs) value = normal(random);
  system.solve_regularised(rhs, x);
  const Eigen::Map<Eigen::VectorXd> b(rhs.data(), b_inverse.rows()), got(x.data(), b_inverse.rows());
  const Eigen::VectorXd expected = (dense_operator(problem) + b_inverse).ldlt().solve(b);
  // The condition of the system is below 1e4.
  EXPECT_LE((got - expected).norm(), 1e-10 * expected.norm());
}

/// A block of every kind, with a metric.
std::vector<CcpBlock> all_blocks() {
  std::vector<CcpBlock> blocks;
  for (const std::uint8_t rows : std::initializer_list<std::uint8_t>{1, 2, 3, 5, 6}) {
    blocks.push_back({.kind = CcpKind::cone, .rows = rows, .friction = 0.6, .spinning = 0.3, .rolling = 0.2});
    blocks.push_back({.kind = CcpKind::cone, .rows = rows, .friction = 0.0, .spinning = 0.0, .rolling = 0.5});
  }
  blocks.push_back({.kind = CcpKind::free, .rows = 4});
  blocks.push_back({.kind = CcpKind::nonnegative, .rows = 3});
  blocks.push_back({.kind = CcpKind::box, .rows = 2, .lower = -0.4, .upper = 0.7});
  return blocks;
}

// Central differences: their error is the third derivative, of order one a unit away from kinks, times 1e-10; a point whose
// differences to the left and to the right disagree has a kink next to it and is left out.
TEST(projection_derivative, is_the_derivative_where_there_is_one) {
  constexpr double kStep = 1e-5;
  const BlockMetric metric{1.7, 0.6, 0.9, 2.3};
  std::mt19937_64 random{5};
  std::normal_distribution<double> normal;
  int compared = 0;
  for (const CcpBlock& block : all_blocks()) {
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<double> a(block.rows), c(std::size_t{block.rows} * block.rows);
      for (double& x : a) x = normal(random);
      const auto projected = [&](std::size_t row, double step) {
        std::vector<double> p = a;
        p[row] += step;
        project_block(block, metric, p);
        return Eigen::VectorXd{Eigen::Map<Eigen::VectorXd>(p.data(), block.rows)};
      };
      const Eigen::VectorXd p = projected(0, 0.0);
      projection_derivative(block, metric, a, {p.data(), block.rows}, c);
      const Eigen::Map<Dense> root(c.data(), block.rows, block.rows);
      const Dense b = root * root.transpose();
      for (std::size_t row = 0; row < block.rows; ++row) {
        const Eigen::VectorXd right = (projected(row, kStep) - p) / kStep, left = (p - projected(row, -kStep)) / kStep;
        if ((right - left).norm() > 1e-3) continue;
        // dp/da = B T.
        const Eigen::VectorXd given = b.col(index(row)) * weight_of_row(block, metric, row);
        EXPECT_LE((0.5 * (left + right) - given).norm(), 1e-6)
            << "kind " << static_cast<int>(block.kind) << ", rows " << int{block.rows} << ", row " << row;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 8000);
}

}  // namespace
}  // namespace scree::direct
