#include "scree/ccp/direct/direct_system.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scree/ccp/block_cone.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::direct {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
constexpr int kBody = static_cast<int>(kBodySize), kMost = static_cast<int>(CcpBlock::kMostRows);

using Six = Eigen::Matrix<double, kBody, Eigen::Dynamic, Eigen::ColMajor, kBody, kMost>;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;
using Columns = Eigen::Map<const Eigen::MatrixXd>;
using Added = Eigen::Map<Eigen::MatrixXd>;
using ByRows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Symmetric root F of a positive semi-definite J: J = F F.
Mat3 root_of(const Mat3& j) {
  const Mat3& a = j;
  Eigen::Matrix3d m;
  m << a.row0.x, a.row1.x, a.row2.x, a.row1.x, a.row1.y, a.row2.y, a.row2.x, a.row2.y, a.row2.z;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(m);
  const Eigen::Vector3d root = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix3d f = eigen.eigenvectors() * root.asDiagonal() * eigen.eigenvectors().transpose();
  return {{f(0, 0), f(0, 1), f(0, 2)}, {f(1, 0), f(1, 1), f(1, 2)}, {f(2, 0), f(2, 1), f(2, 2)}};
}

bool is_zero(const Mat3& m) { return m == Mat3{}; }

CcpRow contact_row(const CcpContact& c, const Vec3& axis) {
  return {{-axis, -cross(c.arm_a, axis)}, {axis, cross(c.arm_b, axis)}};
}

}  // namespace

void DirectSystem::bind(const CcpProblem& problem) {
  problem_ = &problem;
  units_.clear();
  for (const CcpContact& contact : problem.contacts) {
    units_.push_back(block_of(contact));
    units_.back().first_row = static_cast<std::uint32_t>(3 * (units_.size() - 1));
  }
  for (const CcpBlock& block : problem.blocks) {
    units_.push_back(block);
    units_.back().first_row += static_cast<std::uint32_t>(problem.contact_rows());
  }
  block_at_.assign(1, 0);
  for (const CcpBlock& unit : units_) block_at_.push_back(block_at_.back() + std::size_t{unit.rows} * unit.rows);
  diagonal_.assign(problem.rows(), 0.0);
  if (problem.matrix.empty()) {
    bind_bodies();
  } else {
    bind_matrix();
  }
  c_.resize(block_at_.back());
  work_.resize(std::max(problem.rows(), state_size_));
  regularised_.resize(problem.rows());
}

void DirectSystem::make_roots() {
  node_.assign(problem_->bodies(), kNone);
  roots_.clear();
  for (std::size_t k = 0; k < problem_->bodies(); ++k) {
    if (problem_->inverse_mass[k] == 0.0 && is_zero(problem_->inverse_inertia[k])) continue;
    node_[k] = static_cast<std::uint32_t>(roots_.size());
    roots_.push_back({std::sqrt(problem_->inverse_mass[k]), root_of(problem_->inverse_inertia[k])});
  }
}

