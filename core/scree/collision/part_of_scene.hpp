// PartOfScene: some bodies of a scene, as a scene of their own.
#pragma once

#include <vector>

#include "scree/model/body.hpp"

namespace scree {

/// Those bodies that forces do not move, and some that they move; in their order, with velocities. Buffers are kept.
class PartOfScene {
 public:
  /// @param movable in increasing order @param velocity, angular_velocity of all bodies [m/s], [rad/s], world
  void take(const BodyView& bodies, std::span<const BodyIndex> movable, std::span<const Vec3> velocity,
            std::span<const Vec3> angular_velocity);

  /// What collision reads of bodies. Ends with the next take().
  [[nodiscard]] BodyView view() const;
  [[nodiscard]] std::span<const Vec3> velocity() const { return velocity_; }
  [[nodiscard]] std::span<const Vec3> angular_velocity() const { return spin_; }
  /// Of body i here, its index among all.
  [[nodiscard]] BodyIndex index(BodyIndex i) const { return index_[i]; }

 private:
  std::vector<BodyIndex> index_;
  std::vector<BodyId> id_;
  std::vector<Motion> motion_;
  std::vector<std::uint32_t> shape_;
  std::vector<Vec3> position_, velocity_, spin_;
  std::vector<Quat> orientation_;
  std::vector<CollisionGroup> group_;
};

}  // namespace scree
