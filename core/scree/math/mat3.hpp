// Mat3: a 3 x 3 matrix stored by rows.
#pragma once

#include "scree/math/vec3.hpp"

namespace scree {

/// A 3 x 3 matrix in [any unit], given by its rows; its unit and frames are stated where it is declared.
struct Mat3 {
  Vec3 row0;
  Vec3 row1;
  Vec3 row2;

  constexpr bool operator==(const Mat3&) const = default;
  static constexpr Mat3 diagonal(const Vec3& d) { return {{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}; }
  static constexpr Mat3 identity() { return diagonal({1, 1, 1}); }
};

constexpr Vec3 operator*(const Mat3& m, const Vec3& v) { return {dot(m.row0, v), dot(m.row1, v), dot(m.row2, v)}; }

constexpr Mat3 transpose(const Mat3& m) {
  return {{m.row0.x, m.row1.x, m.row2.x}, {m.row0.y, m.row1.y, m.row2.y}, {m.row0.z, m.row1.z, m.row2.z}};
}

constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 t = transpose(b);
  return {t * a.row0, t * a.row1, t * a.row2};
}

constexpr Mat3 operator+(const Mat3& a, const Mat3& b) { return {a.row0 + b.row0, a.row1 + b.row1, a.row2 + b.row2}; }

/// The matrix of the cross product: skew(a) b = a x b.
constexpr Mat3 skew(const Vec3& a) { return {{0, -a.z, a.y}, {a.z, 0, -a.x}, {-a.y, a.x, 0}}; }

}  // namespace scree
