#include "scree/model/shape_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "scree/base/release.hpp"

namespace scree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Largest distance of the solid from the primitive's origin.
double bounding_radius_of(const PrimitiveData& data) {
  const Vec3& s = data.primitive.size;
  double radius = 0.0;
  switch (data.primitive.kind) {
    case ShapeKind::sphere:
      return s.x;
    case ShapeKind::box:
      return norm(s);
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return std::hypot(s.x, s.y);
    case ShapeKind::capsule:
      return s.x + s.y;
    case ShapeKind::ellipsoid:
      return std::max({s.x, s.y, s.z});
    case ShapeKind::plane:
      return kInfinity;
    case ShapeKind::sphere_cluster:
      for (const Sphere& sphere : data.spheres) radius = std::max(radius, norm(sphere.centre) + sphere.radius);
      return radius;
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh:
      for (const Vec3& v : data.vertices) radius = std::max(radius, norm(v));
      return radius;
  }
  return radius;
}

/// Appends `items` to `buffer` and stores the range.
template <class T>
void append(std::vector<T>& buffer, const std::vector<T>& items, std::uint32_t& first, std::uint32_t& count) {
  first = static_cast<std::uint32_t>(buffer.size());
  count = static_cast<std::uint32_t>(items.size());
  buffer.insert(buffer.end(), items.begin(), items.end());
}

/// Half extents of a disc of radius r with unit axis a, along the world's axes.
Vec3 disc_extent(const Vec3& a, double r) {
  const auto side = [&](double c) { return r * std::sqrt(std::max(0.0, 1.0 - c * c)); };
  return {side(a.x), side(a.y), side(a.z)};
}

Vec3 absolute(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

Aabb around(const Vec3& centre, const Vec3& half) { return {centre - half, centre + half}; }

Aabb plane_bounds(const Pose& world) {
  // A half space is bounded on one side only, and only when its normal lies along an axis.
  Aabb box = Aabb::everywhere();
  const Vec3 n = rotate(world.orientation, {0, 0, 1});
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] > 1.0 - 1e-12) box.upper[axis] = world.position[axis];
    if (n[axis] < -1.0 + 1e-12) box.lower[axis] = world.position[axis];
  }
  return box;
}

}  // namespace

const char* to_string(ShapeKind kind) {
  static constexpr std::array<const char*, kShapeKindCount> kNames{
      "sphere", "sphere_cluster", "box",         "cylinder",      "capsule",
      "cone",   "plane",          "convex_hull", "triangle_mesh", "ellipsoid"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::uint32_t ShapeSet::add(const ShapeData& data) {
  Shape shape;
  shape.volume = data.volume;
  shape.unit_inertia = data.unit_inertia;
  shape.equivalent_radius = std::cbrt(3.0 * data.volume / (4.0 * std::numbers::pi));
  shape.first_primitive = static_cast<std::uint32_t>(primitives_.size());
  shape.primitive_count = static_cast<std::uint32_t>(data.primitives.size());
  grow_to(primitives_.size() + data.primitives.size(), primitives_);
  grow_to(shapes_.size() + 1, shapes_);
  for (const PrimitiveData& part : data.primitives) {
    Primitive primitive = part.primitive;
    append(spheres_, part.spheres, primitive.first_sphere, primitive.sphere_count);
    append(faces_, part.faces, primitive.first_face, primitive.face_count);
    const auto base = static_cast<std::uint32_t>(vertices_.size());
    append(vertices_, part.vertices, primitive.first_vertex, primitive.vertex_count);
    primitive.first_triangle = static_cast<std::uint32_t>(triangles_.size());
    primitive.triangle_count = static_cast<std::uint32_t>(part.triangles.size());
    for (const Triangle& t : part.triangles) triangles_.push_back({t[0] + base, t[1] + base, t[2] + base});
    primitive.bounding_radius = bounding_radius_of(part);
    shape.bounding_radius = std::max(shape.bounding_radius, norm(primitive.local.position) + primitive.bounding_radius);
    primitives_.push_back(primitive);
  }
  const auto index = static_cast<std::uint32_t>(shapes_.size());
  shapes_.push_back(shape);
  write_down(index, data.name, data.body_to_shape);
  return index;
}

void ShapeSet::write_down(std::uint32_t shape, std::string_view name, const Pose& body_to_shape) {
  if (name.empty() && body_to_shape == Pose{}) return;
  written_.push_back({shape, std::string{name}, body_to_shape});
}

const ShapeSet::Written* ShapeSet::written(std::uint32_t shape) const {
  const auto found = std::ranges::lower_bound(written_, shape, {}, &Written::shape);
  return found != written_.end() && found->shape == shape ? &*found : nullptr;
}

std::string_view ShapeSet::name(std::uint32_t shape) const {
  const Written* const known = written(shape);
  return known == nullptr ? std::string_view{} : known->name;
}

Pose ShapeSet::body_to_shape(std::uint32_t shape) const {
  const Written* const known = written(shape);
  return known == nullptr ? Pose{} : known->body_to_shape;
}

std::int64_t ShapeSet::find(std::string_view name) const {
  const auto found = std::ranges::find(written_, name, &Written::name);
  return found == written_.end() ? -1 : std::int64_t{found->shape};
}

Aabb bounds(const ShapeSet& shapes, const Primitive& primitive, const Pose& world) {
  const Vec3& s = primitive.size;
  const Vec3& c = world.position;
  switch (primitive.kind) {
    case ShapeKind::sphere:
      return around(c, {s.x, s.x, s.x});
    case ShapeKind::box: {
      const Mat3 r = to_matrix(world.orientation);
      return around(c, {dot(absolute(r.row0), s), dot(absolute(r.row1), s), dot(absolute(r.row2), s)});
    }
    case ShapeKind::cylinder: {
      const Vec3 a = rotate(world.orientation, {0, 0, 1});
      return around(c, disc_extent(a, s.x) + s.y * absolute(a));
    }
    case ShapeKind::capsule: {
      const Vec3 a = rotate(world.orientation, {0, 0, 1});
      return around(c, Vec3{s.x, s.x, s.x} + s.y * absolute(a));
    }
    case ShapeKind::cone: {
      const Vec3 a = rotate(world.orientation, {0, 0, 1});
      return merged(around(c - s.y * a, disc_extent(a, s.x)), c + s.y * a);
    }
    case ShapeKind::ellipsoid: {
      // Along a world axis the support of the ball that it is in stretched coordinates.
      const Mat3 r = to_matrix(world.orientation);
      return around(c, {norm(hadamard(r.row0, s)), norm(hadamard(r.row1, s)), norm(hadamard(r.row2, s))});
    }
    case ShapeKind::plane:
      return plane_bounds(world);
    case ShapeKind::sphere_cluster: {
      Aabb box = Aabb::empty();
      for (const Sphere& sphere : shapes.spheres().subspan(primitive.first_sphere, primitive.sphere_count)) {
        const double r = sphere.radius;
        box = merged(box, around(transform(world, sphere.centre), {r, r, r}));
      }
      return box;
    }
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh: {
      Aabb box = Aabb::empty();
      for (const Vec3& v : shapes.vertices().subspan(primitive.first_vertex, primitive.vertex_count)) {
        box = merged(box, transform(world, v));
      }
      return box;
    }
  }
  return Aabb::everywhere();
}

}  // namespace scree
