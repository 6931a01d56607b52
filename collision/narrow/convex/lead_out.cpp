// What has gone into a closed mesh whole, so that no triangle holds it back.
#include <algorithm>
#include <cmath>

#include "pair.hpp"

namespace scree::convex {

std::unique_ptr<MeshDistance> make_inside(const ShapeSet& shapes, const Primitive& mesh) {
  TriangleMesh own;
  const auto vertices = shapes.vertices().subspan(mesh.first_vertex, mesh.vertex_count);
  own.vertices.assign(vertices.begin(), vertices.end());
  for (Triangle t : shapes.triangles().subspan(mesh.first_triangle, mesh.triangle_count)) {
    for (std::uint32_t& corner : t) corner -= mesh.first_vertex;
    own.triangles.push_back(t);
  }
  return check_mesh(own).is_solid() ? std::make_unique<MeshDistance>(std::move(own)) : nullptr;
}

Vec3 ConvexPhase::middle_of(std::uint32_t primitive) const {
  const Primitive& p = shapes_->primitives()[primitive];
  if (p.vertex_count == 0) return {};
  Vec3 sum;
  for (const Vec3& v : shapes_->vertices().subspan(p.first_vertex, p.vertex_count)) sum += v;
  return sum / static_cast<double>(p.vertex_count);
}

bool ConvexPhase::lead_out(Pair& pair, bool mesh_first) const {
  const std::uint32_t mesh = mesh_first ? pair.a : pair.b, other = mesh_first ? pair.b : pair.a;
  const Primitive& solid = shapes_->primitives()[other];
  if (inside_[mesh] == nullptr || solid.kind == ShapeKind::plane) return false;
  bool is_inside = false;
  if (solid.kind != ShapeKind::sphere_cluster) return lead_part_out(pair, mesh_first, 0, middle_of(other), is_inside);
  // The middle of a cluster may lie beside all of its spheres.
  for (std::uint32_t part = 0; part < solid.sphere_count; ++part) {
    is_inside = lead_part_out(pair, mesh_first, part, shapes_->spheres()[solid.first_sphere + part].centre, is_inside);
  }
  return is_inside;
}

bool ConvexPhase::lead_part_out(Pair& pair, bool mesh_first, std::uint32_t part, const Vec3& own_middle,
                                bool is_inside) const {
  const std::uint32_t mesh = mesh_first ? pair.a : pair.b, other = mesh_first ? pair.b : pair.a;
  const Primitive& solid = shapes_->primitives()[other];
  const Pose& pose = pair.colliders.pose[mesh_first ? pair.pair.a : pair.pair.b];
  const Pose& placed = pair.colliders.pose[mesh_first ? pair.pair.b : pair.pair.a];
  const MeshDistance& inside = *inside_[mesh];
  const auto in_mesh = [&](const Vec3& p) { return transform_back(pose, transform(placed, p)); };
  const Vec3 middle = in_mesh(own_middle);
  if (!contains(meshes_[mesh]->box(), middle)) return is_inside;
  const MeshDistance::Closest nearest = inside.closest(middle);
  if (!(nearest.distance < 0.0)) return is_inside;
  const auto corners = shapes_->vertices().subspan(solid.first_vertex, solid.vertex_count);
  // So may that of a bent mesh.
  const bool is_mesh = solid.kind == ShapeKind::triangle_mesh;
  if (is_mesh && !(inside.signed_distance(in_mesh(corners[0])) < 0.0)) return is_inside;
  if (!is_inside) pair.out.resize(pair.begin);
  const Triangle& t = inside.mesh().triangles[nearest.triangle];
  const auto& v = inside.mesh().vertices;
  const Vec3 up = rotate(pose.orientation, normalized(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]])));
  const Vec3 foot = transform(pose, nearest.point);
  const auto triangle = static_cast<std::uint64_t>(nearest.triangle);
  const std::uint64_t parts =
      mesh_first ? triangle * part_count(other) + part : part * inside.mesh().triangles.size() + triangle;
  if (!is_mesh) {
    touch_plane(pair, part, mesh_first, foot, up, parts);
    return true;
  }
  const auto height = [&](const Vec3& corner) { return dot(up, transform(placed, corner) - foot); };
  const Vec3& deepest = *std::ranges::min_element(corners, {}, height);
  const double gap = height(deepest) / pair.size;
  const Vec3 at = (transform(placed, deepest) - pair.origin) / pair.size;
  pair.add(parts << kPartShift, at - 0.5 * gap * up, mesh_first ? up : -up, gap);
  return true;
}

}  // namespace scree::convex
