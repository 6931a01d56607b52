// Definiteness of sparse matrices against dense eigenvalues and closed forms.
#include "scree/ccp/fclib/detail/definite.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <random>
#include <vector>

namespace scree {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

/// Numbers like those of contacts: most rows know a few others only.
Matrix random_sparse(Index rows, Index columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Matrix out = Matrix::Zero(rows, columns);
  for (double& x : out.reshaped()) x = uniform(random) < 0.2 ? normal(random) : 0.0;
  return out;
}

double least_eigenvalue(const Matrix& a) { return Eigen::SelfAdjointEigenSolver<Matrix>{a}.eigenvalues().minCoeff(); }

// H^T H of 6 rows and up to 40 columns: most eigenvalues are zero, and all units are as good.
TEST(find_indefinite, takes_singular_matrices_of_any_rank_and_unit) {
  std::mt19937_64 random{1};
  for (const double unit : {1e-290, 1e-12, 1.0, 1e290}) {
    for (Index columns = 1; columns <= 40; columns += 3) {
      const Matrix h = random_sparse(6, columns, random);
      EXPECT_FALSE(find_indefinite((unit * (h.transpose() * h)).sparseView())) << columns << " columns, unit " << unit;
    }
  }
  EXPECT_FALSE(find_indefinite(SparseMatrix(5, 5)));
  EXPECT_FALSE(find_indefinite(SparseMatrix(0, 0)));
}

// H^T H - x I: indefinite by x as soon as x is above what counts as rounding. What is told lies between the least eigenvalue
// and zero.
TEST(find_indefinite, finds_the_least_share_that_is_not_rounding) {
  std::mt19937_64 random{2};
  for (int k = 0; k < 40; ++k) {
    const Matrix h = random_sparse(10, 30, random), singular = h.transpose() * h;
    const double rounding = kSemidefinite * singular.diagonal().maxCoeff();
    const Matrix within = singular - 0.5 * rounding * Matrix::Identity(30, 30);
    EXPECT_FALSE(find_indefinite(within.sparseView())) << k;
    for (const double share : {2.0, 1e3, 1e7}) {
      const Matrix below = singular - share * rounding * Matrix::Identity(30, 30);
      const auto found = find_indefinite(below.sparseView());
      ASSERT_TRUE(found) << k << ", " << share;
      EXPECT_LT(found->eigenvalue, 0.0);
      EXPECT_GE(found->eigenvalue, least_eigenvalue(below) - 1e-12 * singular.norm());
      EXPECT_EQ(found->diagonal, below.diagonal().maxCoeff());
    }
  }
}

// [0 1; 1 0] has -1 and 1; a row of zeros with a number beside them is never semidefinite.
TEST(find_indefinite, looks_beside_diagonals_of_zeros) {
  Matrix a = Matrix::Zero(4, 4);
  a(0, 3) = a(3, 0) = 1.0;
  ASSERT_TRUE(find_indefinite(a.sparseView()));
  EXPECT_NEAR(find_indefinite(a.sparseView())->eigenvalue, -1.0, 1e-12);
  a(0, 0) = 1.0;  // eigenvalues (1 +- sqrt 5) / 2
  ASSERT_TRUE(find_indefinite(a.sparseView()));
  EXPECT_NEAR(find_indefinite(a.sparseView())->eigenvalue, 0.5 * (1.0 - std::sqrt(5.0)), 1e-12);
}

/// `diagonal` on the diagonal, `beside` for the pairs.
SparseMatrix matrix_of(Index rows, double diagonal, double beside, const std::vector<std::pair<Index, Index>>& pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index k = 0; k < rows; ++k) entries.emplace_back(k, k, diagonal);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j, beside);
    entries.emplace_back(j, i, beside);
  }
  SparseMatrix out(rows, rows);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// A chain too long to be factorised: eigenvalues 2 + 2 b cos(k pi / (n + 1)), down to zero for b = -1 and to -1 for b = -1.5.
// 60 steps of Lanczos come within (pi / 60)^2 of the spectrum's width, 6.
TEST(find_indefinite, looks_for_large_eigenvalues_in_long_chains) {
  constexpr Index kRows = 120'000;
  std::vector<std::pair<Index, Index>> links;
  for (Index k = 1; k < kRows; ++k) links.emplace_back(k - 1, k);
  EXPECT_FALSE(find_indefinite(matrix_of(kRows, 2.0, -1.0, links)));
  const auto found = find_indefinite(matrix_of(kRows, 2.0, -1.5, links));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->eigenvalue, -1.0, 6.0 * std::pow(std::numbers::pi / 60.0, 2));
}

