// Bullet's sequential impulse solver over the rows of a contact problem.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "scree/ccp/problem.hpp"

namespace scree::bench {

/// Bullet makes its rows of manifolds; given a problem, their right-hand sides, compliance and inertia become those of the
/// problem. m_partId0 of a manifold point is its contact. Bodies have no velocities then.
class GivenRows : public btSequentialImpulseConstraintSolver {
 public:
  /// `problem` stays where it is; null leaves the rows as Bullet makes them.
  void give(const CcpProblem* problem) { problem_ = problem; }

 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                        int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 private:
  void set_row(btSolverConstraint& row, std::size_t contact) const;

  const CcpProblem* problem_ = nullptr;
};

}  // namespace scree::bench
