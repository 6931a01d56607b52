#include "mesh_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "clip.hpp"
#include "gjk.hpp"
#include "mesh_axis.hpp"
#include "triangle_polytope.hpp"

namespace scree::polyhedron {
namespace {

/// In sizes of the solid: what neighbours report nearer than this to each other is one point, and points this near to a plane
/// lie in it.
constexpr double kSamePoint = 1e-4;
constexpr double kSamePlane = 1e-5;
/// Cosine of a degree: normals that differ by less look alike.
constexpr double kAlike = 0.99985;
/// Normals that differ by less are those of one plane.
constexpr double kSameNormal = 1.0 - 1e-10;
/// Cosine of 1e-5: within it a direction is the triangle's normal.
constexpr double kUpright = 1.0 - 5e-11;
/// A solid apart from a triangle cannot be below it: what clipping finds there is beyond the rim.
constexpr double kBelow = 1e-6;

/// The box of a solid in the frame of the mesh, grown by `by` [m].
Aabb box_of(const Polytope& solid, const Pose& pose, const Pose& mesh_pose, double by) {
  const Pose to_mesh = inverse(mesh_pose) * pose;
  Aabb box = Aabb::empty();
  for (std::uint32_t i = 0; i < solid.corner_count; ++i) box = merged(box, transform(to_mesh, solid.corner(i)));
  return expanded(box, by + solid.radius);
}

/// Meets one solid with the triangles of one mesh.
class Meeter {
 public:
  Meeter(const MeshSurface& mesh, const Pose& mesh_pose, const Polytope& solid, const Pose& pose, double reach,
         MeshScratch& scratch)
      : mesh_{mesh}, mesh_pose_{mesh_pose}, solid_{solid}, pose_{pose}, reach_{reach}, scratch_{scratch} {}

  /// Finds the points of a triangle that the solid does not cut; others are put down as cuts. `behind`: also when the middle of
  /// the solid is behind a triangle of a closed mesh.
  void meet(std::uint32_t i, bool behind) {
    const TrianglePolytope triangle{mesh_[i]};
    const PlacedPair pair{triangle.view(), mesh_pose_, solid_, pose_};
    const double middle = dot(mesh_[i].normal, pair.centre_b() - mesh_[i].corner[0]);
    if (mesh_.closed() && middle < 0.0 && !behind) return;
    const bool turned = !mesh_.closed() && middle < 0.0;
    const Vec3 out = turned ? -mesh_[i].normal : mesh_[i].normal;
    if (pair.separation(out) - solid_.radius >= reach_) return;
    const Distance d = distance(pair, reach_ + solid_.radius);
    if (d.approach == Approach::beyond) return;
    if (d.approach == Approach::touching) {
      const Axis axis = axis_out_of(mesh_, mesh_[i], pair, out, 0.5 * (d.on_a + d.on_b));
      scratch_.cuts.push_back({i, axis.normal == out, turned, {axis.normal, axis.separation, axis.on_a, axis.on_b}});
    } else if (dot(d.normal, out) >= kUpright || !admits_at(mesh_[i], d)) {
      add_face(i, pair, turned, true);
    } else {
      add_edge(i, pair, {d.normal, d.length, d.on_a, d.on_b});
    }
  }

  /// The points of the triangles that are cut. Where a shallower way out, as over an edge, also leads out of another triangle,
  /// the depth below that one means nothing.
  void settle_cuts() {
    auto& cuts = scratch_.cuts;
    std::sort(cuts.begin(), cuts.end(), [this](const Cut& l, const Cut& r) {
      return l.way.gap != r.way.gap ? l.way.gap > r.way.gap : mesh_[l.triangle].number < mesh_[r.triangle].number;
    });
    const double tie = kSamePlane * (solid_.size + solid_.radius);
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const Meeting way = cuts[k].way;
      const auto settled = [&](const Cut& cut) { return cut.way.gap < way.gap - tie && leads_out(way, cut.triangle); };
      cuts.erase(std::remove_if(cuts.begin() + static_cast<std::ptrdiff_t>(k) + 1, cuts.end(), settled), cuts.end());
    }
    for (const Cut& cut : cuts) {
      const TrianglePolytope triangle{mesh_[cut.triangle]};
      const PlacedPair pair{triangle.view(), mesh_pose_, solid_, pose_};
      if (cut.of_face) {
        add_face(cut.triangle, pair, cut.turned, false);
      } else {
        add_edge(cut.triangle, pair, cut.way);
      }
    }
    if (!scratch_.found.empty()) return;
    // What is cut beside all faces, as at a corner: the place where it is cut.
    for (const Cut& cut : cuts) {
      const TrianglePolytope triangle{mesh_[cut.triangle]};
      make_edge_manifold({triangle.view(), mesh_pose_, solid_, pose_}, cut.way, reach_, scratch_.manifold);
      add(cut.triangle);
    }
  }

  /// A solid that has gone in whole, past all triangles: out through the facet nearest to its middle, by its deepest corner.
  void lead_out_of_inside() {
    const Vec3 middle = transform(inverse(mesh_pose_) * pose_, solid_.centre);
    if (!mesh_.holds(middle)) return;
    const std::uint32_t i = mesh_.nearest(middle);
    const TrianglePolytope triangle{mesh_[i]};
    const PlacedPair pair{triangle.view(), mesh_pose_, solid_, pose_};
    const Vec3& out = mesh_[i].normal;
    const std::uint32_t deepest = pair.lowest_of_b(out);
    const double gap = dot(out, pair.corner_b(deepest) - mesh_[i].corner[0]) - solid_.radius;
    const Vec3 at = pair.corner_b(deepest) - (solid_.radius + 0.5 * gap) * out;
    scratch_.found.push_back(
        {at, out, gap, std::uint64_t{mesh_[i].number} << 32 | feature_of_corner(1, deepest), true});
  }

