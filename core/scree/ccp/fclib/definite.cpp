// Sylvester's law of inertia decides: A + shift is positive definite iff all pivots of its L D L^T are above zero. A pivot d_k
// below zero comes with a vector that shows it, x = L^-T e_k, since x^T A x = d_k; Lanczos starts from there, so that the
// eigenvalue that is told is at most x^T A x / x^T x. A factor that fills up anyway is a matter for dense Cholesky, which does ten
// times as many products a second.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "scree/ccp/fclib/detail/definite.hpp"

namespace scree {

namespace {

using Vector = Eigen::VectorXd;
using Eigen::Index;

constexpr Index kMostRows = 100'000;
constexpr double kMostFill = 30e6;     ///< numbers of a factor
constexpr double kMostProducts = 5e9;  ///< of its computation, some ten seconds
constexpr Index kLanczosSteps = 60;
/// What is left of a diagonal by rounding alone [1].
constexpr double kPivotRounding = 1e-14;

double largest_number(const SparseMatrix& a) { return a.nonZeros() > 0 ? a.coeffs().abs().maxCoeff() : 0.0; }

/// What L D L^T takes.
struct Effort {
  double numbers = 0.0, products = 0.0;
};

/// The effort for `a`, ordered as SimplicialLDLT does; no more is counted when it has too many numbers. Each row of L holds what
/// the elimination tree has between the entries of A in that row and its diagonal (Liu 1990), and a column of n numbers costs
/// n^2 / 2 products.
Effort effort_of(const SparseMatrix& a) {
  Eigen::AMDOrdering<int>::PermutationType inverse;
  Eigen::AMDOrdering<int>{}(a.selfadjointView<Eigen::Lower>(), inverse);
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order = inverse.inverse();
  SparseMatrix ordered;
  ordered = a.twistedBy(order);
  std::vector<Index> parent(static_cast<std::size_t>(a.rows()), -1), seen(parent.size(), -1);
  std::vector<double> column(parent.size(), 0.0);
  Effort effort;
  for (Index k = 0; k < ordered.cols(); ++k) {
    seen[static_cast<std::size_t>(k)] = k;
    for (SparseMatrix::InnerIterator e(ordered, k); e; ++e) {
      if (e.row() >= k) continue;
      for (Index i = e.row(); seen[static_cast<std::size_t>(i)] != k; i = parent[static_cast<std::size_t>(i)]) {
        const auto at = static_cast<std::size_t>(i);
        if (parent[at] < 0) parent[at] = k;
        seen[at] = k;
        effort.products += column[at] + 0.5;
        column[at] += 1.0;
        if (++effort.numbers > kMostFill) return effort;
      }
    }
  }
  return effort;
}

/// Whether a dense factor of `rows` has room and takes less time than a sparse one.
bool is_better_dense(const Effort& effort, Index rows) {
  const auto n = static_cast<double>(rows);
  return n * n <= 2.0 * kMostFill && 10.0 * effort.products > n * n * n / 6.0;
}

bool has_dense_factor(const SparseMatrix& a, double shift) {
  Eigen::MatrixXd full{a};
  full.diagonal().array() += shift;
  return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>{full}.info() == Eigen::Success;
}

/// The least eigenvalue that Lanczos finds from `start`.
double least_ritz_value(const SparseMatrix& a, const Vector& start) {
  Vector q = start.normalized(), before = Vector::Zero(a.rows());
  std::vector<double> alpha, beta;
  while (static_cast<Index>(alpha.size()) < std::min(kLanczosSteps, a.rows())) {
    Vector next = a * q;
    if (!beta.empty()) next -= beta.back() * before;
    alpha.push_back(q.dot(next));
    next -= alpha.back() * q;
    const double length = next.norm();
    if (!(length > kPivotRounding)) break;  // the numbers of `a` are at most 1: an invariant subspace
    beta.push_back(length);
    before.swap(q);
    q = next / length;
  }
  const auto n = static_cast<Index>(alpha.size());
  const Vector diagonal = Eigen::Map<const Vector>(alpha.data(), n);
  const Vector beside = Eigen::Map<const Vector>(beta.data(), n - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> tridiagonal;
  tridiagonal.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  return tridiagonal.eigenvalues().minCoeff();
}

Vector any_vector(Index rows) {
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
  Vector out(rows);
  for (double& x : out) x = normal(random);
  return out;
}

/// The first k whose pivot is not above `least`(k); below zero when there is none.
template <class Least>
Index first_low_pivot(const Vector& pivots, const Least& least) {
  // A zero ends the factorisation: nothing behind it counts.
  for (Index k = 0; k < pivots.size(); ++k) {
    if (!(pivots[k] > least(k))) return k;
  }
  return -1;
}

}  // namespace

SparseMatrix symmetric_part(const SparseMatrix& a) {
  const SparseMatrix transposed = a.transpose();
  return 0.5 * a + 0.5 * transposed;
}

double asymmetry(const SparseMatrix& a) {
  const SparseMatrix transposed = a.transpose();
  const double scale = largest_number(a);
  return scale > 0.0 ? largest_number(a - transposed) / scale : 0.0;
}

std::optional<Indefinite> find_indefinite(const SparseMatrix& a) {
  const double scale = largest_number(a);
  if (scale == 0.0) return {};
  SparseMatrix unit = a;
  unit.coeffs() /= scale;
  const double diagonal = std::max(0.0, Vector{unit.diagonal()}.maxCoeff()), shift = kSemidefinite * diagonal;
  Vector start = any_vector(a.rows());
  bool shown = diagonal == 0.0;  // and some number beside it
  Effort effort;
  if (!shown && a.rows() <= kMostRows) {
    effort = effort_of(unit);
    if (is_better_dense(effort, a.rows())) {
      if (has_dense_factor(unit, shift)) return {};
      shown = true;
    }
  }
  const bool has_room = effort.numbers <= kMostFill && effort.products <= kMostProducts;
  if (diagonal > 0.0 && a.rows() <= kMostRows && has_room) {
    Eigen::SimplicialLDLT<SparseMatrix> factor;
    factor.setShift(shift);
    factor.compute(unit);
    const Index k = first_low_pivot(factor.vectorD(), [](Index) { return 0.0; });
    if (k < 0) return {};
    shown = true;
    if (factor.info() == Eigen::Success) {
      const Vector x = factor.permutationPinv() * Vector{factor.matrixU().solve(Vector::Unit(a.rows(), k))};
      if (x.allFinite()) start = x;
    }
  }
  const double least = least_ritz_value(unit, start);
  if (!shown && least >= -shift) return {};
  return Indefinite{scale * std::min(least, -shift), scale * diagonal};
}

std::optional<BadPivot> find_bad_pivot(const SparseMatrix& a) {
  const Eigen::SimplicialLDLT<SparseMatrix> factor{a};
  const Vector diagonal = a.diagonal();
  const auto row_of = [&](Index k) { return Index{factor.permutationPinv().indices()[k]}; };
  const auto least = [&](Index at) { return std::max(0.0, kPivotRounding * diagonal[row_of(at)]); };
  const Vector pivots = factor.vectorD();  // a copy, whoever asks
  const Index k = first_low_pivot(pivots, least);
  if (k < 0) return {};
  return BadPivot{row_of(k), pivots[k]};
}

}  // namespace scree
