#include "convex_phase.hpp"

#include <algorithm>
#include <cmath>

#include "manifold.hpp"
#include "pair.hpp"
#include "scree/base/error.hpp"

namespace scree::convex {
namespace {

/// A fold by less is none [rad].
constexpr double kLevelFold = 1e-6;

bool is_mesh(const Primitive& p) { return p.kind == ShapeKind::triangle_mesh; }

}  // namespace

bool ConvexPhase::supports(ShapeKind a, ShapeKind b) const { return a != ShapeKind::plane || b != ShapeKind::plane; }

void ConvexPhase::bind(const ShapeSet& shapes, std::size_t first_new_primitive) {
  shapes_ = &shapes;
  const auto primitives = shapes.primitives();
  loops_.resize(primitives.size());
  meshes_.resize(primitives.size());
  inside_.resize(primitives.size());
  for (std::size_t i = first_new_primitive; i < primitives.size(); ++i) {
    if (primitives[i].kind == ShapeKind::convex_hull) loops_[i] = face_loops(shapes, primitives[i]);
    meshes_[i] = nullptr;
    inside_[i] = nullptr;
    if (!is_mesh(primitives[i])) continue;
    meshes_[i] = std::make_unique<SurfaceTree>(shapes, primitives[i]);
    if (meshes_[i]->closed()) inside_[i] = make_inside(shapes, primitives[i]);
  }
}

std::size_t ConvexPhase::part_count(std::uint32_t primitive) const {
  const Primitive& p = shapes_->primitives()[primitive];
  if (p.kind == ShapeKind::sphere_cluster) return p.sphere_count;
  return is_mesh(p) ? meshes_[primitive]->size() : 1;
}

ConvexSolid ConvexPhase::solid(const Pair& pair, std::uint32_t primitive, const Pose& pose, std::uint32_t part) const {
  const Primitive& p = shapes_->primitives()[primitive];
  const double scale = 1.0 / pair.size;
  ConvexSolid made;
  made.kind = p.kind;
  made.size = scale * p.size;
  made.scale = scale;
  made.bound = scale * p.bounding_radius;
  made.pose = {scale * (pose.position - pair.origin), pose.orientation};
  if (p.kind == ShapeKind::sphere || p.kind == ShapeKind::capsule) made.round = made.size.x;
  if (p.kind == ShapeKind::convex_hull) {
    made.vertices = shapes_->vertices().subspan(p.first_vertex, p.vertex_count);
    made.loops = &loops_[primitive];
  } else if (p.kind == ShapeKind::sphere_cluster) {
    const Sphere& s = shapes_->spheres()[p.first_sphere + part];
    made.kind = ShapeKind::sphere;
    made.round = made.bound = scale * s.radius;
    made.pose.position = scale * (transform(pose, s.centre) - pair.origin);
  } else if (is_mesh(p)) {
    made.kind = ShapeKind::convex_hull;
    made.vertices = meshes_[primitive]->triangle(part).corner;
  }
  return made;
}

void ConvexPhase::find_parts(const Pair& pair, std::uint32_t primitive, const Pose& pose, std::uint32_t other,
                             const Pose& other_pose, std::vector<std::uint32_t>& out) const {
  out.clear();
  const Primitive& p = shapes_->primitives()[primitive];
  const Primitive& o = shapes_->primitives()[other];
  if (is_mesh(p)) {
    const Aabb box = o.kind == ShapeKind::plane ? Aabb::everywhere() : bounds(*shapes_, o, inverse(pose) * other_pose);
    return meshes_[primitive]->find(expanded(box, pair.pair.reach), out);
  }
  for (std::uint32_t i = 0; i < part_count(primitive); ++i) {
    if (p.kind == ShapeKind::sphere_cluster && o.kind != ShapeKind::plane) {
      const Sphere& s = shapes_->spheres()[p.first_sphere + i];
      const double limit = s.radius + pair.pair.reach + o.bounding_radius;
      if (squared_norm(transform(pose, s.centre) - other_pose.position) > limit * limit) continue;
    }
    out.push_back(i);
  }
}

std::optional<Separation> ConvexPhase::separate(Pair& pair, const ConvexSolid& a, const ConvexSolid& b) const {
  const Vec3 way = b.pose.position - a.pose.position;
  const double far = norm(way);
  if (far - a.bound - b.bound >= pair.reach) return std::nullopt;
  if (far > 0.0 && separation(a, b, way / far) >= pair.reach) return std::nullopt;
  if (auto found = checked(a, b, ask(a, b))) return found;
  pair.fell_back = true;
  return best_climb(a, b);
}

void ConvexPhase::collide_parts(Pair& pair, std::uint32_t part_a, std::uint32_t part_b) const {
  const Pose& pose_a = pair.colliders.pose[pair.pair.a];
  const Pose& pose_b = pair.colliders.pose[pair.pair.b];
  const ConvexSolid a = solid(pair, pair.a, pose_a, part_a), b = solid(pair, pair.b, pose_b, part_b);
  std::optional<Separation> found = separate(pair, a, b);
  if (!found || !(found->gap < pair.reach)) return;
  const Vec3 place_a = pair.origin + pair.size * a.pose.position, place_b = pair.origin + pair.size * b.pose.position;
  const double side_a = side_of(pair.a, pose_a, part_a, place_b), side_b = side_of(pair.b, pose_b, part_b, place_a);
  const Vec3& n = found->normal;
  const auto owns = [&](std::uint32_t primitive, const Pose& pose, std::uint32_t part, double side, const Vec3& out) {
    return side == 0.0 || meshes_[primitive]->owns(part, rotate_back(pose.orientation, out), side);
  };
  const bool owned = owns(pair.a, pose_a, part_a, side_a, n) && owns(pair.b, pose_b, part_b, side_b, -n);
  if (owned) return add_manifold(pair, part_a, part_b, a, b, *found);
  if (found->gap <= 0.0) pair.orphans.emplace_back(part_a, part_b);
}

ConvexSolid ConvexPhase::patch(const Pair& pair, std::uint32_t primitive, const Pose& pose,
                               std::vector<std::uint32_t> parts, std::vector<Vec3>& corners) const {
  ConvexSolid made = solid(pair, primitive, pose, parts[0]);
  if (meshes_[primitive] == nullptr) return made;
  static const FaceLoops none;
  // Across edges that are no valleys the solid goes on; the way out of a triangle alone may lead there.
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceTriangle& t = meshes_[primitive]->triangle(parts[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (meshes_[primitive]->closed() && t.fold[k] > -kLevelFold) parts.push_back(t.next[k]);
    }
  }
  std::ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  for (const std::uint32_t i : parts) {
    const auto& corner = meshes_[primitive]->triangle(i).corner;
    corners.insert(corners.end(), corner.begin(), corner.end());
  }
  made.vertices = corners;
  made.loops = &none;
  return made;
}

void ConvexPhase::add_orphans(Pair& pair) const {
  std::vector<std::uint32_t> parts_a, parts_b;
  for (const auto& [a, b] : pair.orphans) {
    parts_a.push_back(a);
    parts_b.push_back(b);
  }
  std::vector<Vec3> corners_a, corners_b;
  const ConvexSolid a = patch(pair, pair.a, pair.colliders.pose[pair.pair.a], parts_a, corners_a);
  const ConvexSolid b = patch(pair, pair.b, pair.colliders.pose[pair.pair.b], parts_b, corners_b);
  add_manifold(pair, parts_a[0], parts_b[0], a, b, best_climb(a, b));
}

double ConvexPhase::side_of(std::uint32_t primitive, const Pose& pose, std::uint32_t part, const Vec3& other) const {
  const SurfaceTree* mesh = meshes_[primitive].get();
  if (mesh == nullptr) return 0.0;
  const SurfaceTriangle& t = mesh->triangle(part);
  return mesh->closed() || dot(t.normal, transform_back(pose, other) - t.corner[0]) >= 0.0 ? 1.0 : -1.0;
}

void ConvexPhase::add_manifold(Pair& pair, std::uint32_t part_a, std::uint32_t part_b, const ConvexSolid& a,
                               const ConvexSolid& b, const Separation& found) const {
  find_manifold(a, b, found, pair.reach, pair.points);
  const std::uint64_t parts = std::uint64_t{part_a} * part_count(pair.b) + part_b;
  for (const ManifoldPoint& p : pair.points) pair.add(parts << kPartShift | p.feature, p.point, found.normal, p.gap);
}

void ConvexPhase::touch_plane(Pair& pair, std::uint32_t part, bool plane_first, const Vec3& foot, const Vec3& up,
                              std::uint64_t parts) const {
  const Pose& pose = pair.colliders.pose[plane_first ? pair.pair.b : pair.pair.a];
  const ConvexSolid s = solid(pair, plane_first ? pair.b : pair.a, pose, part);
  const SurfaceFeature feature = surface_feature(s, -up);
  for (std::size_t i = 0; i < feature.count; ++i) {
    const double gap = dot(up, feature.corner[i] - (foot - pair.origin) / pair.size);
    if (!(gap < pair.reach)) continue;
    pair.add(parts << kPartShift | i, feature.corner[i] - 0.5 * gap * up, plane_first ? up : -up, gap);
  }
}

void ConvexPhase::collide_plane(Pair& pair, std::uint32_t part) const {
  const bool first = shapes_->primitives()[pair.a].kind == ShapeKind::plane;
  const Pose& plane = pair.colliders.pose[first ? pair.pair.a : pair.pair.b];
  touch_plane(pair, part, first, plane.position, rotate(plane.orientation, {0, 0, 1}), part);
}

void ConvexPhase::collide_pair(Pair& pair) const {
  const Primitive& a = shapes_->primitives()[pair.a];
  const Primitive& b = shapes_->primitives()[pair.b];
  if (a.hollow || b.hollow) {
    throw Error{
        ErrorKind::usage,
        "a hollow cylinder was given to a narrow phase that computes none; put 'sphere_cluster' and 'polyhedron' "
        "before it"};
  }
  const Pose& pose_a = pair.colliders.pose[pair.pair.a];
  const Pose& pose_b = pair.colliders.pose[pair.pair.b];
  const bool a_smaller = a.bounding_radius <= b.bounding_radius;
  pair.size = a_smaller ? a.bounding_radius : b.bounding_radius;
  pair.origin = a_smaller ? pose_a.position : pose_b.position;
  pair.reach = pair.pair.reach / pair.size;
  find_parts(pair, pair.a, pose_a, pair.b, pose_b, pair.parts_a);
  find_parts(pair, pair.b, pose_b, pair.a, pose_a, pair.parts_b);
  const std::size_t begin = pair.begin = pair.out.size();
  pair.orphans.clear();
  for (const std::uint32_t i : pair.parts_a) {
    for (const std::uint32_t j : pair.parts_b) {
      if (a.kind == ShapeKind::plane) {
        collide_plane(pair, j);
      } else if (b.kind == ShapeKind::plane) {
        collide_plane(pair, i);
      } else {
        collide_parts(pair, i, j);
      }
    }
  }
  const auto overlaps = [](const Contact& c) { return c.gap <= 0.0; };
  const auto first = pair.out.begin() + static_cast<std::ptrdiff_t>(begin);
  if (std::none_of(first, pair.out.end(), overlaps)) {
    const bool is_led_out = lead_out(pair, true) || lead_out(pair, false);
    if (!is_led_out && !pair.orphans.empty()) add_orphans(pair);
  }
  std::sort(pair.out.begin() + static_cast<std::ptrdiff_t>(begin), pair.out.end(),
            [](const Contact& l, const Contact& r) { return l.feature < r.feature; });
}

void ConvexPhase::collide(const ColliderView& colliders, std::span<const ColliderPair> pairs,
                          ContactBuffer& out) const {
  std::uint64_t failed = 0;
  Pair work{.colliders = colliders,
            .pair = {},
            .out = out,
            .a = 0,
            .b = 0,
            .origin = {},
            .parts_a = {},
            .parts_b = {},
            .points = {}};
  for (const ColliderPair& pair : pairs) {
    work.pair = pair;
    work.a = colliders.primitive[pair.a];
    work.b = colliders.primitive[pair.b];
    work.fell_back = false;
    collide_pair(work);
    failed += work.fell_back ? 1 : 0;
  }
  if (failed > 0) fallbacks_.fetch_add(failed, std::memory_order_relaxed);
}

}  // namespace scree::convex
