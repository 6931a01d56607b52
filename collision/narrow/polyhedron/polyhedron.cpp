#include "polyhedron.hpp"

#include "drum.hpp"
#include "gjk.hpp"
#include "manifold.hpp"
#include "mesh_contacts.hpp"
#include "penetration.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "segments.hpp"

namespace scree {
namespace polyhedron {
namespace {

/// Pairs ahead of the present one whose second solid is fetched into the cache.
constexpr std::size_t kAhead = 4;

/// Buffers of one collide() call.
struct Scratch {
  AxisScratch axes;
  Manifold manifold;
  MeshScratch mesh;
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

/// Appends the contacts of one pair. `swapped`: what was computed as a is collider b.
class Writer {
 public:
  Writer(const ColliderView& colliders, const ColliderPair& pair, bool swapped, ContactBuffer& out)
      : colliders_{colliders},
        pair_{pair},
        pose_{colliders.pose[swapped ? pair.b : pair.a]},
        swapped_{swapped},
        out_{out} {}

  void add(const Vec3& at, const Vec3& normal, double gap, std::uint64_t feature) {
    const Vec3 n = rotate(pose_.orientation, normal);
    out_.push_back({colliders_.body[pair_.a], colliders_.body[pair_.b], colliders_.ordinal[pair_.a],
                    colliders_.ordinal[pair_.b], feature, transform(pose_, at), swapped_ ? -n : n, gap});
  }

 private:
  const ColliderView& colliders_;
  const ColliderPair& pair_;
  const Pose& pose_;
  bool swapped_;
  ContactBuffer& out_;
};

}  // namespace
}  // namespace polyhedron

bool Polyhedron::supports(ShapeKind a, ShapeKind b) const {
  using polyhedron::is_polytope;
  if (is_polytope(a) && is_polytope(b)) return true;
  return (is_polytope(a) && b == ShapeKind::triangle_mesh) || (a == ShapeKind::triangle_mesh && is_polytope(b));
}

bool Polyhedron::supports_hollow(ShapeKind inside) const {
  return inside != ShapeKind::plane && inside != ShapeKind::sphere && inside != ShapeKind::sphere_cluster;
}

void Polyhedron::bind(const ShapeSet& shapes, std::size_t first_new_primitive) {
  shapes_ = &shapes;
  polytopes_.add(shapes, first_new_primitive);
  const auto primitives = shapes.primitives();
  for (std::size_t i = mesh_of_.size(); i < primitives.size(); ++i) {
    mesh_of_.push_back(static_cast<std::uint32_t>(meshes_.size()));
    if (primitives[i].kind != ShapeKind::triangle_mesh) continue;
    meshes_.emplace_back(shapes.vertices(),
                         shapes.triangles().subspan(primitives[i].first_triangle, primitives[i].triangle_count));
  }
}

void Polyhedron::collide_drum(std::uint32_t drum, const Pose& drum_pose, std::uint32_t inside, const Pose& pose,
                              double reach, std::vector<polyhedron::MeshPoint>& out) const {
  out.clear();
  const Primitive& wall = shapes_->primitives()[drum];
  const Primitive& solid = shapes_->primitives()[inside];
  const polyhedron::Drum hollow{wall.size.x, wall.size.y};
  const Pose in_drum = inverse(drum_pose) * pose;
  if (polyhedron::is_polytope(solid.kind)) {
    drum_contacts(hollow, polytopes_[inside], in_drum, reach, out);
  } else if (solid.kind == ShapeKind::triangle_mesh) {
    drum_contacts(hollow, meshes_[mesh_of_[inside]], in_drum, reach, out);
  } else {
    drum_contacts(hollow, solid.kind, solid.size, in_drum, reach, out);
  }
}

void Polyhedron::collide(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) const {
  using namespace polyhedron;
  Scratch scratch;
  const auto primitives = shapes_->primitives();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k + kAhead < pairs.size()) polytopes_.fetch(colliders.primitive[pairs[k + kAhead].b]);
    const ColliderPair& pair = pairs[k];
    const bool a_is_polytope = is_polytope(colliders.kind[pair.a]);
    if (a_is_polytope && is_polytope(colliders.kind[pair.b])) {
      collide_polytopes(polytopes_[colliders.primitive[pair.a]], colliders.pose[pair.a],
                        polytopes_[colliders.primitive[pair.b]], colliders.pose[pair.b], pair.reach, scratch);
      Writer write{colliders, pair, false, out};
      for (const ManifoldPoint& p : scratch.manifold.points) write.add(p.at, scratch.manifold.normal, p.gap, p.feature);
      continue;
    }
    // A drum may hold a mesh, and a mesh a polytope.
    const bool a_is_surface = primitives[colliders.primitive[pair.a]].hollow ||
                              (!a_is_polytope && !primitives[colliders.primitive[pair.b]].hollow);
    const ColliderIndex surface = a_is_surface ? pair.a : pair.b, solid = a_is_surface ? pair.b : pair.a;
    const std::uint32_t primitive = colliders.primitive[surface], inside = colliders.primitive[solid];
    if (primitives[primitive].hollow) {
      collide_drum(primitive, colliders.pose[surface], inside, colliders.pose[solid], pair.reach, scratch.mesh.points);
    } else {
      mesh_contacts(meshes_[mesh_of_[primitive]], colliders.pose[surface], polytopes_[inside], colliders.pose[solid],
                    pair.reach, scratch.mesh);
    }
    Writer write{colliders, pair, !a_is_surface, out};
    for (const MeshPoint& p : scratch.mesh.points) write.add(p.at, p.normal, p.gap, p.feature);
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins
      .add<scree::NarrowPhase, scree::Polyhedron>("polyhedron",
                                                  "Several points between boxes, hulls, capsules and meshes, and all "
                                                  "solids inside drums, by separating axes and clipping.")
      .default_place = 2;
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("polyhedron", "1.0.0", &list)};
