#include "scree/machine/prescribed/pose_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scree/machine/functions/time_series.hpp"

namespace scree {

Vec3 rotation_vector(const Quat& q) {
  // The quaternion and its opposite are one rotation: take the one that turns by less than pi.
  const double sign = q.w < 0.0 ? -1.0 : 1.0;
  const Vec3 v = sign * Vec3{q.x, q.y, q.z};
  const double sine = norm(v);
  // angle / sine of its half; 2 (1 + s^2 / 6) near zero, the next term below rounding.
  const double factor = sine < 1e-4 ? 2.0 + sine * sine / 3.0 : 2.0 * std::atan2(sine, sign * q.w) / sine;
  return factor * v;
}

PosePath PosePath::read(const std::filesystem::path& file, const SourceLocation& where) {
  static constexpr std::array<std::size_t, 2> kColumns{3, 7};
  const TimeSeries series =
      read_time_series(file, kColumns, "four numbers: time [s], x, y, z [m]; or these and qw, qx, qy, qz", where);
  PosePath path;
  path.times_ = series.times;
  for (std::size_t k = 0; k < series.times.size(); ++k) {
    const std::span<const double> row = series.row(k);
    path.positions_.push_back({row[0], row[1], row[2]});
    if (series.columns < kColumns[1]) continue;
    const double length = std::hypot(std::hypot(row[3], row[4]), std::hypot(row[5], row[6]));
    if (std::abs(length - 1.0) > 1e-3) {
      throw Error{
          ErrorKind::usage,
          {file.string(), series.lines[k], 0},
          fmt::format("the quaternion has the length {}, but must have 1; its order is qw, qx, qy, qz", length)};
    }
    path.orientations_.push_back(normalized(Quat{row[3], row[4], row[5], row[6]}));
  }
  return path;
}

Pose PosePath::at(double t) const {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times_, t) - times_.begin());
  const std::size_t a = next == 0 ? 0 : next - 1, b = std::min(next, times_.size() - 1);
  const double share = a == b ? 0.0 : (t - times_[a]) / (times_[b] - times_[a]);
  Pose pose;
  pose.position = positions_[a] + share * (positions_[b] - positions_[a]);
  if (!has_orientations()) return pose;
  const Vec3 turn = rotation_vector(orientations_[b] * conjugate(orientations_[a]));
  pose.orientation = normalized(from_rotation_vector(share * turn) * orientations_[a]);
  return pose;
}

}  // namespace scree
