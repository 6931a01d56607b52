// The passes of spg over units and bodies.
#include <algorithm>

#include "scree/ccp/block_rows.hpp"
#include "spg.hpp"

namespace scree {

template <bool compliant, bool looking>
Spg::Sums Spg::contact_range(const packed::Run& run) {
  spg::LaneSums sums;
  double worst = 0.0;
  packed::Slot* const slots = packed_.slots();
  const Lanes pending = packed::all(pending_);
  const double alpha = alpha_;
  for (std::size_t at = run.first_group; at < run.last_group; ++at) {
    if (at + packed::kAhead < run.last_group) packed::prefetch(packed_.group(at + packed::kAhead), slots);
    const packed::Group& group = packed_.group(at);
    const Lanes3 x = x_.contacts[at] + pending * d_.contacts[at];
    x_.contacts[at] = x;
    Lanes3 u = packed::contact_velocity(group, slots);
    if constexpr (compliant) u = u + packed::comply(group, packed_.compliance(at), x);
    if constexpr (looking) worst = std::max(worst, packed_.group_residual(at, x, u));
    const Lanes3 d = spg::direction(group, x, u, alpha, slots, sums);
    if constexpr (compliant) sums.curvature += dot(d, packed::comply(group, packed_.compliance(at), d));
    d_.contacts[at] = d;
  }
  if constexpr (looking) partial_[run.index] = worst;
  return sums.total();
}

// The same for the blocks.
Spg::Sums Spg::block_range(const packed::Run& run, bool looking) {
  const CcpProblem& problem = packed_.problem();
  const bool matrix = packed_.has_matrix();
  Sums sums;
  for (std::size_t block = run.first_block; block < run.last_block; ++block) {
    const std::size_t row = problem.blocks[block].first_row, rows = problem.blocks[block].rows;
    const std::span<double> x = std::span{x_.rows}.subspan(row, rows), d = std::span{d_.rows}.subspan(row, rows);
    const std::span<const double> mass = packed_.block_masses(block);
    BlockVector u{};
    for (std::size_t k = 0; k < rows; ++k) x[k] += pending_ * d[k];
    if (matrix) {
      for (std::size_t k = 0; k < rows; ++k) {
        product_[row + k] += pending_ * product_d_[row + k];
        u[k] = product_[row + k] + problem.r[row + k];
      }
    } else {
      packed_.block_velocity(block, x, std::span{u}.first(rows));
    }
    if (looking) {
      const double residual = packed_.block_residual(block, x, std::span{u}.first(rows));
      partial_[run.index] = std::max(partial_[run.index], residual);
    }
    for (std::size_t k = 0; k < rows; ++k) d[k] = x[k] - alpha_ * mass[k] * u[k];
    packed_.project(block, d);
    for (std::size_t k = 0; k < rows; ++k) {
      d[k] -= x[k];
      if (!(mass[k] > 0.0)) continue;
      sums.slope += u[k] * d[k];
      sums.distance += d[k] * d[k] / mass[k];
    }
    if (matrix) continue;
    packed_.add_impulse(block, d);
    sums.curvature += packed_.block_compliance(block, d);
  }
  return sums;
}

// Moves x by what is pending; makes d and its sums in the slots from their velocities, which are those of x. On the way
// `residual` becomes that of x, when asked for.
Spg::Sums Spg::unit_pass(double* residual) {
  const bool compliant = packed_.compliant();
  packed_.for_runs([&](const packed::Run& run) {
    Sums& sums = sums_[run.index];
    if (residual != nullptr) {
      sums = compliant ? contact_range<true, true>(run) : contact_range<false, true>(run);
    } else {
      sums = compliant ? contact_range<true, false>(run) : contact_range<false, false>(run);
    }
    if (run.last_block > run.first_block) sums += block_range(run, residual != nullptr);
  });
  Sums sums;
  for (const Sums& s : sums_) sums += s;
  if (residual != nullptr) {
    *residual = *std::max_element(partial_.begin(), partial_.begin() + static_cast<std::ptrdiff_t>(packed_.runs()));
  }
  return sums;
}

// Moves w by what is pending; v from the slots, which then move by a whole step. Returns v^T M v [J].
double Spg::body_pass() {
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    const Lanes pending = packed::all(pending_);
    Lanes energy{};
    for (std::size_t at = first; at < last; ++at) {
      const std::uint32_t* const slots = packed_.first_slots(at);
      const packed::Twists sum = packed::take_sums(packed_.slots(), slots);
      const packed::Twists v = packed::times(packed_.body_group(at), sum), w = w_[at] + pending * v_[at];
      energy += packed::dot(sum, v);
      packed::spread(w + v, slots, packed_.slots());
      w_[at] = w;
      v_[at] = v;
    }
    partial_[packed::PackedProblem::chunk_of_group(first)] = packed::total(energy);
  });
  packed_.clear_sinks();
  double energy = 0.0;
  for (std::size_t k = 0; k < packed_.body_chunks(); ++k) energy += partial_[k];
  return energy;
}

