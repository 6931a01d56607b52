#include "scree/ccp/fclib/fclib_ccp.hpp"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <utility>

#include "scree/base/error.hpp"

namespace scree {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// An FCLIB problem says nothing of when to stop.
constexpr double kTolerance = 1e-8;  // [m/s]
constexpr int kMaxIterations = 100'000;
/// Asymmetry [1] that is not a mistake: gyroscopic terms of spinning bodies in an implicit scheme.
constexpr double kMostAsymmetry = 0.1;
constexpr double kRounding = 1e-13;

Eigen::Index index(std::size_t value) { return static_cast<Eigen::Index>(value); }

Sparse to_eigen(const FclibMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(matrix.entries.size());
  for (const MatrixEntry& e : matrix.entries) triplets.emplace_back(e.row, e.column, e.value);
  Sparse out(index(matrix.rows), index(matrix.columns));
  out.setFromTriplets(triplets.begin(), triplets.end());
  return out;
}

Vector to_eigen(std::span<const double> values) {
  return Eigen::Map<const Vector>(values.data(), index(values.size()));
}

std::vector<double> to_vector(const Vector& values) { return {values.data(), values.data() + values.size()}; }

/// M^-1: Cholesky where M is symmetric, else LU.
class MassSolver {
 public:
  MassSolver(const Sparse& mass, const std::string& file) {
    const auto fail = [&](const char* what) {
      throw Error{ErrorKind::io, file + ": /fclib_global/M is " + what + "; a mass matrix is positive definite"};
    };
    const Sparse transposed = mass.transpose();
    const double scale = mass.nonZeros() > 0 ? mass.coeffs().cwiseAbs().maxCoeff() : 0.0;
    symmetric_ = (mass - transposed).norm() <= kRounding * scale;
    if (symmetric_) {
      cholesky_.compute(mass);
      if (cholesky_.info() != Eigen::Success) fail("singular");
      if (mass.rows() > 0 && !(cholesky_.vectorD().minCoeff() > 0.0)) fail("not positive definite");
    } else {
      lu_.compute(mass);
      if (lu_.info() != Eigen::Success) fail("singular");
    }
  }
  template <class Right>
  [[nodiscard]] Right solve(const Right& right) const {
    return symmetric_ ? Right{cholesky_.solve(right)} : Right{lu_.solve(right)};
  }

 private:
  bool symmetric_ = true;
  Eigen::SimplicialLDLT<Sparse> cholesky_;
  Eigen::SparseLU<Sparse> lu_;
};

/// Columns of `a`, then those of `b`.
Sparse side_by_side(const Sparse& a, const Sparse& b) {
  Sparse out(a.rows(), a.cols() + b.cols());
  out.leftCols(a.cols()) = a;
  if (b.cols() > 0) out.rightCols(b.cols()) = b;
  return out;
}

std::vector<MatrixEntry> entries_of(const Sparse& matrix) {
  std::vector<MatrixEntry> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
    for (Sparse::InnerIterator e(matrix, k); e; ++e) {
      entries.push_back({static_cast<std::uint32_t>(e.row()), static_cast<std::uint32_t>(e.col()), e.value()});
    }
  }
  return entries;
}

/// [W V; V^T R]
std::vector<MatrixEntry> entries_of(const FclibLocal& local) {
  std::vector<MatrixEntry> entries = local.W.entries;
  const auto m = static_cast<std::uint32_t>(local.W.rows);
  for (const MatrixEntry& e : local.V.entries) {
    entries.push_back({e.row, m + e.column, e.value});
    entries.push_back({m + e.column, e.row, e.value});
  }
  for (const MatrixEntry& e : local.R.entries) entries.push_back({m + e.row, m + e.column, e.value});
  return entries;
}

}  // namespace

struct FclibCcp::Reduction {
  FclibProblem source;
  CcpRecord record;
  std::vector<std::uint32_t> row_of;  ///< row of the record for every row of FCLIB, contacts, then constraints
  std::vector<double> r;              ///< r of FCLIB's rows
  Sparse matrix;                      ///< N of FCLIB's rows
  // Of a global problem:
  std::unique_ptr<MassSolver> mass;
  Sparse jacobian;     ///< [H G]
  Vector free_motion;  ///< M^-1 f

  void make_blocks();
  void reduce(const std::string& file);
  void make_record(const std::string& file);
};

