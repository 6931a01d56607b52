#include "sphere_cluster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact_writer.hpp"
#include "hull.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "single_spheres.hpp"
#include "support_points.hpp"

namespace scree {
namespace sphere_cluster {
namespace {

/// First bit of a cluster's sphere in a feature.
constexpr unsigned kSphereShift = 48;
/// The same for the first of two clusters.
constexpr unsigned kPairShift = 24;

/// Pairs ahead of the present one whose second collider is fetched into the cache.
constexpr std::size_t kPrefetch = 12;

void prefetch(const ColliderView& colliders, ColliderIndex i) {
  __builtin_prefetch(&colliders.ball[i]);
  __builtin_prefetch(&colliders.body[i]);
  __builtin_prefetch(&colliders.ordinal[i]);
}

/// Buffers of one collide() call.
struct Scratch {
  MeshScratch mesh;
  std::vector<Sphere> points;
  std::vector<std::uint32_t> near;
};

/// Unit vector along v; up when v is too short to have a direction.
Vec3 direction(const Vec3& v, double length) { return length > 1e-300 ? v / length : Vec3{0, 0, 1}; }

/// A sphere has no orientation that matters.
Pose pose_of(const ColliderView& colliders, ColliderIndex i) {
  return colliders.kind[i] == ShapeKind::sphere ? Pose{colliders.ball[i].centre, {}} : colliders.pose[i];
}

/// Two unions of spheres. Those of each that come near the bounding sphere of the other are compared.
void collide_clusters(const SolidSet& set, const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                      Scratch& scratch, ContactWriter& write) {
  const Pose a_to_b = inverse(pose_b) * pose_a;
  Sphere single_a, single_b;
  const auto of_a = set.spheres_of(a, single_a);
  const auto of_b = set.spheres_of(b, single_b);
  scratch.near.clear();
  for (std::uint32_t j = 0; j < of_b.size(); ++j) {
    const double bound = of_b[j].radius + write.reach() + a.bounding_radius;
    if (squared_norm(of_b[j].centre - a_to_b.position) < bound * bound) scratch.near.push_back(j);
  }
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Vec3 centre = transform(a_to_b, of_a[i].centre);
    const double range = of_a[i].radius + write.reach();
    const double bound = range + b.bounding_radius;
    if (squared_norm(centre) >= bound * bound) continue;
    for (const std::uint32_t j : scratch.near) {
      const Vec3 from_b = centre - of_b[j].centre;
      const double limit = range + of_b[j].radius;
      const double d2 = squared_norm(from_b);
      if (d2 >= limit * limit) continue;
      const double d = std::sqrt(d2);
      write.add(i << kPairShift | j, transform(pose_a, of_a[i].centre), of_a[i].radius,
                d - of_a[i].radius - of_b[j].radius, rotate(pose_b.orientation, direction(from_b, d)));
    }
  }
}

Nearest nearest_on_convex(const SolidSet& set, const Solid& solid, const Vec3& p, double limit) {
  switch (solid.kind) {
    case ShapeKind::box:
      return nearest_on_box(solid.size, p);
    case ShapeKind::cylinder:
      return nearest_on_cylinder(solid.size.x, solid.size.y, p);
    case ShapeKind::capsule:
      return nearest_on_capsule(solid.size.x, solid.size.y, p);
    case ShapeKind::cone:
      return nearest_on_cone(solid.size.x, solid.size.y, p);
    case ShapeKind::ellipsoid:
      return nearest_on_ellipsoid(solid.size, p);
    case ShapeKind::convex_hull:
      return nearest_on_hull(*set.shapes, set.shapes->primitives()[solid.primitive], p, limit);
    case ShapeKind::plane:
    case ShapeKind::sphere:
    case ShapeKind::sphere_cluster:
    case ShapeKind::triangle_mesh:
      break;
  }
  return {p.z, {0, 0, 1}};
}

/// Calls report(sub-feature, Nearest) for all places where a sphere about p, in
/// the solid's frame, touches the solid or comes within reach.
template <class Report>
void touch(const SolidSet& set, const Solid& solid, const Vec3& p, double r, double reach, Scratch& scratch,
           const Report& report) {
  if (solid.kind == ShapeKind::triangle_mesh) {
    set.meshes[solid.first].touch(p, r, reach, scratch.mesh);
    for (const MeshTouch& t : scratch.mesh.touches) report(t.feature, t.nearest);
  } else if (solid.kind == ShapeKind::cylinder && solid.hollow) {
    // A sphere whose centre is more than its radius beyond a wall has left the drum.
    const auto walls = walls_of_drum(solid.size.x, solid.size.y, p);
    for (const Nearest& wall : walls) {
      if (wall.distance < -r) return;
    }
    for (std::size_t k = 0; k < walls.size(); ++k) report(k, walls[k]);
  } else {
    report(0, nearest_on_convex(set, solid, p, r + reach));
  }
}

/// A union of spheres against a solid that is not one.
void collide_round(const SolidSet& set, const Solid& round, const Pose& pose, const Solid& solid,
                   const Pose& solid_pose, Scratch& scratch, ContactWriter& write) {
  const Pose to_solid = inverse(solid_pose) * pose;
  Sphere single;
  const auto spheres = set.spheres_of(round, single);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double r = spheres[i].radius;
    const Vec3 p = transform(to_solid, spheres[i].centre);
    const double bound = r + write.reach() + solid.bounding_radius;
    if (squared_norm(p) >= bound * bound) continue;
    touch(set, solid, p, r, write.reach(), scratch, [&](std::uint64_t sub, const Nearest& nearest) {
      const double gap = nearest.distance - r;
      if (!(gap < write.reach())) return;
      write.add(std::uint64_t{i} << kSphereShift | sub, transform(pose, spheres[i].centre), r, gap,
                rotate(solid_pose.orientation, nearest.normal));
    });
  }
  write.sort();
}

/// Corners of a solid against a plane.
void collide_plane(const SolidSet& set, const Solid& solid, const Pose& pose, const Pose& plane, Scratch& scratch,
                   ContactWriter& write) {
  const Vec3 up = rotate(plane.orientation, {0, 0, 1});
  support_points(set, solid, rotate_back(pose.orientation, up), scratch.points);
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    const Vec3 point = transform(pose, scratch.points[i].centre);
    const double r = scratch.points[i].radius;
    const double gap = dot(up, point - plane.position) - r;
    if (gap < write.reach()) write.add(i, point, r, gap, up);
  }
}

}  // namespace
}  // namespace sphere_cluster

