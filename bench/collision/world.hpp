// World: bodies to collide, and a contender that finds their contacts frame by frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scree/math/quat.hpp"
#include "scree/math/vec3.hpp"

namespace scree::bench {

/// Spheres, or hulls of their own points.
struct World {
  std::vector<Vec3> position;           ///< [m]
  std::vector<Quat> orientation;        ///< [1]
  std::vector<double> radius;           ///< of the sphere, or of that about the hull [m]
  std::vector<std::vector<Vec3>> hull;  ///< points of each body [m], body frame; empty for spheres
  double mean_radius = 0.0;             ///< [m]

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Two bodies that touch, a < b, and the smallest gap of their contacts [m].
struct Touch {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double gap = 0.0;  ///< [m], not positive
};

/// Somebody's collision pipeline.
class Contender {
 public:
  virtual ~Contender() = default;
  /// Moves the bodies and finds all contacts; returns their number. This is what is timed.
  virtual std::size_t frame(const std::vector<Vec3>& position) = 0;
  /// The pairs of the last frame that touch, sorted.
  [[nodiscard]] virtual std::vector<Touch> touches() const = 0;
};

/// Bullet's own world (float64, btDbvtBroadphase), lengths scaled to a mean radius of `scale`.
[[nodiscard]] std::unique_ptr<Contender> make_bullet_world(const World& world, double scale);
/// FCL's manager of a dynamic tree, with its own callback and libccd.
[[nodiscard]] std::unique_ptr<Contender> make_fcl_manager(const World& world);
/// scree's pipeline: a broad phase and a chain of narrow phases.
[[nodiscard]] std::unique_ptr<Contender> make_scree(const World& world, const std::string& broad,
                                                    const std::vector<std::string>& chain, int threads);

}  // namespace scree::bench
