// Projection: from the world onto the plane of an orthographic picture.
//
//     p = (x . right, x . up)            where a point x of the world lies in the picture [m]
//     depth = x . (right x up)           how near it is to the viewer [m]
#pragma once

#include <string>

#include "scree/math/vec3.hpp"

namespace scree {

/// A point of the picture's plane [m].
struct Point2 {
  double x = 0.0, y = 0.0;
};

constexpr Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }
constexpr double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

/// A rectangle of the picture's plane; empty when lower > upper.
struct Window {
  Point2 lower, upper;  ///< [m]

  static Window empty();
  /// Grows to hold the disc of `radius` [m] about a point.
  void include(Point2 point, double radius = 0.0);
  [[nodiscard]] double width() const { return upper.x - lower.x; }
  [[nodiscard]] double height() const { return upper.y - lower.y; }
  [[nodiscard]] bool is_empty() const { return !(lower.x <= upper.x && lower.y <= upper.y); }
};

/// `window` with a margin, and with its short edge at least a third of the long one. An empty one becomes 1 m x 1 m.
[[nodiscard]] Window with_margin(const Window& window);

/// Looks along -(right x up).
class Projection {
 public:
  /// `right` and `up` are unit vectors at a right angle.
  Projection(const Vec3& right, const Vec3& up) : right_{right}, up_{up}, to_viewer_{cross(right, up)} {}

  [[nodiscard]] Point2 operator()(const Vec3& x) const { return {dot(x, right_), dot(x, up_)}; }
  [[nodiscard]] double depth(const Vec3& x) const { return dot(x, to_viewer_); }
  [[nodiscard]] const Vec3& right() const { return right_; }
  [[nodiscard]] const Vec3& up() const { return up_; }
  [[nodiscard]] const Vec3& to_viewer() const { return to_viewer_; }

 private:
  Vec3 right_, up_, to_viewer_;  // unit [1]
};

/// "x [m]" for a direction along a world axis, "-x [m]" against it, else "`otherwise` [m]".
[[nodiscard]] std::string axis_label(const Vec3& direction, const std::string& otherwise);

}  // namespace scree
