// SingleSweep: conjugate steps in single precision, with which a solve may begin.
//
// Sweeps are bound by what they read: numbers of half the length go in half the time, eight contacts side by side. Rounding shows
// at 1e-7 of the velocities; what is asked for is mostly far above. The answer is looked at, and judged, in double precision, and what
// is not done then is done by double sweeps.
//
// Contacts only, without compliance, between bodies whose inverse inertia is a multiple of the identity; swept in the order of the
// contacts, on the calling thread. The terms are those of conjugate_steps.hpp. When these steps have failed, Nesterov's follow.
#pragma once

#include <span>
#include <vector>

#include "conjugate_steps.hpp"
#include "scree/ccp/sweep/grouping.hpp"
#include "single_lanes.hpp"

namespace scree {

class Executor;

/// Keeps its memory between problems: 130 bytes a contact, 96 a body.
class SingleSweep {
 public:
  /// Impulses and velocities are right to this share of the largest ones [1].
  static constexpr double kRounding = 1e-5;

  [[nodiscard]] static bool takes(const CcpProblem& problem);
  /// Starts from the impulses `gamma` [N s], whose bodies have the velocities `w`. Threads of the `executor`, where there is one, fill
  /// the groups and fetch the impulses.
  void start(const CcpProblem& problem, std::span<const double> gamma, std::span<const Twist> w,
             const Executor* executor);

  /// A pair of sweeps from y to z. Returns the objective of z [J]. Updates of the second that a velocity above `speed` [m/s] asked for
  /// are counted.
  double advance(double speed);
  /// Share of the contacts so counted: of those that miss that residual, nearly [1].
  [[nodiscard]] double missing() const { return missing_; }
  /// Chooses where the next pair starts: at z, where this is false.
  bool choose();
  [[nodiscard]] const PlaneStep& step() const { return step_; }
  /// From here on a pair starts at z + beta (z - z_old), beta being set before each; at z first.
  void begin_momentum();
  void set_momentum(double beta) { beta_ = static_cast<float>(beta); }
  /// (y - z)^T d (z - z_old) of the last pair with momentum, d the metric of the steps [J].
  [[nodiscard]] double against() const { return against_; }
  /// Back to z_old.
  void undo();
  /// Impulses of z, of the whole `problem`, on the cones as it has them.
  void impulses(const CcpProblem& problem, std::span<double> gamma) const;
  /// Gives z the velocities `w`, without what rounding added, and those before the same correction.
  void correct(std::span<const Twist> w);

 private:
  /// Where the pair started, and the start before it; with momentum, the z before it.
  struct History {
    single::Lanes3 y, old;
  };
  /// Calls visit(at) for each group, several at a time.
  template <class Visit>
  void for_groups(const Visit& visit) const;
  void fill(const CcpProblem& problem);
  void put(const CcpProblem& problem, std::size_t at, std::size_t lane, std::uint32_t i);
  template <bool momentum>
  void sweep_forward();
  template <bool momentum>
  void sweep_backward(float speed);
  void go();
  void go_with_momentum();
  void measure();

  const Executor* executor_ = nullptr;  ///< that of the last start()
  sweep::Sequence sequence_;
  sweep::GroupingOf<8> grouping_;
  std::size_t bodies_count_ = 0;
  std::vector<single::Group> groups_;
  std::vector<History> history_;
  std::vector<single::Body> bodies_, y_, old_;  ///< those of the problem, and one that stands for nothing
  PlaneStep step_;
  PlaneStep::Products products_{};
  bool momentum_ = false;
  float beta_ = 0.0F;
  double missing_ = 1.0, against_ = 0.0;
  std::size_t contacts_ = 0;
  double linear_z_ = 0.0, linear_y_ = 0.0, linear_old_ = 0.0;
};

}  // namespace scree