// Few rows, but everything touches everything far away: a factor would have 10^8 numbers. Six neighbours each, whose matrix has
// eigenvalues between -6 and 6, so that 6 on the diagonal are enough and 1 is not (half of them lie below zero).
TEST(find_indefinite, does_not_factorise_what_fills_the_memory) {
  constexpr Index kRows = 40'000;
  std::mt19937_64 random{3};
  std::vector<Index> ring(kRows);
  for (Index k = 0; k < kRows; ++k) ring[static_cast<std::size_t>(k)] = k;
  std::vector<std::pair<Index, Index>> pairs;
  for (int turn = 0; turn < 3; ++turn) {
    std::shuffle(ring.begin(), ring.end(), random);
    for (std::size_t k = 0; k < ring.size(); ++k) pairs.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
  }
  EXPECT_FALSE(find_indefinite(matrix_of(kRows, 6.0, 1.0, pairs)));
  const auto found = find_indefinite(matrix_of(kRows, 1.0, 1.0, pairs));
  ASSERT_TRUE(found);
  EXPECT_LT(found->eigenvalue, -1.0);
  EXPECT_GE(found->eigenvalue, -5.0);
}

// d on the diagonal and -1 everywhere else: eigenvalues d + 1, and d + 1 - n once. A sparse factor of so many numbers would take
// ten seconds; d = n - 1 is singular and valid, d = n - 2 is below zero by a share of 1 / n.
TEST(find_indefinite, decides_full_matrices_of_thousands_of_rows) {
  constexpr Index kRows = 3200;
  Matrix a = Matrix::Constant(kRows, kRows, -1.0);
  a.diagonal().setConstant(kRows - 1.0);
  EXPECT_FALSE(find_indefinite(a.sparseView()));
  a.diagonal().setConstant(kRows - 2.0);
  const auto found = find_indefinite(a.sparseView());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->eigenvalue, -1.0, 1e-12 * kRows);
}

// Random full matrices of rank 20, and a little below.
TEST(find_indefinite, agrees_with_dense_eigenvalues_of_full_matrices) {
  std::mt19937_64 random{5};
  std::normal_distribution<double> normal;
  for (int k = 0; k < 10; ++k) {
    Matrix h(20, 200);
    for (double& x : h.reshaped()) x = normal(random);
    const Matrix singular = h.transpose() * h;
    const double rounding = kSemidefinite * singular.diagonal().maxCoeff();
    EXPECT_FALSE(find_indefinite(singular.sparseView())) << k;
    const Matrix below = singular - 3.0 * rounding * Matrix::Identity(200, 200);
    const auto found = find_indefinite(below.sparseView());
    ASSERT_TRUE(found) << k;
    EXPECT_GE(found->eigenvalue, least_eigenvalue(below) - 1e-12 * singular.norm());
  }
}

TEST(find_bad_pivot, agrees_with_dense_eigenvalues) {
  std::mt19937_64 random{4};
  int good = 0;
  for (int k = 0; k < 100; ++k) {
    const Matrix h = random_sparse(12, 12, random);
    const Matrix a = h.transpose() * h + (k % 2 == 0 ? 0.1 : -0.1) * Matrix::Identity(12, 12);
    const auto bad = find_bad_pivot(a.sparseView());
    EXPECT_EQ(!bad, least_eigenvalue(a) > 0.0) << k;
    if (!bad) {
      ++good;
      continue;
    }
    EXPECT_LE(bad->pivot, 0.0);
  }
  EXPECT_GE(good, 50);
}

// The masses of 100 000 bodies, one after another: work that grows with the square of the rows would take minutes.
TEST(find_bad_pivot, looks_at_many_rows_once_each) {
  EXPECT_FALSE(find_bad_pivot(matrix_of(600'000, 2.0, 0.0, {})));
  SparseMatrix mass = matrix_of(600'000, 2.0, 0.0, {});
  mass.coeffRef(599'999, 599'999) = -2.0;
  ASSERT_TRUE(find_bad_pivot(mass));
  EXPECT_EQ(find_bad_pivot(mass)->row, 599'999);
}

// A body of which one direction is left out, and one that is the sum of two others up to rounding.
TEST(find_bad_pivot, names_the_row_of_a_singular_matrix) {
  Matrix a = Eigen::Vector<double, 6>{2, 2, 2, 4, 4, 4}.asDiagonal();
  EXPECT_FALSE(find_bad_pivot(a.sparseView()));
  a(4, 4) = 0.0;
  ASSERT_TRUE(find_bad_pivot(a.sparseView()));
  EXPECT_EQ(find_bad_pivot(a.sparseView())->row, 4);
  EXPECT_EQ(find_bad_pivot(a.sparseView())->pivot, 0.0);
  Matrix h = Matrix::Identity(3, 3);
  h.col(2) = h.col(0) / 3.0 + h.col(1) / 7.0;
  EXPECT_TRUE(find_bad_pivot((h.transpose() * h).sparseView()));
}

TEST(asymmetry_of_a_sparse_matrix, is_relative_to_its_largest_number) {
  Matrix a = Matrix::Identity(3, 3) * 4.0;
  EXPECT_EQ(asymmetry(a.sparseView()), 0.0);
  a(0, 2) = 1.0;
  EXPECT_EQ(asymmetry(a.sparseView()), 0.25);
  a(2, 0) = 1.0;
  EXPECT_EQ(asymmetry(a.sparseView()), 0.0);
  EXPECT_EQ(asymmetry(SparseMatrix(2, 2)), 0.0);
}

}  // namespace
}  // namespace scree
