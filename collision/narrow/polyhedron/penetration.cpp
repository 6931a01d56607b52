#include "penetration.hpp"

#include <cmath>
#include <limits>

namespace scree::polyhedron {
namespace {

/// Edges count only where they are better than the best face by this, in sizes: ties go to faces, which keeps stacks quiet.
constexpr double kFaceBias = 1e-6;
/// Of two equal faces that of a is taken.
constexpr double kTie = 1e-9;
/// The point in common is known to about this, in sizes.
constexpr double kSlack = 1e-7;
/// Squared sine below which two edges are parallel.
constexpr double kParallel = 1e-10;

/// Finds the axis of one pair.
class Search {
 public:
  Search(const PlacedPair& pair, const Vec3& p, AxisScratch& scratch) : pair_{pair}, p_{p}, scratch_{scratch} {
    best_.separation = -std::numeric_limits<double>::infinity();
  }

  Axis run() {
    measure(pair_.a, p_, scratch_.depth_a);
    measure(pair_.b, pair_.to_b(p_), scratch_.depth_b);
    try_faces();
    try_edges();
    return best_;
  }

 private:
  static void measure(const Polytope& solid, const Vec3& p, std::vector<double>& depth) {
    depth.resize(solid.faces.size());
    for (std::size_t f = 0; f < depth.size(); ++f) depth[f] = solid.faces[f].offset - dot(solid.faces[f].normal, p);
  }
  static std::uint32_t shallowest(const std::vector<double>& depth) {
    return static_cast<std::uint32_t>(std::min_element(depth.begin(), depth.end()) - depth.begin());
  }
  [[nodiscard]] bool can_win(double depth) const { return depth <= kSlack * pair_.size - best_.separation; }

  void try_face_of_a(std::uint32_t f) {
    const Face& face = pair_.a.faces[f];
    const double s = dot(face.normal, pair_.corner_b(pair_.lowest_of_b(face.normal))) - face.offset;
    if (s > best_.separation) best_ = {face.normal, s, false, p_, p_};
  }
  void try_face_of_b(std::uint32_t f) {
    const Face& face = pair_.b.faces[f];
    const Vec3 out = pair_.turn * face.normal;
    const double s = dot(out, pair_.a.corner(farthest(pair_.a, -out)) - pair_.shift) - face.offset;
    if (s > best_.separation + kTie * pair_.size) best_ = {-out, s, false, p_, p_};
  }
  void try_faces() {
    // The likeliest ones first: they bound the others.
    if (!pair_.a.faces.empty()) try_face_of_a(shallowest(scratch_.depth_a));
    if (!pair_.b.faces.empty()) try_face_of_b(shallowest(scratch_.depth_b));
    const Vec3 n = best_.normal;
    measure(pair_.a, pair_.corner_b(pair_.lowest_of_b(n)), scratch_.deep_a);
    measure(pair_.b, pair_.to_b(pair_.a.corner(farthest(pair_.a, n))), scratch_.deep_b);
    for (std::uint32_t f = 0; f < pair_.a.faces.size(); ++f) {
      if (can_win(std::max(scratch_.depth_a[f], scratch_.deep_a[f]))) try_face_of_a(f);
    }
    for (std::uint32_t f = 0; f < pair_.b.faces.size(); ++f) {
      if (can_win(std::max(scratch_.depth_b[f], scratch_.deep_b[f]))) try_face_of_b(f);
    }
  }