void FclibCcp::Reduction::make_blocks() {
  const std::size_t each = source.rows_per_contact();
  const bool rolling = !source.rolling.empty();
  std::uint32_t row = 0;
  const auto add = [&](CcpBlock block) {
    block.first_row = row;
    record.blocks.push_back(block);
    row += block.rows;
  };
  for (std::size_t c = 0; c < source.contacts(); ++c) {
    const bool plane_rolling = rolling && each == 3;
    for (std::uint32_t k = 0; k < each; ++k) row_of.push_back(row + (plane_rolling && k == 2 ? 3 : k));
    add({.kind = CcpKind::cone,
         .rows = static_cast<std::uint8_t>(rolling ? 5 : each),
         .friction = source.mu[c],
         .rolling = rolling ? source.rolling[c] : 0.0});
  }
  for (std::size_t k = 0; k < source.bilateral_rows(); ++k) {
    row_of.push_back(row);
    add({.kind = CcpKind::free, .rows = 1});
  }
}

void FclibCcp::Reduction::reduce(const std::string& file) {
  if (const auto* local = std::get_if<FclibLocal>(&source.form)) {
    r = local->q;
    r.insert(r.end(), local->s.begin(), local->s.end());
    matrix = to_eigen(FclibMatrix{.rows = r.size(), .columns = r.size(), .entries = entries_of(*local)});
    return;
  }
  const auto& global = std::get<FclibGlobal>(source.form);
  mass = std::make_unique<MassSolver>(to_eigen(global.M), file);
  Sparse bilateral(index(global.M.rows), 0);
  if (global.G.columns > 0) bilateral = to_eigen(global.G);
  jacobian = side_by_side(to_eigen(global.H), bilateral);
  free_motion = mass->solve(to_eigen(global.f));
  matrix = jacobian.transpose() * mass->solve(jacobian);
  std::vector<double> constants = global.w;
  constants.insert(constants.end(), global.b.begin(), global.b.end());
  r = to_vector(to_eigen(constants) + jacobian.transpose() * free_motion);
}

void FclibCcp::Reduction::make_record(const std::string& file) {
  std::vector<MatrixEntry> entries = entries_of(matrix);
  for (MatrixEntry& e : entries) e = {row_of[e.row], row_of[e.column], e.value};
  record.matrix = make_matrix(record.blocks, entries);
  record.r.assign(record.problem().rows(), 0.0);
  for (std::size_t k = 0; k < r.size(); ++k) record.r[row_of[k]] = r[k];
  const double skew = asymmetry(record.matrix.view(), record.blocks);
  if (skew > kMostAsymmetry) {
    throw Error{ErrorKind::io,
                fmt::format("{}: /{} is not symmetric: numbers that should be the same differ by {:.2g} of the "
                            "largest; a contact problem has a symmetric one",
                            file, source.global() ? "fclib_global/M" : "fclib_local/W", skew)};
  }
  record.origin.tolerance = kTolerance;
  record.origin.max_iterations = kMaxIterations;
}

FclibCcp::FclibCcp(FclibProblem problem, const std::string& file) : reduction_{std::make_unique<Reduction>()} {
  reduction_->source = std::move(problem);
  reduction_->make_blocks();
  reduction_->reduce(file);
  reduction_->make_record(file);
  const auto& guesses = reduction_->source.guesses;
  reduction_->record.guess =
      guesses.empty() ? std::vector<double>(reduction_->record.r.size(), 0.0) : impulses(guesses[0]);
}
FclibCcp::~FclibCcp() = default;
FclibCcp::FclibCcp(FclibCcp&&) noexcept = default;
FclibCcp& FclibCcp::operator=(FclibCcp&&) noexcept = default;

const FclibProblem& FclibCcp::source() const { return reduction_->source; }
const CcpRecord& FclibCcp::record() const { return reduction_->record; }

std::vector<double> FclibCcp::impulses(const FclibSolution& solution) const {
  const Reduction& d = *reduction_;
  const std::size_t m = d.source.contact_rows();
  std::vector<double> gamma(d.record.r.size(), 0.0);
  for (std::size_t k = 0; k < solution.r.size(); ++k) gamma[d.row_of[k]] = solution.r[k];
  for (std::size_t k = 0; k < solution.lambda.size(); ++k) gamma[d.row_of[m + k]] = solution.lambda[k];
  return gamma;
}

FclibSolution FclibCcp::solution(std::span<const double> gamma) const {
  const Reduction& d = *reduction_;
  Vector g(index(d.row_of.size()));
  for (std::size_t k = 0; k < d.row_of.size(); ++k) g[index(k)] = gamma[d.row_of[k]];
  const Vector u = d.matrix * g + to_eigen(d.r);
  const Eigen::Index m = index(d.source.contact_rows());
  FclibSolution out;
  out.r = to_vector(g.head(m));
  out.u = to_vector(u.head(m));
  out.lambda = to_vector(g.tail(g.size() - m));
  if (d.mass) out.v = to_vector(d.free_motion + d.mass->solve(Vector{d.jacobian * g}));
  return out;
}

}  // namespace scree