// Rows of A of one unit: those of the Jacobian times the roots of the inverse masses.
void DirectSystem::make_rows(std::size_t unit, const CcpRow* jacobian) {
  const CcpBlock& u = units_[unit];
  Ends& ends = ends_[unit];
  ends = {node_[u.a], u.a == u.b ? kNone : node_[u.b], kNone};
  const auto scaled = [](const BodyRoot& root, const Twist& row) {
    const Vec3 linear = root.linear * row.linear, angular = root.angular * row.angular;
    return std::array{linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
  };
  for (std::size_t i = 0; i < u.rows; ++i) {
    Row& row = rows_[u.first_row + i];
    row = {};
    Twist a = jacobian[i].a;
    if (u.a == u.b) a += jacobian[i].b;
    if (ends.a != kNone) std::ranges::copy(scaled(roots_[ends.a], a), row.begin());
    if (ends.b != kNone) std::ranges::copy(scaled(roots_[ends.b], jacobian[i].b), row.begin() + kBody);
    diagonal_[u.first_row + i] = std::inner_product(row.begin(), row.end(), row.begin(), 0.0);
  }
}

void DirectSystem::bind_bodies() {
  make_roots();
  rows_.resize(problem_->rows());
  ends_.resize(units_.size());
  for (std::size_t i = 0; i < problem_->contacts.size(); ++i) {
    const CcpContact& c = problem_->contacts[i];
    const ContactFrame f = contact_frame(c.normal);
    const std::array rows{contact_row(c, f.normal), contact_row(c, f.tangent1), contact_row(c, f.tangent2)};
    make_rows(i, rows.data());
  }
  for (std::size_t i = 0; i < problem_->blocks.size(); ++i) {
    make_rows(problem_->contacts.size() + i, problem_->block_rows.data() + problem_->blocks[i].first_row);
  }
  std::vector<Edge> edges;
  const auto edge_of = [](const Ends& e) { return Edge{std::min(e.a, e.b), std::max(e.a, e.b)}; };
  for (const Ends& e : ends_) {
    if (e.a != kNone && e.b != kNone) edges.push_back(edge_of(e));
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (Ends& e : ends_) {
    if (e.a == kNone || e.b == kNone) continue;
    e.edge = static_cast<std::uint32_t>(std::ranges::lower_bound(edges, edge_of(e)) - edges.begin());
  }
  cholesky_.analyse(std::vector<std::uint32_t>(roots_.size(), kBody), edges);
  state_size_ = kBodySize * roots_.size();
}

void DirectSystem::bind_matrix() {
  const CcpMatrix& n = problem_->matrix;
  std::vector<std::uint32_t> size;
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < units_.size(); ++i) {
    size.push_back(units_[i].rows);
    for (std::uint32_t k = n.first[i]; k < n.first[i + 1]; ++k) {
      if (n.column[k] < i) edges.push_back({n.column[k], i});
      for (std::size_t row = 0; n.column[k] == i && row < units_[i].rows; ++row) {
        diagonal_[units_[i].first_row + row] = n.values[n.value[k] + row * (units_[i].rows + 1)];
      }
    }
  }
  cholesky_.analyse(size, edges);
  state_size_ = problem_->rows();
}

void DirectSystem::state_of(std::span<const double> gamma, std::span<double> z) const {
  if (!problem_->matrix.empty()) {
    std::ranges::copy(gamma, z.begin());
    return;
  }
  std::ranges::fill(z, 0.0);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    for (std::size_t row = units_[i].first_row; row < units_[i].first_row + units_[i].rows; ++row) {
      const auto add = [&](std::uint32_t node, const double* numbers) {
        if (node == kNone) return;
        for (std::size_t k = 0; k < kBodySize; ++k) z[kBodySize * node + k] += gamma[row] * numbers[k];
      };
      add(ends_[i].a, rows_[row].data());
      add(ends_[i].b, rows_[row].data() + kBodySize);
    }
  }
}

void DirectSystem::multiply_matrix(std::span<const double> x, std::span<double> out) const {
  const CcpMatrix& n = problem_->matrix;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    double* const sum = out.data() + units_[i].first_row;
    std::fill_n(sum, units_[i].rows, 0.0);
    for (std::uint32_t k = n.first[i]; k < n.first[i + 1]; ++k) {
      const CcpBlock& column = units_[n.column[k]];
      const double* value = n.values.data() + n.value[k];
      for (std::size_t row = 0; row < units_[i].rows; ++row) {
        for (std::size_t c = 0; c < column.rows; ++c) sum[row] += *value++ * x[column.first_row + c];
      }
    }
  }
}

void DirectSystem::velocities(std::span<const double> z, std::span<double> out) const {
  if (!problem_->matrix.empty()) return multiply_matrix(z, out);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    for (std::size_t row = units_[i].first_row; row < units_[i].first_row + units_[i].rows; ++row) {
      const auto product = [&](std::uint32_t node, const double* numbers) {
        double sum = 0.0;
        for (std::size_t k = 0; node != kNone && k < kBodySize; ++k) sum += z[kBodySize * node + k] * numbers[k];
        return sum;
      };
      out[row] = product(ends_[i].a, rows_[row].data()) + product(ends_[i].b, rows_[row].data() + kBodySize);
    }
  }
}

double DirectSystem::inner(std::span<const double> a, std::span<const double> b,
                           std::span<const double> velocities_of_b) const {
  const std::span<const double> other = problem_->matrix.empty() ? b : velocities_of_b;
  return std::inner_product(a.begin(), a.end(), other.begin(), 0.0);
}

