// PosePath: poses over time from a text file.
#pragma once

#include <filesystem>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/math/pose.hpp"

namespace scree {

/// Straight from position to position, by the shortest turn from orientation to orientation; held before and after.
class PosePath {
 public:
  /// Rows of time [s], x, y, z [m], and, in all rows or in none, a unit quaternion qw, qx, qy, qz (body to world).
  /// @throws Error (io, usage) as read_time_series(), and at its line for a quaternion that is not of unit length.
  static PosePath read(const std::filesystem::path& file, const SourceLocation& where);

  [[nodiscard]] bool has_orientations() const { return !orientations_.empty(); }
  /// At time `t` [s]; without orientations, of the identity.
  [[nodiscard]] Pose at(double t) const;

 private:
  std::vector<double> times_;  // [s]
  std::vector<Vec3> positions_;
  std::vector<Quat> orientations_;  // empty or one per time
};

/// The rotation vector of the shortest turn that `q` stands for [rad].
[[nodiscard]] Vec3 rotation_vector(const Quat& q);

}  // namespace scree
