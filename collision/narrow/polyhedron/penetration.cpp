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
    depth.clear();
    for (const Face& face : solid.faces) depth.push_back(face.offset - dot(face.normal, p));
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
    for (std::uint32_t f = 0; f < pair_.a.faces.size(); ++f) {
      if (can_win(scratch_.depth_a[f])) try_face_of_a(f);
    }
    for (std::uint32_t f = 0; f < pair_.b.faces.size(); ++f) {
      if (can_win(scratch_.depth_b[f])) try_face_of_b(f);
    }
  }

  void collect(const Polytope& solid, const std::vector<double>& depth, std::vector<std::uint32_t>& edges) const {
    edges.clear();
    for (std::uint32_t e = 0; e < solid.edges.size(); ++e) {
      const Edge& edge = solid.edges[e];
      const bool segment = edge.left == kNoFace;
      if (!segment && edge.right == kNoFace) continue;
      if (segment || can_win(std::min(depth[edge.left], depth[edge.right]))) edges.push_back(e);
    }
  }
  void try_edges() {
    collect(pair_.a, scratch_.depth_a, scratch_.edges_a);
    collect(pair_.b, scratch_.depth_b, scratch_.edges_b);
    best_.separation += kFaceBias * pair_.size;
    const double without_edges = best_.separation;
    for (const std::uint32_t j : scratch_.edges_b) {
      const Edge& eb = pair_.b.edges[j];
      const Vec3 q = pair_.corner_b(eb.from), v = pair_.corner_b(eb.to) - q;
      Vec3 c, d;  // what b's faces look like from a
      if (eb.left != kNoFace) {
        c = -(pair_.turn * pair_.b.faces[eb.left].normal);
        d = -(pair_.turn * pair_.b.faces[eb.right].normal);
      }
      for (const std::uint32_t i : scratch_.edges_a) {
        const Edge& ea = pair_.a.edges[i];
        const Vec3 p = pair_.a.corner(ea.from), u = pair_.a.corner(ea.to) - p;
        if (arcs_cross(ea, eb, u, v, c, d)) try_edge_pair(p, u, q, v);
      }
    }
    if (best_.separation == without_edges) best_.separation -= kFaceBias * pair_.size;
  }
  /// Whether some direction is in the normal cones of both edges, so that they carry a face of B - A. A segment's cone is a
  /// whole circle.
  [[nodiscard]] bool arcs_cross(const Edge& ea, const Edge& eb, const Vec3& u, const Vec3& v, const Vec3& c,
                                const Vec3& d) const {
    const double cu = dot(c, u), du = dot(d, u);
    if (eb.left != kNoFace && cu * du >= 0.0) return false;
    if (ea.left == kNoFace) return true;
    const Vec3 &a = pair_.a.faces[ea.left].normal, &b = pair_.a.faces[ea.right].normal;
    const double av = dot(a, v), bv = dot(b, v);
    if (av * bv >= 0.0) return false;
    if (eb.left == kNoFace) return true;
    // Both arcs cross the other's circle; now they have to do so on the same half of the sphere.
    const Vec3 on_arc_a = std::abs(bv) * a + std::abs(av) * b;
    const Vec3 on_arc_b = std::abs(du) * c + std::abs(cu) * d;
    return dot(on_arc_a, on_arc_b) > 0.0;
  }
  void try_edge_pair(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
    Vec3 n = cross(u, v);
    const double length2 = squared_norm(n);
    if (length2 <= kParallel * squared_norm(u) * squared_norm(v)) return;
    n *= 1.0 / std::sqrt(length2);
    // Out of a solid its edge lies outwards of its middle; of two segments, the direction between their middles.
    const double outwards = pair_.a.faces.empty() ? dot(n, pair_.centre_b() - q) : dot(n, p - pair_.centre_a());
    if (outwards < 0.0) n = -n;
    const double s = dot(n, q - p);
    if (s <= best_.separation) return;
    const auto [on_a, on_b] = nearest_of_lines(p, u, q, v);
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
