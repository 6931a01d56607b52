// BodyStore: owns the bodies of a simulation.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scree/model/body.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// A body to be added.
struct NewBody {
  Motion motion = Motion::dynamic;
  std::uint32_t shape = 0;     ///< index into ShapeSet
  std::uint32_t material = 0;  ///< index into Materials
  Pose pose;                   ///< of the body frame (centre of mass, principal axes) [m]
  Vec3 velocity;               ///< [m/s]
  Vec3 angular_velocity;       ///< [rad/s], world
  double mass = 1.0;           ///< [kg]
  Vec3 inertia{1, 1, 1};       ///< principal moments [kg m2]
  double radius = 0.0;         ///< of the sphere of equal volume [m]
  CollisionGroup collision_group = 0;
  Twist surface_motion;                                    ///< of a conveyor [m/s], [rad/s], as BodyView has it
  std::vector<std::pair<AttributeId, double>> attributes;  ///< those that differ from the column's initial value
};

/// Columns of all bodies. Adding and removing keeps the order by id.
class BodyStore {
 public:
  /// Adds a body and returns its id. References and spans taken before are
  /// invalid afterwards.
  BodyId add(const NewBody& body);
  /// Makes room for `count` bodies in all, exactly: a column that grows by itself doubles.
  void reserve(std::size_t count);
  /// Removes the bodies with remove[i] != 0, keeping the order of the others.
  void remove(std::span<const char> remove);

  [[nodiscard]] std::size_t size() const { return id_.size(); }
  [[nodiscard]] BodyView view() const;
  [[nodiscard]] BodyState state();
  [[nodiscard]] Attributes& attributes() { return attributes_; }
  [[nodiscard]] const Attributes& attributes() const { return attributes_; }
  /// The index of a body, or -1 when it is gone. Logarithmic.
  [[nodiscard]] std::int64_t find(BodyId id) const;
  /// Bodies ever added; the next id.
  [[nodiscard]] BodyId next_id() const { return next_id_; }

  /// A hash of every bit of ids, poses, velocities, masses, attributes, collision groups and surface motions, for comparing states. Columns that only
  /// observers write are left out, so that an observer that adds one leaves it as it is.
  [[nodiscard]] std::uint64_t hash() const;

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  BodyId next_id_ = 0;
  std::vector<BodyId> id_;
  std::vector<Motion> motion_;
  std::vector<std::uint32_t> shape_;
  std::vector<std::uint32_t> material_;
  std::vector<Vec3> position_;
  std::vector<Quat> orientation_;
  std::vector<Vec3> velocity_;
  std::vector<Vec3> angular_velocity_;
  std::vector<double> mass_;
  std::vector<Vec3> inertia_;
  std::vector<double> radius_;
  std::vector<CollisionGroup> collision_group_;
  std::vector<Twist> surface_motion_;  ///< empty until a body has one
  Attributes attributes_;
};

}  // namespace scree
