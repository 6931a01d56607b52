// DelassusOperator: N = D^T M^-1 D + E of a CcpProblem, never formed.
//
// N g is two passes: w = M^-1 D g, body velocities that the impulses cause, then
// D^T w + E g, row velocities. Solvers that work with w (all the fast ones
// do) call the halves themselves. For a problem with an explicit matrix w is empty
// and the second half does all. Results have the same bits for any number of
// threads.
//
// A unit is a contact or a block: contacts first, then blocks.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/contact_partition.hpp"
#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {

/// Matrix-free Delassus operator. Refers to the problem that it was bound to;
/// keeps its memory between problems.
class DelassusOperator {
 public:
  /// Units or bodies per chunk of the loops below.
  static constexpr std::size_t kGrain = ContactPartition::kRunLength;

  /// `executor` may be null: everything runs on the calling thread. Nothing after this asks for memory. @throws
  /// std::logic_error for spans that do not fit each other and blocks with holes between their rows.
  void bind(const CcpProblem& problem, const Executor* executor);
  void bind(const CcpProblem&& problem, const Executor* executor) = delete;  ///< `problem` has to outlive the use

  [[nodiscard]] const CcpProblem& problem() const { return *problem_; }
  [[nodiscard]] const ContactPartition& partition() const { return partition_; }
  /// trace(N_ii) of each unit [1/kg].
  [[nodiscard]] std::span<const double> traces() const { return traces_; }

  /// w = M^-1 D gamma [m/s, rad/s], one Twist per body; with a matrix there are none, and nothing is done.
  void body_velocities(std::span<const double> gamma, std::span<Twist> w);
  /// The last half of body_velocities(): w = M^-1 times the sums of each body's
  /// slots [N s].
  void reduce_slots(std::span<const Twist> slots, std::span<Twist> w) const;
  /// out = D^T w + E gamma [m/s], one number a row, for the body velocities w of gamma.
  void row_velocities(std::span<const Twist> w, std::span<const double> gamma, std::span<double> out) const;
  /// The same for the rows of one block, counted from 0 after the contacts.
  void block_velocity(std::size_t block, std::span<const Twist> w, std::span<const double> gamma,
                      std::span<double> u) const;
  /// out = N gamma [m/s].
  void apply(std::span<const double> gamma, std::span<double> out);

  /// 1/2 gamma^T N gamma + r^T gamma [J].
  [[nodiscard]] double objective(std::span<const double> gamma);

  /// Frees what the calls above work with; they make it anew.
  void release_sums();
  /// Frees partition() and traces() as well, for who has made a layout of its own of them. What adds up impulses of bodies is not to be
  /// called any more.
  void release_partition();

  /// Runs body(first, last) over chunks of `count` items, on the executor if
  /// there is one.
  template <class Body>
  void for_chunks(std::size_t count, const Body& body) const {
    // A single chunk is not worth waking threads for.
    if (count > kGrain && executor_ != nullptr && executor_->threads() > 1) {
      executor_->for_chunks(count, kGrain, std::cref(body));  // by reference: no copy of the captures on the heap
      return;
    }
    for (std::size_t first = 0; first < count; first += kGrain) body(first, std::min(first + kGrain, count));
  }

  /// Runs contact(i) for the contacts, block(j) for the blocks among units first .. last - 1.
  template <class Contact, class Block>
  void for_units(std::size_t first, std::size_t last, const Contact& contact, const Block& block) const {
    const std::size_t contacts = problem_->contacts.size();
    for (std::size_t i = first; i < std::min(last, contacts); ++i) contact(i);
    for (std::size_t i = std::max(first, contacts); i < last; ++i) block(i - contacts);
  }

 private:
  const CcpProblem* problem_ = nullptr;
  const Executor* executor_ = nullptr;
  ContactPartition partition_;
  std::vector<Twist> slots_;
  std::vector<Twist> w_;
  std::vector<double> traces_;
  std::vector<double> partial_;
};

/// N_ii, the 3 x 3 diagonal block of a contact [1/kg]; symmetric positive
/// semi-definite. Includes the compliance.
[[nodiscard]] Mat3 diagonal_block(const CcpProblem& problem, std::size_t block);

/// trace(N_ii) [1/kg], cheaper than the block.
[[nodiscard]] double diagonal_trace(const CcpProblem& problem, std::size_t block);

/// M^-1 of one body times an impulse and its moment.
inline Twist apply_inverse_mass(const CcpProblem& problem, std::size_t body, const Twist& p) {
  return {problem.inverse_mass[body] * p.linear, problem.inverse_inertia[body] * p.angular};
}

}  // namespace scree
