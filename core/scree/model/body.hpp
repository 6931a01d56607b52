// Bodies: what moves, as columns of equal length.
//
// Bodies keep a stable 64-bit id. Ids grow, removal keeps the order, so bodies
// are always sorted by id, and an index is valid until the next addition or
// removal.
#pragma once

#include <cstdint>
#include <span>

#include "scree/math/mat3.hpp"
#include "scree/math/pose.hpp"
#include "scree/math/twist.hpp"
#include "scree/model/attributes.hpp"

namespace scree {

/// Stable name of a body; never used twice in a run.
using BodyId = std::uint64_t;
/// Position of a body in the spans of a BodyView.
using BodyIndex = std::uint32_t;

/// How a body moves.
enum class Motion : std::uint8_t {
  dynamic,    ///< by forces and contacts
  kinematic,  ///< as told, whatever touches it
  fixed       ///< not at all
};

/// Index of a group of bodies; the filter of the collision pipeline says which groups meet. 0 is the group `default`.
using CollisionGroup = std::uint8_t;

/// Read-only spans of equal length n, in order of id. Frame: world, unless said
/// otherwise.
struct BodyView {
  std::span<const BodyId> id;
  std::span<const Motion> motion;
  std::span<const std::uint32_t> shape;     ///< index into ShapeSet
  std::span<const std::uint32_t> material;  ///< index into Materials
  std::span<const Vec3> position;           ///< centre of mass [m]
  std::span<const Quat> orientation;        ///< body (principal axes) to world, unit [1]
  std::span<const Vec3> velocity;           ///< of the centre of mass [m/s]
  std::span<const Vec3> angular_velocity;   ///< [rad/s], world
  std::span<const double> mass;             ///< [kg]; infinite for kinematic and fixed bodies
  std::span<const Vec3> inertia;            ///< principal moments [kg m2], body frame
  std::span<const double> radius;           ///< of the sphere of equal volume [m]
  const Attributes* attributes = nullptr;
  std::span<const CollisionGroup> collision_group = {};
  /// Motion of the surface against the body, as that of a conveyor belt, in the body frame: [m/s] at its origin, [rad/s]. Empty
  /// when no body has one. Contacts see it in their tangents; the body itself stays where it is.
  std::span<const Twist> surface_motion = {};

  [[nodiscard]] std::size_t size() const { return id.size(); }
  [[nodiscard]] std::span<const double> attribute(AttributeId column) const { return attributes->column(column); }
};

/// What a time stepper may change.
struct BodyState {
  BodyView view;                     ///< the same bodies, read-only
  std::span<Vec3> position;          ///< [m]
  std::span<Quat> orientation;       ///< body to world [1]
  std::span<Vec3> velocity;          ///< [m/s]
  std::span<Vec3> angular_velocity;  ///< [rad/s], world
};

/// What a force field adds to, one entry per body of the view of the same call.
struct WrenchView {
  std::span<Vec3> force;   ///< on the centre of mass [N], world
  std::span<Vec3> torque;  ///< about the centre of mass [N m], world
};

/// Motion of the surface of body i against the body [m/s] at its centre of mass, [rad/s], world; zero where it has none.
inline Twist surface_motion(const BodyView& bodies, BodyIndex i) {
  if (bodies.surface_motion.empty()) return {};
  const Twist& local = bodies.surface_motion[i];
  return {rotate(bodies.orientation[i], local.linear), rotate(bodies.orientation[i], local.angular)};
}

/// Inverse mass [1/kg]: zero for bodies that forces do not move.
inline double inverse_mass(const BodyView& bodies, BodyIndex i) {
  return bodies.motion[i] == Motion::dynamic ? 1.0 / bodies.mass[i] : 0.0;
}

/// Inverse inertia in the world [1/(kg m2)]: zero for bodies that torques do
/// not turn.
inline Mat3 inverse_inertia(const BodyView& bodies, BodyIndex i) {
  if (bodies.motion[i] != Motion::dynamic) return {};
  const Mat3 r = to_matrix(bodies.orientation[i]);
  const Vec3 j = bodies.inertia[i];
  return r * Mat3::diagonal({1.0 / j.x, 1.0 / j.y, 1.0 / j.z}) * transpose(r);
}

}  // namespace scree
