// Quat: unit quaternions for orientations, Hamilton convention, stored w first.
//
// q maps the body frame to the world: v_world = q v_body q*. Products compose
// as matrices do: (p q) v = p (q v).
#pragma once

#include "scree/math/mat3.hpp"

namespace scree {

/// A quaternion w + x i + y j + z k; an orientation when its norm is one [1].
struct Quat {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr bool operator==(const Quat&) const = default;
};

constexpr Quat conjugate(const Quat& q) { return {q.w, -q.x, -q.y, -q.z}; }

constexpr Quat operator*(const Quat& p, const Quat& q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}

/// q / |q|; the identity when |q| is zero.
inline Quat normalized(const Quat& q) {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return n > 0.0 ? Quat{q.w / n, q.x / n, q.y / n, q.z / n} : Quat{};
}

/// Rotates v from the body frame to the world.
constexpr Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

/// Rotates v from the world to the body frame.
constexpr Vec3 rotate_back(const Quat& q, const Vec3& v) { return rotate(conjugate(q), v); }

/// The rotation matrix of q (columns are the body axes in the world).
constexpr Mat3 to_matrix(const Quat& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
          {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
          {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}};
}

/// Exponential map: the rotation by |v| radians about v. Exact at v = 0.
inline Quat from_rotation_vector(const Vec3& v) {
  const double angle = norm(v);
  // sin(a/2)/a by its series near zero: the next term is below rounding.
  const double s = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * v.x, s * v.y, s * v.z};
}

/// The shortest rotation that takes the unit vector `from` to the unit vector
/// `to`.
inline Quat rotation_between(const Vec3& from, const Vec3& to) {
  const double c = dot(from, to);
  if (c < -1.0 + 1e-14) {
    const Vec3 axis = std::abs(from.x) < 0.9 ? cross(from, {1, 0, 0}) : cross(from, {0, 1, 0});
    const Vec3 n = normalized(axis);
    return {0.0, n.x, n.y, n.z};
  }
  const Vec3 n = cross(from, to);
  return normalized(Quat{1.0 + c, n.x, n.y, n.z});
}

}  // namespace scree