  /// The edges one of whose faces is near enough. `turned`: seen from a, b's normals point towards a.
  template <class Corner, class Turn>
  void collect(const Polytope& solid, const std::vector<double>& depth, const std::vector<double>& deep,
               std::vector<NearEdge>& edges, const Corner& corner, const Turn& turned) const {
    edges.clear();
    const auto add = [&](const Edge& edge) {
      const Vec3 from = corner(edge.from);
      edges.push_back({from, corner(edge.to) - from, {}, {}, 0.0});
    };
    for (const Edge& edge : solid.edges.first(solid.faces.empty() ? 1 : 0)) add(edge);
    for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
      if (!can_win(depth[f])) continue;
      for (const Side& side : solid.sides_of(f)) {
        const Edge& edge = solid.edges[side.edge];
        if (edge.right == kNoFace) continue;
        // An edge between two near faces belongs to its left one.
        const std::uint32_t other = edge.left == f ? edge.right : edge.left;
        if (edge.left != f && can_win(depth[other])) continue;
        if (!can_win(std::min(deep[f], deep[other]))) continue;
        add(edge);
        edges.back().left = turned(solid.faces[f].normal);
        edges.back().right = turned(solid.faces[other].normal);
        edges.back().depth = std::min(depth[f], depth[other]);
      }
    }
  }
  void try_edges() {
    collect(
        pair_.a, scratch_.depth_a, scratch_.deep_a, scratch_.edges_a,
        [&](std::uint32_t i) { return pair_.a.corner(i); }, [](const Vec3& n) { return n; });
    collect(
        pair_.b, scratch_.depth_b, scratch_.deep_b, scratch_.edges_b,
        [&](std::uint32_t i) { return pair_.corner_b(i); }, [&](const Vec3& n) { return -(pair_.turn * n); });
    best_.separation += kFaceBias * pair_.size;
    const double of_faces = best_.separation;
    for (const NearEdge& b : scratch_.edges_b) {
      for (const NearEdge& a : scratch_.edges_a) {
        if (can_win(a.depth + b.depth) && arcs_cross(a, b)) try_edge_pair(a, b);
      }
    }
    if (best_.separation == of_faces) best_.separation -= kFaceBias * pair_.size;
  }
  /// Whether some direction is in the normal cones of both edges, so that they carry a face of B - A. A segment's cone is a
  /// whole circle.
  [[nodiscard]] bool arcs_cross(const NearEdge& a, const NearEdge& b) const {
    const double bl = dot(b.left, a.along), br = dot(b.right, a.along);
    if (!pair_.b.faces.empty() && bl * br >= 0.0) return false;
    if (pair_.a.faces.empty()) return true;
    const double al = dot(a.left, b.along), ar = dot(a.right, b.along);
    if (al * ar >= 0.0) return false;
    if (pair_.b.faces.empty()) return true;
    // Both arcs cross the other's circle; now they have to do so on the same half of the sphere.
    const Vec3 on_arc_a = std::abs(ar) * a.left + std::abs(al) * a.right;
    const Vec3 on_arc_b = std::abs(br) * b.left + std::abs(bl) * b.right;
    return dot(on_arc_a, on_arc_b) > 0.0;
  }
  void try_edge_pair(const NearEdge& a, const NearEdge& b) {
    Vec3 n = cross(a.along, b.along);
    const double length2 = squared_norm(n);
    if (length2 <= kParallel * squared_norm(a.along) * squared_norm(b.along)) return;
    n *= 1.0 / std::sqrt(length2);
    // Seen from its middle, the edge of a solid lies outwards.
    const double outwards =
        pair_.a.faces.empty() ? dot(n, pair_.centre_b() - b.from) : dot(n, a.from - pair_.centre_a());
    if (outwards < 0.0) n = -n;
    const double s = dot(n, b.from - a.from);
    if (s <= best_.separation) return;
    const auto [on_a, on_b] = nearest_of_lines(a.from, a.along, b.from, b.along);
    best_ = {n, s, true, on_a, on_b};
  }

  const PlacedPair& pair_;
  Vec3 p_;
  AxisScratch& scratch_;
  Axis best_;
};

}  // namespace

Axis penetration(const PlacedPair& pair, const Vec3& p, AxisScratch& scratch) { return Search{pair, p, scratch}.run(); }

std::pair<Vec3, Vec3> nearest_of_lines(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const Vec3 r = p - q;
  const double uu = squared_norm(u), vv = squared_norm(v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > kParallel * uu * vv)) return {p + 0.5 * u, q + 0.5 * v};
  const double s = (uv * vr - vv * ur) / determinant;
  const double t = (uu * vr - uv * ur) / determinant;
  return {p + s * u, q + t * v};
}

}  // namespace scree::polyhedron