bool SphereCluster::supports(ShapeKind a, ShapeKind b) const {
  if (sphere_cluster::is_round(a) || sphere_cluster::is_round(b)) return true;
  return (a == ShapeKind::plane) != (b == ShapeKind::plane);
}

bool SphereCluster::supports_hollow(ShapeKind inside) const {
  return sphere_cluster::is_round(inside) || inside == ShapeKind::plane;
}

void SphereCluster::bind(const ShapeSet& shapes, std::size_t first_new_primitive) {
  set_.add(shapes, first_new_primitive);
}

void SphereCluster::collide(const ColliderView& colliders, std::span<const ColliderPair> pairs,
                            ContactBuffer& out) const {
  using namespace sphere_cluster;
  Scratch scratch;
  const auto both_spheres = [&](const ColliderPair& pair) {
    return colliders.kind[pair.a] == ShapeKind::sphere && colliders.kind[pair.b] == ShapeKind::sphere;
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    // Spheres come in runs.
    const std::size_t first = k;
    while (k < pairs.size() && both_spheres(pairs[k])) ++k;
    collide_spheres(colliders, pairs.subspan(first, k - first), out);
    if (k == pairs.size()) break;
    if (k + kPrefetch < pairs.size()) prefetch(colliders, pairs[k + kPrefetch].b);
    const ColliderPair& pair = pairs[k];
    const Solid a = set_.solid(colliders.primitive[pair.a]), b = set_.solid(colliders.primitive[pair.b]);
    const Pose pose_a = pose_of(colliders, pair.a), pose_b = pose_of(colliders, pair.b);
    const bool both_round = is_round(a.kind) && is_round(b.kind);
    // The plane, or else the one that is not made of spheres, comes second.
    const bool swapped = !both_round && (is_round(b.kind) || a.kind == ShapeKind::plane);
    ContactWriter write{colliders, pair, swapped, out};
    if (both_round) {
      collide_clusters(set_, a, pose_a, b, pose_b, scratch, write);
    } else if (is_round(a.kind)) {
      collide_round(set_, a, pose_a, b, pose_b, scratch, write);
    } else if (is_round(b.kind)) {
      collide_round(set_, b, pose_b, a, pose_a, scratch, write);
    } else if (b.kind == ShapeKind::plane) {
      collide_plane(set_, a, pose_a, pose_b, scratch, write);
    } else {
      collide_plane(set_, b, pose_b, pose_a, scratch, write);
    }
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins
      .add<scree::NarrowPhase, scree::SphereCluster>("sphere_cluster",
                                                     "Closed forms: spheres and clusters of spheres against all kinds; "
                                                     "corners of boxes and others against planes.")
      .default_place = 1;
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("sphere_cluster", "1.0.0", &list)};
