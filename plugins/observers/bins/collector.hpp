// Collector: the rectangle that bodies fall through, and its bins.
//
//     x(a, b) = origin + a u + b v,   0 <= a < 1, 0 <= b < 1        a point of the rectangle
//     n = u x v / |u x v|                                           its normal
//
// A body crosses where the segment between its centres of mass at the beginning and the end of a step meets the plane.
// Being on the plane counts as being on the side of the normal, so that no crossing is seen twice or never.
#pragma once

#include <cstdint>
#include <optional>

#include "scree/math/vec3.hpp"

namespace scree {

/// Which crossings count.
enum class Direction { forward, backward, both };

/// A crossing of the plane of a collector.
struct Crossing {
  double a = 0.0;         ///< along u, 0..1 inside [1]
  double b = 0.0;         ///< along v, 0..1 inside [1]
  double fraction = 0.0;  ///< of the step that had passed [1]
};

/// A rectangle (or parallelogram) divided into u_bins x v_bins bins.
class Collector {
 public:
  /// u and v [m] must not be parallel. @throws std::logic_error.
  Collector(const Vec3& origin, const Vec3& u, const Vec3& v, int u_bins, int v_bins, Direction direction);

  /// The crossing of the plane by a step from one place to another [m], if there is one in a direction that counts.
  [[nodiscard]] std::optional<Crossing> crossing(const Vec3& from, const Vec3& to) const;
  /// The bin of a crossing, iv * u_bins + iu, or -1 outside of the rectangle.
  [[nodiscard]] std::int64_t bin(const Crossing& crossing) const;

  [[nodiscard]] const Vec3& origin() const { return origin_; }  ///< [m]
  [[nodiscard]] const Vec3& u() const { return u_; }            ///< [m]
  [[nodiscard]] const Vec3& v() const { return v_; }            ///< [m]
  [[nodiscard]] int u_bins() const { return u_bins_; }
  [[nodiscard]] int v_bins() const { return v_bins_; }
  [[nodiscard]] std::size_t bins() const {
    return static_cast<std::size_t>(u_bins_) * static_cast<std::size_t>(v_bins_);
  }

 private:
  Vec3 origin_, u_, v_;  // [m]
  Vec3 normal_;          // unit [1]
  Vec3 along_a_;         // a = along_a . (x - origin) [1/m]
  Vec3 along_b_;         // [1/m]
  int u_bins_, v_bins_;
  Direction direction_;
};

}  // namespace scree
