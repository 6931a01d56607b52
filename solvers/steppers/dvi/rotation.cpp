#include "rotation.hpp"

#include <algorithm>

namespace scree::dvi {

namespace {

// Cramer's rule: a 3 x 3 system given by the rows of a.
Vec3 solved(const Mat3& a, const Vec3& b) {
  const Mat3 t = transpose(a);  // rows of t: columns of a
  const Vec3 c12 = cross(t.row1, t.row2);
  const double determinant = dot(t.row0, c12);
  return Vec3{dot(b, c12), dot(t.row0, cross(b, t.row2)), dot(t.row0, cross(t.row1, b))} / determinant;
}

}  // namespace

Vec3 gyroscopic_change(const Vec3& inertia, const Vec3& w, double h) {
  if (inertia.x == inertia.y && inertia.y == inertia.z) return {};
  const Mat3 i = Mat3::diagonal(inertia);
  const double scale = norm(hadamard(inertia, w));
  Vec3 next = w;
  // Newton: quadratic, so that a handful of iterations reach rounding for any h |w| met in practice.
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vec3 mean = 0.5 * (w + next);
    const Vec3 momentum = hadamard(inertia, mean);
    const Vec3 error = hadamard(inertia, next - w) - h * cross(momentum, mean);
    if (norm(error) <= 1e-16 * scale) break;
    Mat3 slope = skew(momentum) + Mat3::diagonal({-1, -1, -1}) * (skew(mean) * i);
    slope = Mat3::diagonal({-0.5 * h, -0.5 * h, -0.5 * h}) * slope;
    next -= solved(i + slope, error);
  }
  return next - w;
}

Vec3 cayley_angle(const Vec3& angle) {
  const double half = 0.5 * norm(angle);
  // atan(x) / x by its series near zero: the next term is below rounding.
  const double factor = half < 1e-4 ? 1.0 - half * half / 3.0 : std::atan(half) / half;
  return factor * angle;
}

}  // namespace scree::dvi
