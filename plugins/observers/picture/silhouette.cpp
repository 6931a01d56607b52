#include "silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree {

namespace {

constexpr int kSegments = 120;        // of a full circle
constexpr double kSeenAlong = 0.999;  // cosine between an axis and the direction of view, for "end-on"

double angle_of(int segment) { return 2.0 * std::numbers::pi * segment / kSegments; }

/// Collects the silhouettes of one primitive after the other.
class SilhouetteBuilder {
 public:
  SilhouetteBuilder(const ShapeSet& shapes, const Projection& projection, std::vector<Silhouette>& out)
      : shapes_{shapes}, projection_{projection}, out_{out} {}

  void add(const Primitive& p, const Pose& pose) {
    pose_ = pose;
    primitive_ = &p;
    corners_.clear();
    switch (p.kind) {
      case ShapeKind::sphere:
        return disc({}, p.size.x);
      case ShapeKind::sphere_cluster:
        for (const Sphere& ball : shapes_.spheres().subspan(p.first_sphere, p.sphere_count)) {
          disc(ball.centre, ball.radius);
        }
        return;
      case ShapeKind::box:
        for (int k = 0; k < 8; ++k)
          corner(hadamard(p.size, {k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0}));
        break;
      case ShapeKind::cylinder:
        ring(p.size.x, p.size.y);
        ring(p.size.x, -p.size.y);
        break;
      case ShapeKind::cone:
        ring(p.size.x, -p.size.y);
        corner({0.0, 0.0, p.size.y});
        break;
      case ShapeKind::capsule:
        circle({0.0, 0.0, p.size.y}, p.size.x);
        circle({0.0, 0.0, -p.size.y}, p.size.x);
        break;
      case ShapeKind::ellipsoid:
        ellipsoid(p.size);
        break;
      case ShapeKind::convex_hull:
        for (const Vec3& vertex : shapes_.vertices().subspan(p.first_vertex, p.vertex_count)) corner(vertex);
        break;
      case ShapeKind::triangle_mesh:
        return mesh();
      case ShapeKind::plane:
        return;
    }
    polygon();
  }

 private:
  void corner(const Vec3& local) { corners_.push_back(projection_(transform(pose_, local))); }
  void ring(double radius, double height) {
    for (int s = 0; s < kSegments; ++s) {
      corner({radius * std::cos(angle_of(s)), radius * std::sin(angle_of(s)), height});
    }
  }
  // The outline of a ball, which is a circle from everywhere.
  void circle(const Vec3& local, double radius) {
    const Point2 centre = projection_(transform(pose_, local));
    for (int s = 0; s < kSegments; ++s) {
      corners_.push_back(centre + radius * Point2{std::cos(angle_of(s)), std::sin(angle_of(s))});
    }
  }
  // The outline of an ellipsoid: stretched to a ball, the direction of view is stretched as well.
  void ellipsoid(const Vec3& half_axes) {
    const Vec3 view = rotate_back(pose_.orientation, projection_.to_viewer());
    const Vec3 stretched = normalized(Vec3{view.x / half_axes.x, view.y / half_axes.y, view.z / half_axes.z});
    const Vec3 across = normalized(cross(stretched, std::abs(stretched.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 other = cross(stretched, across);
    for (int s = 0; s < kSegments; ++s) {
      corner(hadamard(half_axes, std::cos(angle_of(s)) * across + std::sin(angle_of(s)) * other));
    }
  }
  void disc(const Vec3& local, double radius) {
    const Vec3 centre = transform(pose_, local);
    out_.push_back({projection_(centre), radius, {}, projection_.depth(centre), primitive_->collides, false, centre});
  }
  void polygon() {
    const double along = std::abs(dot(rotate(pose_.orientation, {0, 0, 1}), projection_.to_viewer()));
    const bool hollow = primitive_->hollow && along > kSeenAlong;
    out_.push_back({projection_(pose_.position), 0.0, convex_outline(corners_), projection_.depth(pose_.position),
                    primitive_->collides, hollow, pose_.position});
  }
  void mesh() {
    const auto triangles = shapes_.triangles().subspan(primitive_->first_triangle, primitive_->triangle_count);
    for (const Triangle& t : triangles) {
      corners_.clear();
      for (const std::uint32_t vertex : t) corner(shapes_.vertices()[vertex]);
      const Vec3 middle = (shapes_.vertices()[t[0]] + shapes_.vertices()[t[1]] + shapes_.vertices()[t[2]]) / 3.0;
      const Vec3 centre = transform(pose_, middle);
      out_.push_back({projection_(centre), 0.0, convex_outline(corners_), projection_.depth(centre),
                      primitive_->collides, false, centre});
    }
  }

  const ShapeSet& shapes_;
  const Projection& projection_;
  std::vector<Silhouette>& out_;
  const Primitive* primitive_ = nullptr;
  Pose pose_;
  std::vector<Point2> corners_;
};

}  // namespace

std::vector<Point2> convex_outline(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(), [](Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point2> hull;
  // The lower chain from left to right, then the upper one back.
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t first = hull.size();
    for (const Point2 p : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    if (hull.size() > 1) hull.pop_back();  // it begins the other chain
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

void append_silhouettes(const ShapeSet& shapes, const Shape& shape, const Pose& body, const Projection& projection,
                        std::vector<Silhouette>& out) {
  SilhouetteBuilder build{shapes, projection, out};
  for (const Primitive& primitive : shapes.primitives(shape)) build.add(primitive, body * primitive.local);
}

void include(const Silhouette& silhouette, Window& window) {
  if (silhouette.radius > 0.0) window.include(silhouette.centre, silhouette.radius);
  for (const Point2 corner : silhouette.outline) window.include(corner);
}

bool covers(const Silhouette& silhouette, Point2 point) {
  const Point2 arm = point - silhouette.centre;
  if (silhouette.radius > 0.0) return std::hypot(arm.x, arm.y) <= silhouette.radius;
  const std::vector<Point2>& corners = silhouette.outline;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 next = corners[(i + 1) % corners.size()];
    if (cross(next - corners[i], point - corners[i]) < 0.0) return false;
  }
  return corners.size() > 2;
}

}  // namespace scree
