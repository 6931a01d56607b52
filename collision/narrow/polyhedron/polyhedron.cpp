#include "polyhedron.hpp"

#include "gjk.hpp"
#include "manifold.hpp"
#include "penetration.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "segments.hpp"

namespace scree {
namespace polyhedron {
namespace {

/// Buffers of one collide() call.
struct Scratch {
  AxisScratch axes;
  Manifold manifold;
};

bool is_polytope(ShapeKind kind) {
  return kind == ShapeKind::box || kind == ShapeKind::convex_hull || kind == ShapeKind::capsule;
}

/// Finds out how two polytopes meet; false when their gap is not below `reach` [m].
bool meet(const PlacedPair& pair, double reach, AxisScratch& scratch, Meeting& out) {
  if (pair.a.faces.empty() && pair.b.faces.empty()) {
    out = meeting_of_segments(pair);
    return out.gap - pair.radii() < reach;
  }
  const Distance d = distance(pair, reach + pair.radii());
  if (d.approach == Approach::beyond) return false;
  if (d.approach == Approach::apart) {
    out = {d.normal, d.length, d.on_a, d.on_b};
    return true;
  }
  const Axis axis = penetration(pair, 0.5 * (d.on_a + d.on_b), scratch);
  out = {axis.normal, axis.separation, axis.on_a, axis.on_b};
  return axis.separation - pair.radii() < reach;
}

void collide_polytopes(const Polytope& a, const Pose& pose_a, const Polytope& b, const Pose& pose_b, double reach,
                       Scratch& scratch) {
  scratch.manifold.points.clear();
  const PlacedPair pair{a, pose_a, b, pose_b};
  Meeting meeting;
  if (meet(pair, reach, scratch.axes, meeting)) make_manifold(pair, meeting, reach, scratch.manifold);
}

}  // namespace
}  // namespace polyhedron

bool Polyhedron::supports(ShapeKind a, ShapeKind b) const {
  return polyhedron::is_polytope(a) && polyhedron::is_polytope(b);
}

void Polyhedron::bind(const ShapeSet& shapes, std::size_t first_new_primitive) {
  polytopes_.add(shapes, first_new_primitive);
}

void Polyhedron::collide(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) const {
  using namespace polyhedron;
  Scratch scratch;
  for (const ColliderPair& pair : pairs) {
    const Polytope a = polytopes_[colliders.primitive[pair.a]], b = polytopes_[colliders.primitive[pair.b]];
    const Pose& pose = colliders.pose[pair.a];
    collide_polytopes(a, pose, b, colliders.pose[pair.b], pair.reach, scratch);
    if (scratch.manifold.points.empty()) continue;
    const Vec3 normal = rotate(pose.orientation, scratch.manifold.normal);
    for (const ManifoldPoint& point : scratch.manifold.points) {
      out.push_back({colliders.body[pair.a], colliders.body[pair.b], colliders.ordinal[pair.a],
                     colliders.ordinal[pair.b], point.feature, transform(pose, point.at), normal, point.gap});
    }
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins
      .add<scree::NarrowPhase, scree::Polyhedron>(
          "polyhedron", "Several points between boxes, convex hulls and capsules, by separating axes and clipping.")
      .default_place = 2;
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("polyhedron", "1.0.0", &list)};
