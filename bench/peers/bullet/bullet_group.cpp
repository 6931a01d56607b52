#include "bullet_group.hpp"

#include <algorithm>
#include <chrono>

#include "scree/ccp/twist.hpp"

namespace scree::bench {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

BulletGroup::BulletGroup(const CcpProblem& problem, const std::vector<Vec3>& free, double dt,
                         const BulletSettings& settings)
    : problem_{problem} {
  info_.m_timeStep = dt;
  info_.m_erp = info_.m_erp2 = 0.0;
  info_.m_splitImpulse = 0;
  info_.m_solverMode = SOLVER_SIMD | (settings.two_directions ? SOLVER_USE_2_FRICTION_DIRECTIONS : 0);
  solver_.give(settings.given_rows ? &problem_ : nullptr);
  add_bodies(free);
  add_contacts(dt);
  const auto ordered = [](const auto& made, const std::vector<std::uint32_t>& order, auto& out) {
    for (std::size_t k = 0; k < made.size(); ++k) out.push_back(made[order.empty() ? k : order[k]].get());
  };
  ordered(bodies_, settings.bodies, group_);
  ordered(made_, settings.contacts, manifolds_);
}

void BulletGroup::add_bodies(const std::vector<Vec3>& free) {
  for (std::size_t k = 0; k < problem_.bodies(); ++k) {
    const double inverse_mass = problem_.inverse_mass[k], inverse_inertia = problem_.inverse_inertia[k].row0.x;
    const bool fixed = inverse_mass == 0.0;
    const btScalar inertia = fixed ? 0.0 : 1.0 / inverse_inertia;
    // All bodies stand at the origin: the solver reads lever arms only.
    bodies_.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo{
        fixed ? 0.0 : 1.0 / inverse_mass, nullptr, &shape_, btVector3{inertia, inertia, inertia}}));
    bodies_.back()->setLinearVelocity(to_bullet(free[k]));
    bodies_.back()->updateInertiaTensor();
  }
}

// Bullet's normal points from its second body to its first: the first is b.
void BulletGroup::add_contacts(double dt) {
  for (std::size_t i = 0; i < problem_.contacts.size(); ++i) {
    const CcpContact& c = problem_.contacts[i];
    btManifoldPoint point{to_bullet(c.arm_b), to_bullet(c.arm_a), to_bullet(c.normal), 0.0};
    point.m_positionWorldOnA = to_bullet(c.arm_b);
    point.m_positionWorldOnB = to_bullet(c.arm_a);
    point.m_combinedFriction = c.friction;
    point.m_partId0 = static_cast<int>(i);
    // r = D^T v_free + b, and b is the speed at which an open contact may close.
    const Vec3 free = from_bullet(bodies_[c.b]->getLinearVelocity() - bodies_[c.a]->getLinearVelocity());
    point.m_distance1 = std::max(0.0, dt * (problem_.r[3 * i] - dot(c.normal, free)));
    auto manifold = std::make_unique<btPersistentManifold>(bodies_[c.b].get(), bodies_[c.a].get(), 0, 1.0, 1.0);
    manifold->addManifoldPoint(point);
    made_.push_back(std::move(manifold));
  }
}

double BulletGroup::solve(int iterations) {
  info_.m_numIterations = iterations;
  for (const auto& manifold : made_) {
    btManifoldPoint& point = manifold->getContactPoint(0);
    point.m_appliedImpulse = point.m_appliedImpulseLateral1 = point.m_appliedImpulseLateral2 = 0.0;
  }
  std::vector<btVector3> linear, angular;
  for (const auto& body : bodies_) {
    linear.push_back(body->getLinearVelocity());
    angular.push_back(body->getAngularVelocity());
  }
  const auto start = std::chrono::steady_clock::now();
  solver_.solveGroup(group_.data(), static_cast<int>(group_.size()), manifolds_.data(),
                     static_cast<int>(manifolds_.size()), nullptr, 0, info_, nullptr, nullptr);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k]->setLinearVelocity(linear[k]);
    bodies_[k]->setAngularVelocity(angular[k]);
  }
  return took.count();
}

std::vector<double> BulletGroup::impulses() const {
  std::vector<double> gamma(problem_.rows());
  for (std::size_t i = 0; i < made_.size(); ++i) {
    const btManifoldPoint& p = made_[i]->getContactPoint(0);
    const btVector3 world = p.m_normalWorldOnB * p.m_appliedImpulse +
                            p.m_lateralFrictionDir1 * p.m_appliedImpulseLateral1 +
                            p.m_lateralFrictionDir2 * p.m_appliedImpulseLateral2;
    store_block(gamma, i, in_frame(problem_.contacts[i], from_bullet(world)));
  }
  return gamma;
}

}  // namespace scree::bench
