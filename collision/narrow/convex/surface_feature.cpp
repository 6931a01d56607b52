#include "surface_feature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scree/collision/contact.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::convex {
namespace {

constexpr std::size_t kRimCorners = 12;

/// The direction of d across the z axis; x where there is none.
Vec3 across(const Vec3& d) {
  const double length = std::hypot(d.x, d.y);
  return length > 1e-12 ? Vec3{d.x / length, d.y / length, 0.0} : Vec3{1.0, 0.0, 0.0};
}

void add_disc(double radius, double z, const Vec3& d, SurfaceFeature& out) {
  const Vec3 u = across(d);
  for (std::size_t k = 0; k < kRimCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kRimCorners);
    const double c = radius * std::cos(angle), s = radius * std::sin(angle);
    out.add({c * u.x - s * u.y, c * u.y + s * u.x, z});
  }
}

void add_cylinder(const Vec3& size, const Vec3& d, SurfaceFeature& out) {
  if (std::abs(d.z) > 0.7) return add_disc(size.x, std::copysign(size.y, d.z), d, out);
  const Vec3 side = size.x * across(d);
  out.add({side.x, side.y, std::copysign(size.y, d.z)});
  out.add({side.x, side.y, -std::copysign(size.y, d.z)});
}

void add_cone(const ConvexSolid& solid, const Vec3& d, SurfaceFeature& out) {
  const Vec3 rim = solid.size.x * across(d);
  const Vec3 mantle =
      normalized(Vec3{2.0 * solid.size.y * rim.x, 2.0 * solid.size.y * rim.y, solid.size.x * solid.size.x});
  if (dot(mantle, d) > 0.9) {
    out.add({rim.x, rim.y, -solid.size.y});
    out.add({0.0, 0.0, solid.size.y});
  } else if (d.z < -0.3) {
    add_disc(solid.size.x, -solid.size.y, d, out);
  } else {
    out.add(local_core_support(solid, d));
  }
}

void add_box(const Vec3& size, const Vec3& d, SurfaceFeature& out) {
  const Vec3 corner{std::copysign(size.x, d.x), std::copysign(size.y, d.y), std::copysign(size.z, d.z)};
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
  }
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const auto& [s, t] : {std::array{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}}) {
    Vec3 p = corner;
    p[u] *= s;
    p[v] *= t;
    out.add(p);
  }
}

/// The face with the most corners that are farthest along d; among equals, the one that faces d most.
void add_hull_face(const ConvexSolid& solid, const Vec3& d, SurfaceFeature& out) {
  const auto& v = solid.vertices;
  if (solid.loops == nullptr) {
    for (const Vec3& p : v) out.add(solid.scale * p);
    return;
  }
  const double level = 1e-9 * solid.bound;
  const double top = dot(local_core_support(solid, d), d) - level;
  std::size_t most = 0;
  double best_facing = -2.0;
  const std::vector<std::uint32_t>* face = nullptr;
  for (const auto& loop : *solid.loops) {
    const auto tied = static_cast<std::size_t>(
        std::ranges::count_if(loop, [&](std::uint32_t i) { return solid.scale * dot(v[i], d) >= top; }));
    if (tied == 0 || tied < most || loop.size() < 3) continue;
    const double facing = dot(normalized(cross(v[loop[1]] - v[loop[0]], v[loop[2]] - v[loop[0]])), d);
    if (tied == most && facing <= best_facing) continue;
    most = tied;
    best_facing = facing;
    face = &loop;
  }
  if (face == nullptr) return out.add(local_core_support(solid, d));
  for (const std::uint32_t i : *face) out.add(solid.scale * v[i]);
}

}  // namespace

SurfaceFeature surface_feature(const ConvexSolid& solid, const Vec3& d) {
  SurfaceFeature feature;
  const Vec3 local = rotate_back(solid.pose.orientation, d);
  if (solid.kind == ShapeKind::box) {
    add_box(solid.size, local, feature);
  } else if (solid.kind == ShapeKind::cylinder) {
    add_cylinder(solid.size, local, feature);
  } else if (solid.kind == ShapeKind::cone) {
    add_cone(solid, local, feature);
  } else if (solid.kind == ShapeKind::convex_hull) {
    add_hull_face(solid, local, feature);
  } else if (solid.kind == ShapeKind::capsule && std::abs(local.z) < 0.7) {
    feature.add({0.0, 0.0, std::copysign(solid.size.y, local.z)});
    feature.add({0.0, 0.0, -std::copysign(solid.size.y, local.z)});
  } else {
    feature.add(local_core_support(solid, local));
  }
  for (std::size_t i = 0; i < feature.count; ++i) {
    feature.corner[i] = transform(solid.pose, feature.corner[i]) + solid.round * d;
  }
  return feature;
}

FaceLoops face_loops(const ShapeSet& shapes, const Primitive& hull) {
  const auto vertices = shapes.vertices().subspan(hull.first_vertex, hull.vertex_count);
  FaceLoops loops;
  for (const Face& face : shapes.faces().subspan(hull.first_face, hull.face_count)) {
    std::vector<std::uint32_t> loop;
    Vec3 centre;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      if (face.offset - dot(face.normal, vertices[i]) > 1e-7 * hull.bounding_radius) continue;
      loop.push_back(i);
      centre += vertices[i];
    }
    centre = centre / static_cast<double>(std::max<std::size_t>(1, loop.size()));
    const ContactFrame frame = contact_frame(face.normal);
    const auto angle = [&](std::uint32_t i) {
      const Vec3 arm = vertices[i] - centre;
      return std::atan2(dot(arm, frame.tangent2), dot(arm, frame.tangent1));
    };
    std::ranges::sort(loop, {}, angle);
    if (std::ranges::find(loops, loop) == loops.end()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace scree::convex
