// Signed distances from a point to solids: negative inside, zero on the surface, positive outside; all exact.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"
#include "scree/geometry/triangle_tree.hpp"

namespace scree {

/// Of a box about the origin. @param half_lengths [m] @param p [m] @return [m]
[[nodiscard]] double box_signed_distance(const Vec3& half_lengths, const Vec3& p);
/// Of a solid cylinder along z about the origin. @param radius [m] @param half_length [m] @param p [m] @return [m]
[[nodiscard]] double cylinder_signed_distance(double radius, double half_length, const Vec3& p);
/// Of a capsule along z about the origin. @param half_length [m], of the cylindrical part @return [m]
[[nodiscard]] double capsule_signed_distance(double radius, double half_length, const Vec3& p);
/// Of a cone along z, base at -half_height [m], apex at +half_height. @param radius of the base [m] @return [m]
[[nodiscard]] double cone_signed_distance(double radius, double half_height, const Vec3& p);
/// Of a convex hull, cost O(faces). @param p [m] @return [m]
[[nodiscard]] double hull_signed_distance(const ConvexHull& hull, const Vec3& p);

/// Where on a triangle the closest point lies: 0, 1, 2: that corner; 3, 4, 5: the edge from corner 0, 1, 2 to the next;
/// 6: inside.
struct TrianglePoint {
  Vec3 point;       ///< [m]
  int feature = 6;  ///< corner, edge or inside, as above
};

/// Closest point of a triangle to p (Ericson, Real-Time Collision Detection, section 5.1.5).
[[nodiscard]] TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Closest points and signed distances of a mesh, through a tree of boxes: O(log n) a query.
///
/// The sign comes from the angle-weighted pseudonormal of the closest feature (Baerentzen and Aanaes, "Signed distance
/// computation using the angle weighted pseudonormal", 2005), exact for closed, oriented meshes.
class MeshDistance {
 public:
  /// @throws Error (usage) when the mesh is not a solid.
  explicit MeshDistance(TriangleMesh mesh);

  /// What a query returns.
  struct Closest {
    Vec3 point;                ///< on the surface [m]
    double distance = 0.0;     ///< signed [m]
    std::size_t triangle = 0;  ///< that holds the point
  };
  [[nodiscard]] Closest closest(const Vec3& p) const;
  [[nodiscard]] double signed_distance(const Vec3& p) const { return closest(p).distance; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  void compute_normals();

  TriangleMesh mesh_;
  TriangleTree tree_;
  std::vector<Vec3> vertex_normals_;
  std::vector<std::array<Vec3, 4>> triangle_normals_;  // edges 0, 1, 2 and the face
};

}  // namespace scree
