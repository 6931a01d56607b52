#include "scree/ccp/delassus.hpp"

#include <algorithm>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {

namespace {

/// The blocks follow each other without holes and have sizes that there are.
bool blocks_fit(const CcpProblem& problem) {
  std::size_t rows = 0;
  for (const CcpBlock& block : problem.blocks) {
    const bool size = block.rows >= 1 && block.rows <= CcpBlock::kMostRows;
    if (!size || (block.kind == CcpKind::cone && block.rows == 4) || block.first_row != rows) return false;
    rows += block.rows;
  }
  if (problem.matrix.empty()) return problem.block_rows.size() == rows;
  return problem.bodies() == 0 && problem.contacts.empty() && problem.block_rows.empty() &&
         problem.matrix.first.size() == problem.blocks.size() + 1;
}

}  // namespace

void DelassusOperator::bind(const CcpProblem& problem, const Executor* executor) {
  SCREE_REQUIRE(blocks_fit(problem), "DelassusOperator: the blocks of the CCP do not fit each other");
  SCREE_REQUIRE(problem.inverse_inertia.size() == problem.bodies() && problem.r.size() == problem.rows() &&
                    (problem.compliance.empty() || problem.compliance.size() == problem.rows()),
                "DelassusOperator: the spans of the CCP differ in length");
  problem_ = &problem;
  executor_ = executor;
  partition_.build(problem);
  partial_.resize(Executor::chunk_count(problem.units(), kGrain));
  if (problem.units() < kManyRecords) {  // in a large problem, who needs the sums makes them
    slots_.resize(partition_.slot_count());
    w_.resize(problem.bodies());
  }
  make_room(problem.units(), traces_);
  traces_.resize(problem.units());
  for_chunks(problem.units(), [&](std::size_t first, std::size_t last) {
    for_units(
        first, last, [&](std::size_t i) { traces_[i] = diagonal_trace(problem, i); },
        [&](std::size_t i) { traces_[problem.contacts.size() + i] = diagonal_trace_of_block(problem, i); });
  });
}

void DelassusOperator::release_sums() { release(slots_, w_); }

void DelassusOperator::release_partition() {
  release_sums();
  release(traces_);
  partition_ = {};
}

void DelassusOperator::body_velocities(std::span<const double> gamma, std::span<Twist> w) {
  if (!problem_->matrix.empty()) return;
  make_room(partition_.slot_count(), slots_);
  slots_.resize(partition_.slot_count());
  for_chunks(slots_.size(), [&](std::size_t first, std::size_t last) {
    std::fill(slots_.begin() + static_cast<std::ptrdiff_t>(first), slots_.begin() + static_cast<std::ptrdiff_t>(last),
              Twist{});
  });
  const SlotPair* const slots = partition_.slots().data();
  for_chunks(problem_->units(), [&](std::size_t first, std::size_t last) {
    for_units(
        first, last,
        [&](std::size_t i) {
          add_impulse(problem_->contacts[i], load_block(gamma, i), slots_[slots[i].a], slots_[slots[i].b]);
        },
        [&](std::size_t i) {
          const CcpBlock& block = problem_->blocks[i];
          const SlotPair slot = slots[problem_->contacts.size() + i];
          add_impulse(jacobian_of(*problem_, block), rows_of(*problem_, block, gamma), slots_[slot.a], slots_[slot.b]);
        });
  });
  reduce_slots(slots_, w);
}

void DelassusOperator::reduce_slots(std::span<const Twist> slots, std::span<Twist> w) const {
  const std::span<const std::uint32_t> first_slot = partition_.first_slot();
  for_chunks(problem_->bodies(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      Twist sum;
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) sum += slots[s];
      w[k] = apply_inverse_mass(*problem_, k, sum);
    }
  });
}

void DelassusOperator::block_velocity(std::size_t block, std::span<const Twist> w, std::span<const double> gamma,
                                      std::span<double> u) const {
  const CcpBlock& b = problem_->blocks[block];
  if (problem_->matrix.empty()) {
    relative_velocity(jacobian_of(*problem_, b), w[b.a], w[b.b], u);
  } else {
    multiply_block_row(*problem_, block, gamma, u);
  }
  if (problem_->compliance.empty()) return;
  const std::size_t row = first_row(*problem_, b);
  for (std::size_t k = 0; k < b.rows; ++k) u[k] += problem_->compliance[row + k] * gamma[row + k];
}

