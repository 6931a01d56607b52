// The contacts of a bed as Bullet's sequential impulse solver wants them: rigid bodies, and a manifold of one point each.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "given_rows.hpp"
#include "scree/ccp/problem.hpp"

namespace scree::bench {

/// How Bullet's solver works; the defaults are Bullet's own.
struct BulletSettings {
  bool two_directions = false;  ///< friction along two tangents, as scree has it, in place of one
  bool given_rows = false;  ///< rows of the problem itself, in place of those from free velocities, which are 0 then
  std::vector<std::uint32_t> bodies = {}, contacts = {};  ///< orders; empty: the problem's
};

/// A problem in Bullet's terms: the same bodies, contacts, lever arms, free velocities and closing conditions. Without
/// split impulses and error reduction, so that nothing but the velocity problem is solved, from zero.
class BulletGroup {
 public:
  /// `free` is the free velocity of each body of the problem [m/s], `dt` the step [s]; bodies do not turn freely.
  BulletGroup(const CcpProblem& problem, const std::vector<Vec3>& free, double dt, const BulletSettings& settings);

  /// Solves with so many iterations. Returns the seconds that Bullet took.
  double solve(int iterations);
  /// The impulses found [N s], in the problem's frames and order; 3 numbers a contact.
  [[nodiscard]] std::vector<double> impulses() const;

 private:
  void add_bodies(const std::vector<Vec3>& free);
  void add_contacts(double dt);

  CcpProblem problem_;
  btContactSolverInfo info_;
  GivenRows solver_;
  btSphereShape shape_{1.0};
  std::vector<std::unique_ptr<btRigidBody>> bodies_;         ///< as in the problem
  std::vector<std::unique_ptr<btPersistentManifold>> made_;  ///< as in the problem
  std::vector<btCollisionObject*> group_;                    ///< in the order of the solver
  std::vector<btPersistentManifold*> manifolds_;             ///< in the order of the solver
};

}  // namespace scree::bench
