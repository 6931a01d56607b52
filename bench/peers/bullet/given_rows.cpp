#include "given_rows.hpp"

#include "scree/ccp/twist.hpp"

namespace scree::bench {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

btScalar GivenRows::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                                 btPersistentManifold** manifolds, int manifold_count,
                                                 btTypedConstraint** constraints, int constraint_count,
                                                 const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, drawer);
  if (problem_ == nullptr) return result;
  const auto contact_of = [&](int k) {
    const auto* point = static_cast<const btManifoldPoint*>(m_tmpSolverContactConstraintPool[k].m_originalContactPoint);
    return static_cast<std::size_t>(point->m_partId0);
  };
  for (int k = 0; k < m_tmpSolverContactConstraintPool.size(); ++k) {
    set_row(m_tmpSolverContactConstraintPool[k], contact_of(k));
  }
  for (int k = 0; k < m_tmpSolverContactFrictionConstraintPool.size(); ++k) {
    btSolverConstraint& row = m_tmpSolverContactFrictionConstraintPool[k];
    set_row(row, contact_of(row.m_frictionIndex));
  }
  return result;
}

// The first body of a row is b of the contact.
void GivenRows::set_row(btSolverConstraint& row, std::size_t contact) const {
  const CcpContact& c = problem_->contacts[contact];
  const Vec3 along = in_frame(c, from_bullet(row.m_contactNormal1));
  const auto on = [&](std::uint32_t body, const btVector3& torque) {
    return problem_->inverse_mass[body] > 0.0 ? problem_->inverse_inertia[body] * from_bullet(torque) : Vec3{};
  };
  const Vec3 turn_b = on(c.b, row.m_relpos1CrossNormal), turn_a = on(c.a, row.m_relpos2CrossNormal);
  double compliance = 0.0;
  if (!problem_->compliance.empty()) {
    const Vec3 e = load_block(problem_->compliance, contact);
    compliance = along.x * along.x * e.x + along.y * along.y * e.y + along.z * along.z * e.z;
  }
  const double stiffness = problem_->inverse_mass[c.a] + problem_->inverse_mass[c.b] +
                           dot(turn_b, from_bullet(row.m_relpos1CrossNormal)) +
                           dot(turn_a, from_bullet(row.m_relpos2CrossNormal)) + compliance;
  row.m_angularComponentA = to_bullet(turn_b);
  row.m_angularComponentB = to_bullet(turn_a);
  row.m_jacDiagABInv = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
  row.m_rhs = -dot(along, load_block(problem_->r, contact)) * row.m_jacDiagABInv;
  row.m_rhsPenetration = 0.0;
  row.m_cfm = compliance * row.m_jacDiagABInv;
}

}  // namespace scree::bench