void DelassusOperator::row_velocities(std::span<const Twist> w, std::span<const double> gamma,
                                      std::span<double> out) const {
  const bool compliant = !problem_->compliance.empty();
  for_chunks(problem_->units(), [&](std::size_t first, std::size_t last) {
    for_units(
        first, last,
        [&](std::size_t i) {
          const CcpContact& c = problem_->contacts[i];
          Vec3 u = relative_velocity(c, w[c.a], w[c.b]);
          if (compliant) u += hadamard(load_block(problem_->compliance, i), load_block(gamma, i));
          store_block(out, i, u);
        },
        [&](std::size_t i) { block_velocity(i, w, gamma, rows_of(*problem_, problem_->blocks[i], out)); });
  });
}

void DelassusOperator::apply(std::span<const double> gamma, std::span<double> out) {
  w_.resize(problem_->bodies());
  body_velocities(gamma, w_);
  row_velocities(w_, gamma, out);
}

double DelassusOperator::objective(std::span<const double> gamma) {
  w_.resize(problem_->bodies());
  body_velocities(gamma, w_);
  const bool compliant = !problem_->compliance.empty();
  for_chunks(problem_->units(), [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for_units(
        first, last,
        [&](std::size_t i) {
          const CcpContact& c = problem_->contacts[i];
          const Vec3 g = load_block(gamma, i);
          Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]);
          if (compliant) u += hadamard(load_block(problem_->compliance, i), g);
          sum += dot(g, 0.5 * u + load_block(problem_->r, i));
        },
        [&](std::size_t i) {
          BlockVector u;
          block_velocity(i, w_, gamma, u);
          const std::size_t row = first_row(*problem_, problem_->blocks[i]);
          for (std::size_t k = 0; k < problem_->blocks[i].rows; ++k) {
            sum += gamma[row + k] * (0.5 * u[k] + problem_->r[row + k]);
          }
        });
    partial_[first / kGrain] = sum;
  });
  double total = 0.0;
  for (const double p : partial_) total += p;
  return total;
}

Mat3 diagonal_block(const CcpProblem& problem, std::size_t block) {
  const CcpContact& c = problem.contacts[block];
  // Velocity that a world impulse p causes at the contact: K p, summed over both bodies.
  const Mat3 ra = skew(c.arm_a), rb = skew(c.arm_b);
  const double m = problem.inverse_mass[c.a] + problem.inverse_mass[c.b];
  const Mat3 k = Mat3::diagonal({m, m, m}) + transpose(ra) * (problem.inverse_inertia[c.a] * ra) +
                 transpose(rb) * (problem.inverse_inertia[c.b] * rb);
  const ContactFrame frame = contact_frame(c.normal);
  const Mat3 rows{frame.normal, frame.tangent1, frame.tangent2};
  Mat3 n = rows * (k * transpose(rows));
  if (!problem.compliance.empty()) n = n + Mat3::diagonal(load_block(problem.compliance, block));
  return n;
}

double diagonal_trace(const CcpProblem& problem, std::size_t block) {
  const CcpContact& c = problem.contacts[block];
  // trace(r^T J r) of a skew r is |arm|^2 trace(J) - arm . J arm, whatever the frame.
  const auto rotational = [](const Mat3& j, const Vec3& arm) {
    return squared_norm(arm) * (j.row0.x + j.row1.y + j.row2.z) - dot(arm, j * arm);
  };
  double trace = 3.0 * (problem.inverse_mass[c.a] + problem.inverse_mass[c.b]) +
                 rotational(problem.inverse_inertia[c.a], c.arm_a) + rotational(problem.inverse_inertia[c.b], c.arm_b);
  if (!problem.compliance.empty()) {
    const Vec3 e = load_block(problem.compliance, block);
    trace += e.x + e.y + e.z;
  }
  return trace;
}

}  // namespace scree
