#include "scree/ccp/sweep/block_sweep.hpp"

#include <algorithm>

#include "scree/ccp/delassus.hpp"

namespace scree {
namespace {

Vec3 first_three(const Lanes& lanes) { return {lanes[0], lanes[1], lanes[2]}; }

Twist twist_of(const sweep::Body& body) { return {first_three(body.linear), first_three(body.angular)}; }

}  // namespace

void BlockSweep::bind(const CcpProblem& problem, ContactSweep& contacts, const sweep::StepSettings& settings) {
  problem_ = problem;
  contacts_ = &contacts;
  steps_.bind(problem_, settings);
  const std::size_t rows = problem.rows() - problem.contact_rows();
  r_ = problem.r.subspan(problem.contact_rows(), rows);
  compliance_ =
      problem.compliance.empty() ? problem.compliance : problem.compliance.subspan(problem.contact_rows(), rows);
  g_.resize(rows);
  v_.resize(problem.matrix.empty() ? 0 : rows);
  if (!problem.matrix.empty()) bind_columns();
  cones_.bind(problem_, contacts, steps_, singles_);
}

void BlockSweep::set_impulses(std::span<const double> gamma) {
  std::copy(gamma.begin() + static_cast<std::ptrdiff_t>(problem_.contact_rows()), gamma.end(), g_.begin());
  std::fill(v_.begin(), v_.end(), 0.0);
  if (v_.empty()) return;
  for (std::size_t k = 0; k < problem_.blocks.size(); ++k) {
    add_to_rows(k, std::span<const double>{g_}.subspan(problem_.blocks[k].first_row, problem_.blocks[k].rows));
  }
}

void BlockSweep::impulses(std::span<double> gamma) const {
  std::copy(g_.begin(), g_.end(), gamma.begin() + static_cast<std::ptrdiff_t>(problem_.contact_rows()));
}

void BlockSweep::sweep(bool backward) {
  const std::size_t alone = singles_.size();
  for (std::size_t k = 0; k < alone && !backward; ++k) update(singles_[k]);
  cones_.sweep(backward, steps_, r_, compliance_, g_);
  for (std::size_t k = alone; k > 0 && backward; --k) update(singles_[k - 1]);
}

void BlockSweep::velocity_of(std::size_t k, std::span<double> u) const {
  const CcpBlock& block = problem_.blocks[k];
  const std::size_t first = block.first_row;
  if (v_.empty()) {
    const std::span<const sweep::Body> bodies = contacts_->bodies();
    relative_velocity(jacobian_of(problem_, block), twist_of(bodies[block.a]), twist_of(bodies[block.b]), u);
  } else {
    std::copy_n(v_.begin() + static_cast<std::ptrdiff_t>(first), u.size(), u.begin());
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] += r_[first + i];
    if (!compliance_.empty()) u[i] += compliance_[first + i] * g_[first + i];
  }
}

void BlockSweep::update(std::size_t k) {
  const CcpBlock& block = problem_.blocks[k];
  const std::size_t n = block.rows;
  BlockVector velocity{}, change{};
  const std::span<double> u{velocity.data(), n}, g = std::span<double>{g_}.subspan(block.first_row, n);
  velocity_of(k, u);
  for (std::size_t i = 0; i < n; ++i) change[i] = -g[i];
  steps_.advance(k, u, g);
  for (std::size_t i = 0; i < n; ++i) change[i] += g[i];
  push(k, {change.data(), n});
}

void BlockSweep::push(std::size_t k, std::span<const double> change) {
  if (std::all_of(change.begin(), change.end(), [](double x) { return x == 0.0; })) return;
  v_.empty() ? add_to_bodies(problem_.blocks[k], change) : add_to_rows(k, change);
}

void BlockSweep::add_to_bodies(const CcpBlock& block, std::span<const double> change) {
  Twist on_a, on_b;
  add_impulse(jacobian_of(problem_, block), change, on_a, on_b);
  const auto push = [&](std::uint32_t index, const Twist& impulse) {
    if (!(problem_.inverse_mass[index] > 0.0)) return;  // never written: threads may read it
    sweep::Body& body = contacts_->bodies()[index];
    if (contacts_->isotropic()) {
      const Lanes v{impulse.linear.x, impulse.linear.y, impulse.linear.z, 0.0};
      const Lanes omega{impulse.angular.x, impulse.angular.y, impulse.angular.z, 0.0};
      body.linear += body.linear[3] * v;
      body.angular += body.angular[3] * omega;
      return;
    }
    const Twist w = apply_inverse_mass(problem_, index, impulse);
    body.linear += Lanes{w.linear.x, w.linear.y, w.linear.z, 0.0};
    body.angular += Lanes{w.angular.x, w.angular.y, w.angular.z, 0.0};
  };
  push(block.a, on_a);
  push(block.b, on_b);
}

// Counting sort of the non-zero blocks by column.
void BlockSweep::bind_columns() {
  const CcpMatrix& matrix = problem_.matrix;
  const std::size_t count = problem_.blocks.size();
  column_first_.assign(count + 2, 0);
  column_row_.resize(matrix.column.size());
  column_value_.resize(matrix.column.size());
  // Counted two places further on, so that filling leaves every number where it belongs.
  for (const std::uint32_t j : matrix.column) ++column_first_[j + 2];
  for (std::size_t j = 2; j < column_first_.size(); ++j) column_first_[j] += column_first_[j - 1];
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t at = matrix.first[i]; at < matrix.first[i + 1]; ++at) {
      const std::uint32_t place = column_first_[matrix.column[at] + 1]++;
      column_row_[place] = i;
      column_value_[place] = matrix.value[at];
    }
  }
}

void BlockSweep::add_to_rows(std::size_t k, std::span<const double> change) {
  for (std::uint32_t at = column_first_[k]; at < column_first_[k + 1]; ++at) {
    const CcpBlock& row = problem_.blocks[column_row_[at]];
    const double* const values = problem_.matrix.values.data() + column_value_[at];
    double* const v = v_.data() + row.first_row;
    for (std::size_t i = 0; i < row.rows; ++i) {
      for (std::size_t j = 0; j < change.size(); ++j) v[i] += values[i * change.size() + j] * change[j];
    }
  }
}

}  // namespace scree
