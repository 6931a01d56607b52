// Cylinders, cones and ellipsoids inside a drum.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drum_walls.hpp"
#include "farthest_on_ellipse.hpp"

namespace scree::polyhedron {
namespace {

constexpr std::uint32_t kPointsOfRim = 4;
/// Sine of a tilt that is none: of a rim that lies across the drum's axis any point may be the first.
constexpr double kLevel = 1e-9;
/// Points of a rim nearer than this to one that is there already are left out: cosine of 30 degrees.
constexpr double kNextTo = 0.86;

/// The rim of a disc as a wall sees it. Its points are centre + cosine along + sine across.
struct Rim {
  Vec3 centre, along, across;  // [m], drum's frame; `along` has no part along the drum's axis
  [[nodiscard]] Vec3 point(const EllipsePoint& at) const { return centre + at.cosine * along + at.sine * across; }
};

/// A rim about `axis`, a unit vector. Seen along the drum's axis, `along` and `across` are the half axes of its ellipse.
Rim make_rim(const Vec3& centre, const Vec3& axis, double radius) {
  const double tilt = std::hypot(axis.x, axis.y);
  const Vec3 along = tilt > kLevel ? Vec3{-axis.y / tilt, axis.x / tilt, 0.0} : Vec3{1.0, 0.0, 0.0};
  return {centre, radius * along, radius * cross(axis, along)};
}

/// Unit vector of the plane across the drum's axis that `across` leans to.
Vec3 flat_direction(const Rim& rim) {
  const Vec3 left = normalized(Vec3{-rim.along.y, rim.along.x, 0.0});
  return dot(left, rim.across) < 0.0 ? -left : left;
}

/// The places of a rim that come nearest to a wall.
FarthestPoints outermost(const Rim& rim, std::uint32_t wall) {
  if (wall == kMantle) {
    const double radius = norm(rim.along);
    const Vec3 flat = flat_direction(rim);
    return farthest_on_ellipse(radius, dot(flat, rim.across), dot(rim.along, rim.centre) / radius,
                               dot(flat, rim.centre));
  }
  // Of its points `across` alone rises; a rim that lies flat is as near everywhere.
  const double up = wall == 1 ? rim.across.z : -rim.across.z;
  FarthestPoints found;
  found.count = 1;
  found.point[0] = {0.0, std::copysign(1.0, up)};
  return found;
}

void touch_rim(const Drum& drum, std::uint32_t wall, const Rim& rim, std::uint32_t number, double reach,
               std::vector<MeshPoint>& out) {
  const FarthestPoints first = outermost(rim, wall);
  std::uint32_t corner = number * kPointsOfRim;
  for (std::size_t k = 0; k < first.count; ++k) touch(drum, wall, rim.point(first.point[k]), 0.0, corner++, reach, out);
  corner = number * kPointsOfRim + 2;
  const auto [c, s] = first.point[0];
  const double sine = 0.5 * std::numbers::sqrt3;
  for (const double turn : {sine, -sine}) {
    const EllipsePoint more{-0.5 * c - turn * s, -0.5 * s + turn * c};
    const EllipsePoint& other = first.point[first.count - 1];
    if (more.cosine * other.cosine + more.sine * other.sine < kNextTo)
      touch(drum, wall, rim.point(more), 0.0, corner, reach, out);
    ++corner;
  }
}

/// An ellipsoid: columns of `shape` are its half axes in the drum's frame [m].
struct Ellipsoid {
  Vec3 centre;
  Mat3 shape;
  /// The point farthest along `d` (of any length).
  [[nodiscard]] Vec3 support(const Vec3& d) const {
    const Vec3 own = transpose(shape) * d;
    return centre + shape * (own / norm(own));
  }
};

/// Seen along the drum's axis an ellipsoid is an ellipse; where that comes nearest to the mantle, so does the ellipsoid.
void touch_mantle(const Drum& drum, const Ellipsoid& solid, double reach, std::vector<MeshPoint>& out) {
  const Mat3 wide = solid.shape * transpose(solid.shape);
  const double xx = wide.row0.x, xy = wide.row0.y, yy = wide.row1.y;
  // Principal axes of the 2 x 2 part: half the angle of (xx - yy, 2 xy).
  const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const Vec3 along{std::cos(turn), std::sin(turn), 0.0}, across{-along.y, along.x, 0.0};
  const double alpha = norm(transpose(solid.shape) * along), beta = norm(transpose(solid.shape) * across);
  const FarthestPoints found =
      farthest_on_ellipse(std::max(alpha, beta), beta, dot(along, solid.centre), dot(across, solid.centre));
  for (std::uint32_t k = 0; k < found.count; ++k) {
    const auto [c, s] = found.point[k];
    touch(drum, kMantle, solid.support(c / alpha * along + s / beta * across), 0.0, k, reach, out);
  }
}

void touch_ellipsoid(const Drum& drum, const Vec3& half_axes, const Pose& in_drum, double reach,
                     std::vector<MeshPoint>& out) {
  const Ellipsoid solid{in_drum.position, to_matrix(in_drum.orientation) * Mat3::diagonal(half_axes)};
  touch_mantle(drum, solid, reach, out);
  touch(drum, 1, solid.support({0, 0, 1}), 0.0, 0, reach, out);
  touch(drum, 2, solid.support({0, 0, -1}), 0.0, 0, reach, out);
}

}  // namespace

void drum_contacts(const Drum& drum, ShapeKind kind, const Vec3& size, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out) {
  const bool ellipsoid = kind == ShapeKind::ellipsoid;
  const double bound = ellipsoid ? std::max({size.x, size.y, size.z}) : std::hypot(size.x, size.y);
  if (!is_near_wall(drum, in_drum.position, bound, reach)) return;
  if (ellipsoid) return touch_ellipsoid(drum, size, in_drum, reach, out);
  const Vec3 axis = rotate(in_drum.orientation, {0, 0, 1}), top = in_drum.position + size.y * axis;
  const Rim base = make_rim(in_drum.position - size.y * axis, axis, size.x), lid{top, base.along, base.across};
  for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
    touch_rim(drum, wall, base, 0, reach, out);
    if (kind == ShapeKind::cone) {
      touch(drum, wall, top, 0.0, kPointsOfRim, reach, out);
    } else {
      touch_rim(drum, wall, lid, 1, reach, out);
    }
  }
}

}  // namespace scree::polyhedron
