// BlockSweep: the general blocks of a problem, and what their impulses change, for sweeps that go block by block.
//
// A block reads its velocity u and moves its impulse (block_step.hpp), then adds what the change causes. With bodies that is
// u = J w + E g + r, and the change goes to the velocities w of two bodies, those that a ContactSweep holds for the contacts
// as well. With an explicit matrix it is u = v + E g + r with v = (N - E) g kept up to date, and the change goes to v, column by
// column: a block that does not move costs nothing. Either way the sweep's state (w or v) is linear in the impulses.
// (Matrices in files are not always symmetric to the last digits, so that rows cannot stand for columns.)
//
// On the calling thread: first, one after the other, joints and the like, few beside contacts; then, where there are bodies,
// contacts that resist rolling, four at a time (cone_sweep.hpp).
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/sweep/block_step.hpp"
#include "scree/ccp/sweep/cone_sweep.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"

namespace scree {

/// Keeps its memory between problems.
class BlockSweep {
 public:
  /// `contacts` is bound to the same problem. Problem, its spans and `contacts` stay where they are during the use.
  void bind(const CcpProblem& problem, ContactSweep& contacts, const sweep::StepSettings& settings);

  [[nodiscard]] bool empty() const { return problem_.blocks.empty(); }
  /// Sets the impulses of the blocks from those of the whole problem, and with a matrix v. (Bodies: contacts.set_velocities().)
  void set_impulses(std::span<const double> gamma);
  /// Puts them where they belong in those of the whole problem.
  void impulses(std::span<double> gamma) const;

  /// Every block once, in the sweep's order, or backwards.
  void sweep(bool backward);

  /// One a row of the blocks [N s].
  [[nodiscard]] std::span<double> g() { return g_; }
  /// As g, right-hand side [m/s] and metric of the steps [1/kg].
  [[nodiscard]] std::span<const double> r() const { return r_; }
  [[nodiscard]] std::span<const double> stiffness() const { return steps_.stiffness(); }
  /// Empty for none, as g [1/kg].
  [[nodiscard]] std::span<const double> compliance() const { return compliance_; }
  /// As g, N g - E g of a problem with a matrix; empty for others [m/s].
  [[nodiscard]] std::span<double> v() { return v_; }

 private:
  void velocity_of(std::size_t k, std::span<double> u) const;
  void update(std::size_t k);
  void push(std::size_t k, std::span<const double> change);
  void add_to_bodies(const CcpBlock& block, std::span<const double> change);
  void bind_columns();
  void add_to_rows(std::size_t k, std::span<const double> change);

  CcpProblem problem_;
  ContactSweep* contacts_ = nullptr;
  sweep::BlockSteps steps_;
  std::span<const double> r_, compliance_;
  std::vector<double> g_, v_;
  std::vector<std::uint32_t> singles_;  ///< blocks that go alone
  sweep::ConeSweep cones_;
  /// Of the matrix: block column j has the blocks column_first_[j] .. column_first_[j + 1] - 1.
  std::vector<std::uint32_t> column_first_, column_row_;
  std::vector<std::size_t> column_value_;
};

}  // namespace scree
