#include "scree/ccp/fclib/fclib_ccp.hpp"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/detail/definite.hpp"

namespace scree {

namespace {

using Sparse = SparseMatrix;
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

[[noreturn]] void fail_asymmetric(const std::string& file, const char* name, double skew) {
  throw Error{
      ErrorKind::io,
      fmt::format("{}: /{} is not symmetric: numbers that should be the same differ by {:.2g} of the largest; a "
                  "contact problem has a symmetric one",
                  file, name, skew)};
}

/// M^-1 of a mass matrix, whose symmetric part has to be positive definite: Cholesky where M is symmetric, else LU.
class MassSolver {
 public:
  MassSolver(const Sparse& mass, const std::string& file) {
    const double skew = asymmetry(mass);
    if (skew > kMostAsymmetry) fail_asymmetric(file, "fclib_global/M", skew);
    if (const auto bad = find_bad_pivot(symmetric_part(mass))) {
      throw Error{
          ErrorKind::io,
          fmt::format("{}: /fclib_global/M is not positive definite: elimination leaves {:.3g} on the diagonal of "
                      "row {}, counted from 0; a mass matrix leaves positive numbers, so mend the masses and "
                      "inertias of that degree of freedom, or take it out",
                      file, bad->pivot, bad->row)};
    }
    symmetric_ = skew <= kRounding;
    if (symmetric_) {
      cholesky_.compute(mass);
    } else {
      lu_.compute(mass);
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
  void require_semidefinite(const FclibLocal& local, const std::string& file) const;
  void make_record();
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
    require_semidefinite(*local, file);
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

// W = H^T M^-1 H and what V and R add to it have no eigenvalue below zero; otherwise an objective has no bottom, and solvers
// follow it down for ever. The N of a global problem needs no look: M has had one.
void FclibCcp::Reduction::require_semidefinite(const FclibLocal& local, const std::string& file) const {
  const double skew = asymmetry(matrix);
  if (skew > kMostAsymmetry) fail_asymmetric(file, "fclib_local/W", skew);
  std::optional<Indefinite> bad = find_indefinite(symmetric_part(matrix));
  if (!bad) return;
  const auto of_w = local.V.columns > 0 ? find_indefinite(symmetric_part(to_eigen(local.W))) : bad;
  const char* const name = of_w ? "/fclib_local/W is" : "/fclib_local/W, V and R make a matrix [W V; V^T R] that is";
  if (of_w) bad = of_w;
  throw Error{
      ErrorKind::io,
      fmt::format("{}: {} not positive semidefinite: an eigenvalue of the symmetric part is {:.3g} or less, and the "
                  "largest number of the diagonal {:.3g}; what masses make has none below zero, so look for rows "
                  "with a wrong sign or of another problem",
                  file, name, bad->eigenvalue, bad->diagonal)};
}

void FclibCcp::Reduction::make_record() {
  std::vector<MatrixEntry> entries = entries_of(matrix);
  for (MatrixEntry& e : entries) e = {row_of[e.row], row_of[e.column], e.value};
  record.matrix = make_matrix(record.blocks, entries);
  record.r.assign(record.problem().rows(), 0.0);
  for (std::size_t k = 0; k < r.size(); ++k) record.r[row_of[k]] = r[k];
  record.origin.tolerance = kTolerance;
  record.origin.max_iterations = kMaxIterations;
}

FclibCcp::FclibCcp(FclibProblem problem, const std::string& file) : reduction_{std::make_unique<Reduction>()} {
  reduction_->source = std::move(problem);
  reduction_->make_blocks();
  reduction_->reduce(file);
  reduction_->make_record();
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
