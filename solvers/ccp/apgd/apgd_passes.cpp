// The passes of apgd over units and bodies.
#include <algorithm>
#include <cmath>

#include "apgd.hpp"
#include "scree/ccp/block_rows.hpp"

namespace scree {

namespace {

packed::Twists beyond(const packed::Twists& p, const packed::Twists& old, double beta) {
  return p + packed::all(beta) * (p - old);
}

}  // namespace

// Body sums of the guess: those of a pass that ends there.
void Apgd::start() {
  packed_.load(x_);
  Sums sums;
  if (packed_.has_matrix()) {
    delassus_.row_velocities({}, x_.rows, product_);
    product_old_ = product_;
    for (std::size_t i = 0; i < product_.size(); ++i) sums.quadratic += x_.rows[i] * product_[i];
    spread_ = -1.0;
  } else {
    sums = body_pass(0.0);
    p_.swap(p_old_);
    p_old_ = p_;
    spread_ = 0.0;
    if (packed_.compliant()) sums.quadratic += packed_.compliance(x_);
  }
  quadratic_ = sums.quadratic;
}

// Velocities of the y of that beta: of each body for its slots, or N y.
void Apgd::move_to(double beta) {
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) {
      packed::spread(packed::times(packed_.body_group(at), beyond(p_[at], p_old_[at], beta)), packed_.first_slots(at),
                     packed_.slots());
    }
  });
  for (std::size_t i = 0; i < product_.size(); ++i) {
    y_[i] = x_.rows[i] + beta * (x_.rows[i] - x_old_.rows[i]);
    product_y_[i] = product_[i] + beta * (product_[i] - product_old_[i]);
  }
  spread_ = beta;
}

template <bool compliant>
Apgd::Sums Apgd::contact_range(const packed::Run& run) {
  apgd::LaneSums sums;
  packed::Slot* const slots = packed_.slots();
  const double beta = beta_, step = step_;
  for (std::size_t at = run.first_group; at < run.last_group; ++at) {
    if (at + packed::kAhead < run.last_group) packed::prefetch(packed_.group(at + packed::kAhead), slots);
    x_old_.contacts[at] = apgd::step<compliant>(packed_.group(at), compliant ? &packed_.compliance(at) : nullptr,
                                                x_.contacts[at], x_old_.contacts[at], beta, step, slots, sums);
  }
  return sums.total();
}

// u of a block at y.
void Apgd::block_gradient(std::size_t block, std::span<const double> y, std::span<double> u) const {
  const CcpProblem& problem = packed_.problem();
  if (!packed_.has_matrix()) return packed_.block_velocity(block, y, u);
  const std::size_t row = problem.blocks[block].first_row;
  for (std::size_t k = 0; k < y.size(); ++k) u[k] = product_y_[row + k] + problem.r[row + k];
}

// The step of the contacts, for the blocks.
Apgd::Sums Apgd::block_range(const packed::Run& run) {
  const CcpProblem& problem = packed_.problem();
  Sums sums;
  for (std::size_t block = run.first_block; block < run.last_block; ++block) {
    const CcpBlock& b = problem.blocks[block];
    const double* const x = x_.rows.data() + b.first_row;
    double* const x_old = x_old_.rows.data() + b.first_row;
    const std::span<const double> mass = packed_.block_masses(block);
    BlockVector y{}, u{}, next{}, d{};
    for (std::size_t k = 0; k < b.rows; ++k) y[k] = x[k] + beta_ * (x[k] - x_old[k]);
    block_gradient(block, std::span{y}.first(b.rows), std::span{u}.first(b.rows));
    for (std::size_t k = 0; k < b.rows; ++k) next[k] = y[k] - step_ * mass[k] * u[k];
    packed_.project(block, std::span{next}.first(b.rows));
    for (std::size_t k = 0; k < b.rows; ++k) {
      d[k] = next[k] - y[k];
      if (mass[k] > 0.0) {
        sums.distance += d[k] * d[k] / mass[k];
        sums.onward += d[k] * (y[k] - x[k]) / mass[k];
      }
      x_old[k] = next[k];
    }
    if (packed_.has_matrix()) continue;
    packed_.add_impulse(block, std::span{next}.first(b.rows));
    sums.curvature += packed_.block_compliance(block, std::span{d}.first(b.rows));
    sums.quadratic += packed_.block_compliance(block, std::span{next}.first(b.rows));
  }
  return sums;
}

// x_new, in place of x_old_, from x_, x_old_ and the velocities of y.
Apgd::Sums Apgd::unit_pass() {
  packed_.for_runs([&](const packed::Run& run) {
    Sums sums = packed_.compliant() ? contact_range<true>(run) : contact_range<false>(run);
    if (run.last_block > run.first_block) sums += block_range(run);
    partial_[run.index] = sums;
  });
  Sums sums;
  for (std::size_t k = 0; k < packed_.runs(); ++k) sums += partial_[k];
  return sums;
}

// Body sums of x_new, in place of p_old_; their part of the quadratic forms; and the velocities of the y that follows when
// the step is accepted and the momentum kept.
Apgd::Sums Apgd::body_pass(double beta_next) {
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    apgd::LaneSums sums;
    for (std::size_t at = first; at < last; ++at) {
      const packed::BodyGroup& inverse = packed_.body_group(at);
      const std::uint32_t* const slots = packed_.first_slots(at);
      const packed::Twists sum = packed::take_sums(packed_.slots(), slots), p = p_[at];
      const packed::Twists d = sum - beyond(p, p_old_[at], beta_);
      sums.quadratic += packed::dot(sum, packed::times(inverse, sum));
      sums.curvature += packed::dot(d, packed::times(inverse, d));
      packed::spread(packed::times(inverse, beyond(sum, p, beta_next)), slots, packed_.slots());
      p_old_[at] = sum;
    }
    partial_[packed::PackedProblem::chunk_of_group(first)] = sums.total();
  });
  packed_.clear_sinks();
  Sums sums;
  for (std::size_t k = 0; k < packed_.body_chunks(); ++k) sums += partial_[k];
  return sums;
}

// N x_new, in place of product_old_, and the quadratic forms.
Apgd::Sums Apgd::matrix_pass() {
  delassus_.row_velocities({}, x_old_.rows, product_old_);
  Sums sums;
  for (std::size_t i = 0; i < product_.size(); ++i) {
    const double next = x_old_.rows[i];
    sums.quadratic += next * product_old_[i];
    sums.curvature += (next - y_[i]) * (product_old_[i] - product_y_[i]);
  }
  return sums;
}

// ccp_residual() of x_, and its part of the objective.
double Apgd::residual() {
  if (spread_ != 0.0) move_to(0.0);
  const packed::Look look = packed_.look(x_, product_);
  linear_ = look.linear;
  return look.residual;
}

}  // namespace scree