// N d; returns d^T N d [J].
double Spg::matrix_pass() {
  delassus_.row_velocities({}, d_.rows, product_d_);
  double sum = 0.0;
  for (std::size_t k = 0; k < product_d_.size(); ++k) sum += d_.rows[k] * product_d_[k];
  return sum;
}

// The slots' velocities: w, and v times what is pending.
void Spg::move_slots() {
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    const Lanes pending = packed::all(pending_);
    for (std::size_t at = first; at < last; ++at) {
      packed::spread(w_[at] + pending * v_[at], packed_.first_slots(at), packed_.slots());
    }
  });
}

double Spg::product_norm_of(const packed::Run& run) {
  const CcpProblem& problem = packed_.problem();
  Lanes lanes{};
  for (std::size_t at = run.first_group; at < run.last_group; ++at) {
    if (at + packed::kAhead < run.last_group) packed::prefetch(packed_.group(at + packed::kAhead), packed_.slots());
    const packed::Group& group = packed_.group(at);
    Lanes3 product = packed::relative_velocity(group, packed_.slots());
    if (packed_.compliant()) product = product + packed::comply(group, packed_.compliance(at), d_.contacts[at]);
    lanes += spg::product_norm(group, product);
  }
  double sum = packed::total(lanes);
  for (std::size_t block = run.first_block; block < run.last_block; ++block) {
    const std::size_t row = problem.blocks[block].first_row, rows = problem.blocks[block].rows;
    const std::span<const double> mass = packed_.block_masses(block);
    BlockVector product{};
    if (packed_.has_matrix()) {
      std::copy_n(product_d_.begin() + static_cast<std::ptrdiff_t>(row), rows, product.begin());
    } else {
      packed_.block_product(block, std::span{d_.rows}.subspan(row, rows), std::span{product}.first(rows));
    }
    for (std::size_t k = 0; k < rows; ++k) sum += mass[k] * product[k] * product[k];
  }
  return sum;
}

// (N d)^T D^-1 (N d) [J]; the slots have other velocities for as long as it takes.
double Spg::product_norm() {
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) packed::spread(v_[at], packed_.first_slots(at), packed_.slots());
  });
  packed_.for_runs([&](const packed::Run& run) { partial_[run.index] = product_norm_of(run); });
  move_slots();
  double sum = 0.0;
  for (std::size_t k = 0; k < packed_.runs(); ++k) sum += partial_[k];
  return sum;
}

// x and w as the slots have them.
void Spg::finish_step() {
  if (pending_ == 0.0) return;
  const double pending = pending_;
  delassus_.for_chunks(x_.contacts.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      x_.contacts[k] = x_.contacts[k] + packed::all(pending) * d_.contacts[k];
    }
  });
  for (std::size_t k = 0; k < x_.rows.size(); ++k) x_.rows[k] += pending * d_.rows[k];
  for (std::size_t k = 0; k < product_.size(); ++k) product_[k] += pending * product_d_[k];
  for (std::size_t at = 0; at < w_.size(); ++at) w_[at] = w_[at] + packed::all(pending) * v_[at];
  pending_ = 0.0;
}

// Velocities from x alone.
void Spg::refresh() {
  finish_step();
  fresh_ = true;
  if (packed_.has_matrix()) return delassus_.row_velocities({}, x_.rows, product_);
  packed_.load(x_);
  packed_.for_body_groups([&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) {
      const std::uint32_t* const slots = packed_.first_slots(at);
      w_[at] = packed::times(packed_.body_group(at), packed::take_sums(packed_.slots(), slots));
      packed::spread(w_[at], slots, packed_.slots());
    }
  });
  packed_.clear_sinks();
}

}  // namespace scree
