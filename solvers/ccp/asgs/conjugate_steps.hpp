// Where the next pair of sweeps starts, by minimising the objective over a plane.
//
// A pair of sweeps leads from y to z. Without cones z - y is a preconditioned gradient step, and the minimum over
//
//     y' = y + a (z - y) + b (y - y_old)
//
// is the next iterate of the preconditioned conjugate gradient method, in the form of Knyazev (2001, SIAM J. Sci. Comput.
// 23:517, section 3): no estimate of any spectrum, and the conditioning of each set of sticking contacts counts by itself. With
// cones it is a guess: y' may leave them, and the sweeps, which project, lead back. It serves as long as the contacts that
// slide and open change little; the sign of its end is a < 1, less than what plain sweeps would do.
//
// The objective 1/2 w^T M w + r^T y of y needs the bodies' velocities w, and r^T y: both go with y linearly.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"

namespace scree {

/// Where on the plane the objective is least, by the products below and r^T z, r^T y and r^T y_old [J].
struct PlaneStep {
  double a = 1.0, b = 0.0;
  double gain = 0.0;  ///< how far below z it is there, without cones [J]
  /// (d, d), (d, p), (p, p), (y, d), (y, p), (z, z) of d = z - y, p = y - y_old, in the norm of the masses [J].
  using Products = std::array<double, 6>;
  /// False where that is no step worth making.
  bool choose(const Products& products, double linear_z, double linear_y, double linear_old);
  /// So far that it must prove itself: along impulses that change next to no velocity the objective falls until a cone says stop, and the
  /// sweeps, which take back what cones forbid, leave the rest of them.
  [[nodiscard]] bool far() const;
  /// Whether the objective fell by `fallen` [J] as far as a step must; `rounding` [J] is nothing.
  [[nodiscard]] bool delivers(double fallen, double rounding) const;
};

/// For contacts without compliance. Keeps its memory between solves.
class ConjugateSteps {
 public:
  /// y = z: `bodies` have its velocities, `linear` is r^T y [J].
  void start(std::span<const sweep::Body> bodies, double linear);

  [[nodiscard]] double a() const { return step_.a; }
  [[nodiscard]] double b() const { return step_.b; }
  [[nodiscard]] const PlaneStep& step() const { return step_; }
  /// The next pair starts from z.
  void plain() { step_ = {}; }
  /// Takes in z: `bodies` have its velocities; `inertia` one a body [kg m2], or empty where all are isotropic. Returns
  /// 1/2 w^T M w of them [J].
  double measure(std::span<const sweep::Body> bodies, std::span<const Mat3> inertia, const DelassusOperator& delassus);
  /// Chooses a and b for the z measured; false where they are no step worth making. `linear` is r^T z [J].
  bool choose(double linear);
  /// Takes the bodies from z to y'.
  void go(std::span<sweep::Body> bodies, const DelassusOperator& delassus);
  /// Velocities of body k changed by `linear`, `angular` without a change of impulses.
  void correct(std::size_t k, const Lanes& linear, const Lanes& angular);

 private:
  using Products = PlaneStep::Products;

  std::vector<sweep::Body> y_, old_;
  std::vector<Products> partial_;
  Products products_{};
  double linear_z_ = 0.0, linear_y_ = 0.0, linear_old_ = 0.0;
  PlaneStep step_;
};

}  // namespace scree