 private:
  /// Whether the mesh can be touched along the normal of `d` where its nearest point lies.
  [[nodiscard]] bool admits_at(const MeshTriangle& triangle, const Distance& d) const {
    std::array<bool, 3> used{};
    for (std::uint32_t k = 0; k < d.count; ++k) used[d.corner_a[k]] = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (used[k] && used[(k + 1) % 3]) return !used[(k + 2) % 3] && mesh_.edge_admits(triangle, k, d.normal);
    }
    const auto only = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
    return mesh_.corner_admits(triangle, only, d.normal);
  }
  /// True when the solid, moved out along a way, no longer cuts a triangle.
  [[nodiscard]] bool leads_out(const Meeting& way, std::uint32_t i) const {
    const double tie = kSamePlane * (solid_.size + solid_.radius);
    const TrianglePolytope triangle{mesh_[i]};
    Pose moved = pose_;
    moved.position += rotate(mesh_pose_.orientation, (tie - way.gap) * way.normal);
    return distance({triangle.view(), mesh_pose_, solid_, moved}, tie).approach != Approach::touching;
  }
  void add_face(std::uint32_t i, const PlacedPair& pair, bool turned, bool apart) {
    make_face_manifold(pair, turned ? 1 : 0, reach_, scratch_.manifold);
    if (apart) {
      std::erase_if(scratch_.manifold.points,
                    [&](const ManifoldPoint& point) { return point.gap + solid_.radius < -kBelow * pair.size; });
    }
    add(i);
  }
  /// At an edge or a corner; a face of the solid may lie on it, if the mesh admits that face's direction.
  void add_edge(std::uint32_t i, const PlacedPair& pair, const Meeting& way) {
    make_manifold(pair, way, reach_, scratch_.manifold);
    if (!admits(mesh_, mesh_[i], scratch_.manifold.normal)) make_edge_manifold(pair, way, reach_, scratch_.manifold);
    add(i);
  }
  void add(std::uint32_t i) {
    for (const ManifoldPoint& point : scratch_.manifold.points) {
      scratch_.found.push_back({point.at, scratch_.manifold.normal, point.gap,
                                std::uint64_t{mesh_[i].number} << 32 | point.feature, scratch_.manifold.of_face});
    }
  }

  const MeshSurface& mesh_;
  const Pose& mesh_pose_;
  const Polytope& solid_;
  const Pose& pose_;
  double reach_;
  MeshScratch& scratch_;
};

/// Keeps one of the points that lie together and look alike: the deepest, and of equals the first.
void drop_doubles(double size, std::vector<MeshPoint>& points) {
  const double same = kSamePoint * size;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto end = points.begin() + static_cast<std::ptrdiff_t>(count);
    const auto known = std::find_if(points.begin(), end, [&](const MeshPoint& other) {
      return squared_norm(other.at - points[i].at) <= same * same && dot(other.normal, points[i].normal) > kAlike;
    });
    if (known == end) {
      points[count++] = points[i];
    } else if (points[i].gap < known->gap - kSamePlane * size) {
      *known = points[i];
    }
  }
  points.resize(count);
}

bool in_one_plane(const MeshPoint& a, const MeshPoint& b, double size) {
  if (!a.of_face || !b.of_face || dot(a.normal, b.normal) < kSameNormal) return false;
  // The plane of the mesh is half a gap below each point.
  return std::abs(dot(a.normal, b.at - a.at) - 0.5 * (b.gap - a.gap)) <= kSamePlane * size;
}

/// Of the points in one plane that come from several triangles, those remain that hold up the solid.
void thin_planes(double size, MeshScratch& scratch) {
  auto& found = scratch.found;
  while (!found.empty()) {
    const MeshPoint first = found.front();
    const auto others = std::stable_partition(found.begin(), found.end(), [&](const MeshPoint& point) {
      return in_one_plane(first, point, size) || point.feature == first.feature;
    });
    const auto count = static_cast<std::uint32_t>(others - found.begin());
    scratch.plane.clear();
    for (std::uint32_t i = 0; i < count; ++i) scratch.plane.push_back({found[i].at, found[i].gap, i});
    if (count > 3) keep_support(first.normal, scratch.plane);
    for (const ManifoldPoint& kept : scratch.plane) scratch.points.push_back(found[kept.feature]);
    found.erase(found.begin(), others);
  }
}

}  // namespace

void mesh_contacts(const MeshSurface& mesh, const Pose& mesh_pose, const Polytope& solid, const Pose& pose,
                   double reach, MeshScratch& scratch) {
  scratch.points.clear();
  scratch.found.clear();
  scratch.cuts.clear();
  mesh.near(box_of(solid, pose, mesh_pose, reach), scratch.near);
  Meeter meeter{mesh, mesh_pose, solid, pose, reach, scratch};
  // Where nothing else holds the solid, it may have sunk in by more than half.
  for (const bool behind : {false, true}) {
    if (behind && (!mesh.closed() || !scratch.found.empty() || !scratch.cuts.empty())) break;
    for (const std::uint32_t i : scratch.near) meeter.meet(i, behind);
  }
  meeter.settle_cuts();
  if (scratch.found.empty()) meeter.lead_out_of_inside();
  const auto by_feature = [](const MeshPoint& l, const MeshPoint& r) { return l.feature < r.feature; };
  std::sort(scratch.found.begin(), scratch.found.end(), by_feature);
  drop_doubles(solid.size + solid.radius, scratch.found);
  thin_planes(solid.size + solid.radius, scratch);
  std::sort(scratch.points.begin(), scratch.points.end(), by_feature);
}

}  // namespace scree::polyhedron
