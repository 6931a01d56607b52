// Zone: the part of space in which grains are charged (by the corona) or discharged (by a brush).
//
//     box       lower <= x <= upper, in the world
//     sector    about the roll's axis: angles `from` to `to`, radii `inner_radius` to `outer_radius`,
//               at most `half_width` from the middle of the roll
//
// Angles count counter-clockwise seen from the tip of the roll's axis, from the world's x direction (projected; y for
// a roll along x). For a roll along z they are the usual polar angles, 0 at +x and 90 degrees at +y.
#pragma once

#include <vector>

#include "roll.hpp"
#include "scree/config/options.hpp"
#include "scree/math/aabb.hpp"

namespace scree {

/// A box or a sector.
class Zone {
 public:
  /// `options` is one alternative of variants().
  /// @throws Error (usage) when the zone is empty.
  explicit Zone(const Options& options);
  static std::vector<Variant> variants();

  /// Fixes a sector to its roll; before the first contains().
  void attach(const Roll& roll);
  /// `point` [m], world; `there` is the same point as to_roll() gives it.
  [[nodiscard]] bool contains(const Vec3& point, const RollCoordinates& there) const;

 private:
  [[nodiscard]] bool in_sector(const RollCoordinates& there) const;

  bool is_box_;
  Aabb box_;                                                           ///< [m], world
  double from_ = 0.0;                                                  ///< [rad]
  double width_ = 0.0;                                                 ///< angle between both ends [rad]
  double inner_radius_ = 0.0, outer_radius_ = 0.0, half_width_ = 0.0;  ///< [m]
  Vec3 axis_, first_, last_;  ///< of the roll, and directions of both ends [1], world
};

}  // namespace scree
