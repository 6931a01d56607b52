#include "mesh_axis.hpp"

#include <cmath>

namespace scree::polyhedron {
namespace {

/// The triangle's own normal is kept unless another one is shallower by this, in sizes.
constexpr double kFaceBias = 1e-4;
/// Cosine of 1e-5: within it a direction is the triangle's normal.
constexpr double kUpright = 1.0 - 5e-11;
/// Corners within this of the farthest, in sizes of the triangle, carry the contact together.
constexpr double kSameHeight = 1e-6;
/// Squared sine below which edges are parallel.
constexpr double kParallel = 1e-10;

/// Whether a direction at this cosine to the triangle's normal is another way out. At a sharp edge or corner of a closed mesh it may
/// look against the normal; an open one holds the solid on its side.
bool is_way_out(const MeshSurface& mesh, double cosine) {
  return cosine < kUpright && (cosine > 0.0 || (mesh.closed() && cosine > -kUpright));
}

/// An edge is the lowest of the solid along m when both of its faces rise from it.
bool is_lowest(const PlacedPair& pair, const Edge& edge, const Vec3& m) {
  if (edge.left == kNoFace) return true;
  const Vec3 in_b = pair.turn_back * m;
  const Vec3 &left = pair.b.faces[edge.left].normal, &right = pair.b.faces[edge.right].normal;
  const Vec3 way = pair.b.corner(edge.to) - pair.b.corner(edge.from);
  return dot(cross(left, way), in_b) >= 0.0 && dot(cross(way, right), in_b) >= 0.0;
}

/// Calls visit(m, on the triangle, on the solid) for the cross products of the triangle's edges with those of the solid, where the
/// normal cones of both hold m.
template <class Visit>
void for_edge_pairs(const MeshSurface& mesh, const MeshTriangle& triangle, const PlacedPair& pair, const Vec3& out,
                    const Visit& visit) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3& p = triangle.corner[k];
    const Vec3 u = triangle.corner[(k + 1) % 3] - p;
    for (const Edge& edge : pair.b.edges) {
      if (edge.left != kNoFace && edge.right == kNoFace) continue;
      const Vec3 q = pair.corner_b(edge.from), v = pair.corner_b(edge.to) - q;
      Vec3 m = cross(u, v);
      const double length2 = squared_norm(m);
      if (length2 <= kParallel * squared_norm(u) * squared_norm(v)) continue;
      m *= (dot(m, out) < 0.0 ? -1.0 : 1.0) / std::sqrt(length2);
      for (const Vec3& way : {m, -m}) {
        if (is_lowest(pair, edge, way) && is_way_out(mesh, dot(way, out)) && mesh.edge_admits(triangle, k, way))
          visit(way, p, u, q, v);
      }
    }
  }
}

}  // namespace

bool admits(const MeshSurface& mesh, const MeshTriangle& triangle, const Vec3& m) {
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) height[k] = dot(m, triangle.corner[k] - triangle.corner[0]);
  const double most = std::max({height[0], height[1], height[2]});
  const double size = norm(triangle.corner[1] - triangle.corner[0]) + norm(triangle.corner[2] - triangle.corner[0]);
  const auto carries = [&](std::size_t k) { return height[k] >= most - kSameHeight * size; };
  if (carries(0) && carries(1) && carries(2)) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (carries(k) && carries((k + 1) % 3)) return mesh.edge_admits(triangle, k, m);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (carries(k)) return mesh.corner_admits(triangle, k, m);
  }
  return false;
}

Axis axis_out_of(const MeshSurface& mesh, const MeshTriangle& triangle, const PlacedPair& pair, const Vec3& out,
                 const Vec3& p) {
  Axis best{out, pair.separation(out), false, p, p};
  const double bias = kFaceBias * pair.size;
  const auto better = [&](double s) { return s > best.separation + (best.normal == out ? bias : 0.0); };
  for (const Face& face : pair.b.faces) {
    const Vec3 m = -(pair.turn * face.normal);
    if (!is_way_out(mesh, dot(m, out))) continue;
    const double s = pair.separation(m);
    if (better(s) && admits(mesh, triangle, m)) best = {m, s, false, p, p};
  }
  for_edge_pairs(mesh, triangle, pair, out,
                 [&](const Vec3& m, const Vec3& a, const Vec3& u, const Vec3& b, const Vec3& v) {
                   const double s = dot(m, b - a);
                   if (!better(s)) return;
                   const auto [on_a, on_b] = nearest_of_lines(a, u, b, v);
                   best = {m, s, true, on_a, on_b};
                 });
  return best;
}

}  // namespace scree::polyhedron
