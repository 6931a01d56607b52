// TestBodies: the columns of a few bodies, for unit tests of what reads a BodyView.
//
//     TestBodies bodies{services.attributes()};
//     const std::size_t i = bodies.add_sphere(1, {0, 0, 0.5}, 1e-3, 946.0);
//     field.add_forces(bodies.view(), 0.0, bodies.wrenches());
//     EXPECT_DOUBLE_EQ(bodies.force[i].z, ...);
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "scree/model/body.hpp"

namespace scree::test {

/// Owns one column per entry of BodyView, and forces and torques of equal length. Add bodies in order of id.
struct TestBodies {
  /// `shared` must outlive this object.
  explicit TestBodies(Attributes& shared) : attributes{&shared} {}

  /// A dynamic solid sphere; returns its index. `density` [kg/m3], lengths [m], velocity [m/s].
  std::size_t add_sphere(BodyId body_id, const Vec3& centre, double sphere_radius, double density,
                         const Vec3& start_velocity = {}) {
    const double m = 4.0 / 3.0 * std::numbers::pi * sphere_radius * sphere_radius * sphere_radius * density;
    const double j = 0.4 * m * sphere_radius * sphere_radius;
    return add(body_id, Motion::dynamic, centre, sphere_radius, m, {j, j, j}, start_velocity);
  }

  /// A body that forces do not move (infinite mass); returns its index.
  std::size_t add_immovable(BodyId body_id, const Vec3& centre, Motion how = Motion::kinematic) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return add(body_id, how, centre, 0.0, kInfinite, {kInfinite, kInfinite, kInfinite}, {});
  }

  std::size_t add(BodyId body_id, Motion how, const Vec3& centre, double equivalent_radius, double m,
                  const Vec3& principal, const Vec3& start_velocity) {
    id.push_back(body_id);
    motion.push_back(how);
    shape.push_back(0);
    material.push_back(0);
    position.push_back(centre);
    orientation.emplace_back();
    velocity.push_back(start_velocity);
    angular_velocity.emplace_back();
    mass.push_back(m);
    inertia.push_back(principal);
    radius.push_back(equivalent_radius);
    force.emplace_back();
    torque.emplace_back();
    if (!surface_motion.empty()) surface_motion.emplace_back();
    attributes->resize(id.size());
    return id.size() - 1;
  }

  [[nodiscard]] BodyView view() const {
    return {id,   motion,  shape,  material,   position, orientation,   velocity, angular_velocity,
            mass, inertia, radius, attributes, {},       surface_motion};
  }
  /// Forces and torques set to zero, ready to be added to.
  [[nodiscard]] WrenchView wrenches() {
    std::fill(force.begin(), force.end(), Vec3{});
    std::fill(torque.begin(), torque.end(), Vec3{});
    return {force, torque};
  }

  std::vector<BodyId> id;
  std::vector<Motion> motion;
  std::vector<std::uint32_t> shape;
  std::vector<std::uint32_t> material;
  std::vector<Vec3> position;          ///< [m]
  std::vector<Quat> orientation;       ///< body to world [1]
  std::vector<Vec3> velocity;          ///< [m/s]
  std::vector<Vec3> angular_velocity;  ///< [rad/s]
  std::vector<double> mass;            ///< [kg]
  std::vector<Vec3> inertia;           ///< [kg m2]
  std::vector<double> radius;          ///< [m]
  std::vector<Twist> surface_motion;   ///< body frame [m/s], [rad/s]; empty, or one per body
  std::vector<Vec3> force;             ///< [N]
  std::vector<Vec3> torque;            ///< [N m]
  Attributes* attributes;
};

}  // namespace scree::test
