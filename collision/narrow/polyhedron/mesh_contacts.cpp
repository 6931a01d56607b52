#include "mesh_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "gjk.hpp"
#include "mesh_axis.hpp"
#include "triangle_polytope.hpp"

namespace scree::polyhedron {
namespace {

/// Directions within a degree of a triangle's normal are that normal.
constexpr double kSameDirection = 0.99985;
/// In sizes of the solid: what neighbours report nearer than this to each other is one point, and points this near to a plane
/// lie in it.
constexpr double kSamePoint = 1e-4;
constexpr double kSamePlane = 1e-5;
/// Normals that differ by less are those of one plane.
constexpr double kSameNormal = 1.0 - 1e-10;
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
  Meeter(const MeshSurface& mesh, double reach, MeshScratch& scratch) : mesh_{mesh}, reach_{reach}, scratch_{scratch} {}

  /// Adds what a triangle contributes. `behind`: also when the middle of the solid is behind a triangle of a closed mesh.
  void meet(const MeshTriangle& triangle, const PlacedPair& pair, bool behind) {
    const double offset = dot(triangle.normal, triangle.corner[0]);
    const double middle = dot(triangle.normal, pair.centre_b()) - offset;
    if (mesh_.closed() && middle < 0.0 && !behind) return;
    const bool turned = !mesh_.closed() && middle < 0.0;
    const Vec3 out = turned ? -triangle.normal : triangle.normal;
    if (pair.separation(out) - pair.b.radius >= reach_) return;
    const Distance d = distance(pair, reach_ + pair.b.radius);
    if (d.approach == Approach::beyond) return;
    if (d.approach == Approach::touching) {
      const Axis axis = axis_out_of(mesh_, triangle, pair, out, 0.5 * (d.on_a + d.on_b));
      if (axis.normal == out) return add_face(triangle, pair, turned, false);
      make_manifold(pair, {axis.normal, axis.separation, axis.on_a, axis.on_b}, reach_, scratch_.manifold);
      return add(triangle);
    }
    if (dot(d.normal, out) >= kSameDirection) return add_face(triangle, pair, turned, false);
    if (!admits_at(triangle, d)) return add_face(triangle, pair, turned, true);
    make_manifold(pair, {d.normal, d.length, d.on_a, d.on_b}, reach_, scratch_.manifold);
    add(triangle);
  }

 private:
  /// Whether the mesh can be touched along the normal of `d` where its nearest point lies.
  [[nodiscard]] bool admits_at(const MeshTriangle& triangle, const Distance& d) const {
    std::array<bool, 3> used{};
    for (std::uint32_t k = 0; k < d.count; ++k) used[d.corner_a[k]] = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (used[k] && used[(k + 1) % 3]) {
        return !used[(k + 2) % 3] && mesh_.edge_admits(triangle, k, d.normal);
      }
    }
    const auto only = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
    return mesh_.corner_admits(triangle, only, d.normal);
  }
  void add_face(const MeshTriangle& triangle, const PlacedPair& pair, bool turned, bool apart) {
    make_face_manifold(pair, turned ? 1 : 0, reach_, scratch_.manifold);
    if (apart) {
      std::erase_if(scratch_.manifold.points,
                    [&](const ManifoldPoint& point) { return point.gap < -kBelow * pair.size; });
    }
    add(triangle);
  }
  void add(const MeshTriangle& triangle) {
    for (const ManifoldPoint& point : scratch_.manifold.points) {
      scratch_.found.push_back({point.at, scratch_.manifold.normal, point.gap,
                                std::uint64_t{triangle.number} << 32 | point.feature, scratch_.manifold.of_face});
    }
  }

  const MeshSurface& mesh_;
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
      return squared_norm(other.at - points[i].at) <= same * same &&
             dot(other.normal, points[i].normal) > kSameDirection;
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
    if (count > 4) keep_support(first.normal, scratch.plane);
    for (const ManifoldPoint& kept : scratch.plane) scratch.points.push_back(found[kept.feature]);
    found.erase(found.begin(), others);
  }
}

}  // namespace

void mesh_contacts(const MeshSurface& mesh, const Pose& mesh_pose, const Polytope& solid, const Pose& pose,
                   double reach, MeshScratch& scratch) {
  scratch.points.clear();
  scratch.found.clear();
  mesh.near(box_of(solid, pose, mesh_pose, reach), scratch.near);
  Meeter meeter{mesh, reach, scratch};
  // Where nothing else holds the solid, it may have sunk in by more than half.
  for (const bool behind : {false, true}) {
    if (behind && (!mesh.closed() || !scratch.found.empty())) break;
    for (const std::uint32_t i : scratch.near) {
      const TrianglePolytope triangle{mesh[i]};
      meeter.meet(mesh[i], PlacedPair{triangle.view(), mesh_pose, solid, pose}, behind);
    }
  }
  const auto by_feature = [](const MeshPoint& l, const MeshPoint& r) { return l.feature < r.feature; };
  std::sort(scratch.found.begin(), scratch.found.end(), by_feature);
  drop_doubles(solid.size + solid.radius, scratch.found);
  thin_planes(solid.size + solid.radius, scratch);
  std::sort(scratch.points.begin(), scratch.points.end(), by_feature);
}

}  // namespace scree::polyhedron
