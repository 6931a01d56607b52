// JointProjection: what rows that hold exactly (hard equations, motors within their limits) still lack, taken out directly.
//
// Whatever a contact solver leaves in the joints, and whatever the motion along their curved ways adds within a step, is
// removed by impulses of the joints alone: with D the rows at the beginning of the step and Psi their values at its end,
//
//     N g = -Psi(q1) / h,  N = D^T M^-1 D,  v1 += M^-1 D g
//
// until Psi(q1) vanishes: the method SHAKE (Ryckaert, Ciccotti & Berendsen 1977, J. Comput. Phys. 23:327) with all rows at
// once. Equations may repeat each other. With e a billionth of N's diagonal, N^-1 is taken as (N + e)^-1 N (N + e)^-1: the
// inverse where N has one, and zero where it has none, so that rounding in repeated equations does not add up.
#pragma once

#include <memory>
#include <span>

#include "scree/machine/machine_row.hpp"

namespace scree {

/// What resists motion of a body: both zero when forces do not move it.
struct BodyInertia {
  double inverse_mass = 0.0;  ///< [1/kg]
  Mat3 inverse_inertia;       ///< [1/(kg m2)], world
};

/// M^-1 J^T g of one body: what an impulse `g` [N s] of a row changes of its velocity.
[[nodiscard]] inline Twist velocity_change(const BodyInertia& body, const Twist& row, double g) {
  return {(g * body.inverse_mass) * row.linear, g * (body.inverse_inertia * row.angular)};
}

/// The factorised N of some rows. Keeps its memory between steps.
class JointProjection {
 public:
  JointProjection();
  ~JointProjection();
  JointProjection(const JointProjection&) = delete;
  JointProjection& operator=(const JointProjection&) = delete;

  /// Makes and factorises N of `rows`, whose bodies are numbers of `bodies`; `compliance` is added to its diagonal [1/kg].
  /// False when it cannot be factorised: a row is not finite.
  [[nodiscard]] bool bind(std::span<const MachineRow> rows, std::span<const double> compliance,
                          std::span<const BodyInertia> bodies);
  /// `impulse` = -N^-1 `defect` [N s], [m/s].
  void solve(std::span<const double> defect, std::span<double> impulse);

 private:
  struct Matrix;
  std::unique_ptr<Matrix> matrix_;
};

}  // namespace scree
