// Slots: the bodies of a scene in the order in which they lie in space, with what a sub-step reads and writes of them.
//
// The order is that of a Morton curve, so that bodies that touch are close in memory. A slot keeps its body until the next
// sort().
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/math/lanes.hpp"
#include "scree/math/twist.hpp"
#include "scree/model/body.hpp"

namespace scree {
class Executor;
class ShapeSet;
}  // namespace scree

namespace scree::dem {

/// Number of a body in the order of space.
using Slot = std::uint32_t;

/// What the search for contacts reads.
struct alignas(32) Place {
  Vec3 position;        ///< centre of mass [m]
  double radius = 0.0;  ///< of a ball [m]
};

/// What a contact reads of a body: one line of the cache.
struct alignas(64) Moving {
  Vec3 linear;                ///< of the centre of mass, predicted for the time of the forces [m/s]
  double inverse_mass = 0.0;  ///< [1/kg]; 0 where forces do not move the body
  Vec3 angular;               ///< as `linear` [rad/s], world
  double unused = 0.0;        ///< vector registers hold four

  [[nodiscard]] bool is_dynamic() const { return inverse_mass > 0.0; }
};

/// Force [N] and torque about the centre of mass [N m], world; one line of the cache, too.
struct alignas(64) Wrench {
  Vec3 force;
  double unused_force = 0.0;
  Vec3 torque;
  double unused_torque = 0.0;

  Wrench& operator+=(const Wrench& o) {
    force += o.force;
    torque += o.torque;
    return *this;
  }
};

/// Accelerations [m/s2], [rad/s2], world.
struct alignas(64) Accelerations {
  Vec3 linear;
  double unused_linear = 0.0;
  Vec3 angular;
  double unused_angular = 0.0;
};

/// A plane that stands still: what is below n x = offset is solid.
struct Flat {
  Slot slot = 0;
  Vec3 normal;          ///< n, out of the solid [1], world
  double offset = 0.0;  ///< [m]
  Vec3 centre;          ///< of its body, about which torques are taken [m]
};

/// A body whose orientation matters: its shape is no ball. Dynamic ones keep their angular momentum.
struct Turning {
  Slot slot = 0;
  Quat orientation = {};      ///< body to world [1]
  Vec3 momentum = {};         ///< angular, predicted for the time of the forces [kg m2/s], world
  Vec3 torque = {};           ///< of the last evaluation [N m], world
  Vec3 inverse_inertia = {};  ///< principal [1/(kg m2)]; zero where torques do not turn the body
  ContactLoad load = {};      ///< of contacts, since load()
};

/// A body that is fixed.
struct Standing {
  Slot slot = 0;
  ContactLoad load = {};  ///< of contacts, since load()
};

/// Columns by slot, all of one length.
struct Slots {
  std::vector<BodyIndex> body;
  std::vector<Slot> slot_of;  ///< by body
  std::vector<Place> place;
  std::vector<Moving> moving;
  std::vector<Accelerations> old;       ///< at the last evaluation
  std::vector<std::uint32_t> material;  ///< index into Materials
  std::vector<Wrench> wrench;           ///< of contacts; behind those of the slots, room for parts of sums
  std::vector<Lanes> field_force;       ///< of force fields [N]; the fourth is zero
  std::vector<Vec3> field_torque;       ///< [N m]; empty where no field turns a body
  std::vector<double> inverse_moment;   ///< where the three moments are equal [1/(kg m2)]; else 0
  std::vector<Flat> flats;              ///< by slot
  std::vector<Standing> standing;       ///< by slot
  std::vector<Turning> turning;         ///< by slot
  std::vector<double> reach;            ///< by entry of turning: farthest point from the centre of mass [m], 0 of balls

  [[nodiscard]] std::size_t size() const { return body.size(); }
  [[nodiscard]] bool is_ball(Slot slot) const { return place[slot].radius > 0.0; }
  /// Which of the flats the slot is; their number, where it is none.
  [[nodiscard]] std::size_t flat_of(Slot slot) const;

  /// Numbers the bodies along the curve.
  void sort(const BodyView& bodies);
  /// Takes an order that sort() gave before: the body of each slot.
  void set_order(std::span<const BodyIndex> bodies);
  /// Fills the columns from the bodies. Balls turn evenly and are oriented once an outer step, but for those of `oriented`,
  /// which are sorted.
  void load(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> oriented,
            const Executor& executor);
  /// Writes positions, orientations and velocities back. `dt` [s] since load(): balls turn by their mean angular velocity.
  void store(const BodyState& bodies, double dt, const Executor& executor) const;
  /// Writes the poses of `some` bodies, which turn, or all positions, where `some` is empty.
  void store_poses(const BodyState& bodies, std::span<const BodyIndex> some) const;

  /// What contacts did since load() to the bodies that are fixed or turn as `turning` tells, by body.
  void report_loads(std::vector<ContactLoad>& out) const;

 private:
  void find_flats(const BodyView& bodies, const ShapeSet& shapes);
  void find_turning(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> oriented);
  double farthest_from(Slot slot) const;
};

/// Angular velocity of a turning body [rad/s], world.
[[nodiscard]] inline Vec3 angular_velocity(const Quat& q, const Vec3& inverse_inertia, const Vec3& momentum) {
  return rotate(q, hadamard(inverse_inertia, rotate_back(q, momentum)));
}

}  // namespace scree::dem