void DirectSystem::factor_bodies() {
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    for (std::size_t i = 0; i < kBodySize; ++i) cholesky_.diagonal(k)[i * (kBodySize + 1)] = 1.0;
  }
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const int rows = units_[i].rows;
    const Columns c(c_.data() + block_at_[i], rows, rows);
    const Eigen::Map<const Eigen::Matrix<double, 2 * kBody, Eigen::Dynamic>> a(rows_[units_[i].first_row].data(),
                                                                               2 * kBody, rows);
    const Ends& ends = ends_[i];
    Six on_a, on_b;
    if (ends.a != kNone) {
      on_a = a.topRows<kBody>().lazyProduct(c);
      Added(cholesky_.diagonal(ends.a).data(), kBody, kBody) += on_a.lazyProduct(on_a.transpose());
    }
    if (ends.b == kNone) continue;
    on_b = a.bottomRows<kBody>().lazyProduct(c);
    Added(cholesky_.diagonal(ends.b).data(), kBody, kBody) += on_b.lazyProduct(on_b.transpose());
    if (ends.a == kNone) continue;
    const Six& rows_of = ends.a < ends.b ? on_b : on_a;  // the edge has its greater node as rows
    const Six& columns_of = ends.a < ends.b ? on_a : on_b;
    Added(cholesky_.off_diagonal(ends.edge).data(), kBody, kBody) += rows_of.lazyProduct(columns_of.transpose());
  }
}

void DirectSystem::factor_matrix() {
  const CcpMatrix& n = problem_->matrix;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const int rows = units_[i].rows;
    const Columns c(c_.data() + block_at_[i], rows, rows);
    Added own(cholesky_.diagonal(i).data(), rows, rows);
    own.setIdentity();
    for (std::uint32_t k = n.first[i]; k < n.first[i + 1] && n.column[k] <= i; ++k) {
      const int columns = units_[n.column[k]].rows;
      const Columns other(c_.data() + block_at_[n.column[k]], columns, columns);
      const Small half = c.transpose().lazyProduct(ByRows(n.values.data() + n.value[k], rows, columns));
      if (n.column[k] == i) {
        own += half.lazyProduct(c);
      } else {
        Added(cholesky_.off_diagonal(edge++).data(), rows, columns) += half.lazyProduct(other);
      }
    }
  }
}

bool DirectSystem::factor(std::span<const double> c) {
  std::ranges::copy(c, c_.begin());
  cholesky_.clear();
  if (problem_->matrix.empty()) {
    factor_bodies();
  } else {
    factor_matrix();
  }
  return cholesky_.factor();
}

void DirectSystem::multiply_root(std::span<const double> x, bool transposed, std::span<double> out) const {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const std::size_t n = units_[i].rows;
    const double* const c = c_.data() + block_at_[i];
    const double* const from = x.data() + units_[i].first_row;
    double* const to = out.data() + units_[i].first_row;
    for (std::size_t row = 0; row < n; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += (transposed ? c[row * n + k] : c[k * n + row]) * from[k];
      to[row] = sum;
    }
  }
}

void DirectSystem::newton_direction(std::span<const double> q, std::span<double> d) {
  if (problem_->matrix.empty()) {
    for (std::size_t k = 0; k < q.size(); ++k) d[k] = -q[k];
    cholesky_.solve(d);
    return;
  }
  // (I + B N) d = -q: with d = C y - q, (I + C^T N C) y = C^T N q.
  multiply_matrix(q, d);
  multiply_root(d, true, work_);
  cholesky_.solve(work_);
  multiply_root(work_, false, d);
  for (std::size_t k = 0; k < q.size(); ++k) d[k] -= q[k];
}

void DirectSystem::solve_regularised(std::span<const double> b, std::span<double> x) {
  if (!problem_->matrix.empty()) {
    multiply_root(b, true, work_);
    cholesky_.solve(work_);
    multiply_root(work_, false, x);
    return;
  }
  // x = B (b - A H^-1 A^T B b).
  const std::span<double> z{work_.data(), state_size_};
  multiply_root(b, true, x);
  multiply_root(x, false, regularised_);
  state_of(regularised_, z);
  cholesky_.solve(z);
  velocities(z, x);
  for (std::size_t k = 0; k < b.size(); ++k) x[k] = b[k] - x[k];
  multiply_root(x, true, regularised_);
  multiply_root(regularised_, false, x);
}

}  // namespace scree::direct
