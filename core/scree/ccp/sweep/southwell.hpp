// Southwell: Gauss-Seidel updates of those contacts and blocks only whose residual is too large.
//
// Late in a solve the residual, a largest value over all contacts, is that of very few: of 181 000 contacts of a bed, 300 were
// above the tolerance when sweeps over all of them had done a third of the work. Relaxation as Southwell had it (1940,
// "Relaxation Methods in Engineering Science") goes where the residual is: a queue holds the contacts that miss the target; each
// is updated, and its neighbours, contacts of the same bodies, join the queue when they miss it now. Every update is that of a
// sweep, which lowers the objective. When the queue is empty the problem is solved. The contacts of a body that very many touch do
// not join with each of its moves: all contacts are looked at again when the queue is empty.
//
// One contact after the other, on the calling thread, in an order that depends on the problem and the impulses only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/block_step.hpp"

namespace scree {

/// For problems with bodies. Units are contacts, then blocks. Keeps its memory between problems: 17 bytes a unit, 4 a body.
class Southwell {
 public:
  /// A share of units that miss the target; with more of them sweeps over all are the better way [1].
  static constexpr double kFew = 0.05;

  /// The operator and its problem stay where they are during the use. The neighbours are looked up when first needed.
  void bind(const DelassusOperator& delassus);

  struct Outcome {
    bool reached = false;    ///< every unit meets the target, up to the rounding of w
    std::size_t visits = 0;  ///< units looked at for an update; a sweep over all has as many as there are units
  };
  /// Lowers the residual of `gamma` [N s], whose body velocities are `w` [m/s, rad/s], to `target` [m/s], in at most `budget`
  /// visits; nothing when too many units miss it. Both are kept up to date.
  Outcome relax(std::span<double> gamma, std::span<Twist> w, double target, std::size_t budget);

 private:
  [[nodiscard]] std::optional<Vec3> miss(std::size_t i, const Vec3& g, std::span<const Twist> w, double target) const;
  [[nodiscard]] std::optional<BlockVector> miss_of_block(std::size_t block, std::span<const double> gamma,
                                                         std::span<const Twist> w, double target) const;
  [[nodiscard]] bool misses(std::size_t unit, std::span<const double> gamma, std::span<const Twist> w,
                            double target) const;
  bool collect(std::span<const double> gamma, std::span<const Twist> w, double target);
  void find_neighbours();
  bool visit(std::size_t unit, std::span<double> gamma, std::span<Twist> w, double target) const;
  void update(std::size_t i, const Vec3& u, std::span<double> gamma, std::span<Twist> w) const;
  void update_block(std::size_t block, const BlockVector& u, std::span<double> gamma, std::span<Twist> w) const;
  bool push_neighbours(std::size_t unit);
  void push(std::uint32_t unit);

  const DelassusOperator* delassus_ = nullptr;
  bool has_neighbours_ = false;
  sweep::BlockSteps steps_;
  std::vector<std::uint32_t> first_,
      units_;  ///< body k, if movable, has units_[first_[k]] .. units_[first_[k + 1] - 1], blocks first
  std::vector<std::uint32_t> queue_;  ///< a ring: each unit at most once
  std::vector<char> waits_;           ///< per unit, in the queue
  std::size_t head_ = 0, count_ = 0;
};

}  // namespace scree
