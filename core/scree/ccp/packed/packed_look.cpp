// Passes that change nothing: the residual of impulses, and their sums.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/packed/packed_problem.hpp"

namespace scree::packed {

double PackedProblem::block_residual(std::size_t block, std::span<const double> x, std::span<const double> u) const {
  const CcpProblem& p = problem();
  const CcpBlock& b = p.blocks[block];
  const double trace = delassus_->traces()[p.contacts.size() + block];
  if (!(trace > 0.0)) return 0.0;
  const double s = b.rows / trace;
  BlockVector z{};
  for (std::size_t k = 0; k < b.rows; ++k) z[k] = x[k] - s * u[k];
  project_block(b, std::span{z}.first(b.rows));
  double sum = 0.0;
  for (std::size_t k = 0; k < b.rows; ++k) sum += (x[k] - z[k]) * (x[k] - z[k]);
  const double error = std::sqrt(sum) / s;
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

Look PackedProblem::look_at(const Run& run, const Impulses& x, std::span<const double> product) const {
  const CcpProblem& p = problem();
  Look look;
  Lanes linear{};
  for (std::size_t at = run.first_group; at < run.last_group; ++at) {
    if (at + kAhead < run.last_group) prefetch(groups_[at + kAhead], slots());
    Lanes3 u = contact_velocity(groups_[at], slots());
    if (compliant()) u = u + comply(groups_[at], compliance_[at], x.contacts[at]);
    look.residual = std::max(look.residual, group_residual(at, x.contacts[at], u));
    linear += dot(groups_[at].r, x.contacts[at]);
  }
  look.linear = total(linear);
  for (std::size_t block = run.first_block; block < run.last_block; ++block) {
    const std::size_t row = p.blocks[block].first_row, rows = p.blocks[block].rows;
    const std::span<const double> g = std::span{x.rows}.subspan(row, rows);
    BlockVector u{};
    if (has_matrix()) {
      for (std::size_t k = 0; k < rows; ++k) u[k] = product[row + k] + p.r[row + k];
    } else {
      block_velocity(block, g, std::span{u}.first(rows));
    }
    look.residual = std::max(look.residual, block_residual(block, g, std::span{u}.first(rows)));
    for (std::size_t k = 0; k < rows; ++k) look.linear += p.r[p.contact_rows() + row + k] * g[k];
  }
  return look;
}

Look PackedProblem::look(const Impulses& x, std::span<const double> product) {
  for_runs([&](const Run& run) { looks_[run.index] = look_at(run, x, product); });
  Look all;
  for (const Look& look : looks_) {
    all.residual = std::max(all.residual, look.residual);
    all.linear += look.linear;
  }
  return all;
}

double PackedProblem::compliance(const Impulses& x) const {
  if (!compliant()) return 0.0;
  Lanes sum{};
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    sum += dot(x.contacts[at], comply(groups_[at], compliance_[at], x.contacts[at]));
  }
  double blocks = 0.0;
  for (std::size_t k = 0; k < problem().blocks.size(); ++k) {
    blocks += block_compliance(k, std::span{x.rows}.subspan(problem().blocks[k].first_row, problem().blocks[k].rows));
  }
  return total(sum) + blocks;
}

void PackedProblem::load(const Impulses& x) {
  if (has_matrix()) return;
  for_runs([&](const Run& run) {
    for (std::size_t at = run.first_group; at < run.last_group; ++at) {
      packed::add_impulse(groups_[at], x.contacts[at], slots());
    }
    for (std::size_t k = run.first_block; k < run.last_block; ++k) {
      add_impulse(k, std::span{x.rows}.subspan(problem().blocks[k].first_row, problem().blocks[k].rows));
    }
  });
}

}  // namespace scree::packed
