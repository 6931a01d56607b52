// A triangle of a mesh as a polytope of two faces, back to back.
#pragma once

#include <array>

#include "mesh_surface.hpp"
#include "polytope.hpp"

namespace scree::polyhedron {

/// Owns what its polytope points to. Face 0 looks along the triangle's normal, face 1 the other way; edge k joins corners k
/// and k + 1.
class TrianglePolytope {
 public:
  explicit TrianglePolytope(const MeshTriangle& t) {
    const auto& [a, b, c] = t.corner;
    lanes_ = {a.x, b.x, c.x, c.x, a.y, b.y, c.y, c.y, a.z, b.z, c.z, c.z};
    const double offset = dot(t.normal, a);
    faces_ = {Face{t.normal, offset}, Face{-t.normal, -offset}};
    view_.lanes = lanes_.data();
    view_.corner_count = 3;
    view_.faces = faces_;
    view_.first_side = kFirstSide;
    view_.sides = kSides;
    view_.edges = kEdges;
    view_.centre = (1.0 / 3.0) * (a + b + c);
    for (const Vec3& corner : t.corner) view_.size = std::max(view_.size, norm(corner - view_.centre));
  }
  TrianglePolytope(const TrianglePolytope&) = delete;
  TrianglePolytope& operator=(const TrianglePolytope&) = delete;
  [[nodiscard]] const Polytope& view() const { return view_; }

 private:
  static constexpr std::array<std::uint32_t, 3> kFirstSide{0, 3, 6};
  static constexpr std::array<Side, 6> kSides{Side{0, 0}, {1, 1}, {2, 2}, {0, 2}, {2, 1}, {1, 0}};
  static constexpr std::array<Edge, 3> kEdges{Edge{0, 1, 0, 1}, {1, 2, 0, 1}, {2, 0, 0, 1}};

  std::array<double, 3 * kLane> lanes_;
  std::array<Face, 2> faces_;
  Polytope view_;
};

}  // namespace scree::polyhedron
