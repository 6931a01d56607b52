// TriangleMesh: a surface as vertices and triangles, and the checks that tell whether it bounds a solid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scree/math/aabb.hpp"

namespace scree {

/// Three indices into the vertices of a mesh, counter-clockwise when seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangulated surface.
struct TriangleMesh {
  std::vector<Vec3> vertices;       ///< [m], shape frame
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
};

/// What check_mesh() found. A mesh bounds a solid when is_solid() holds.
struct MeshReport {
  std::size_t bad_indices = 0;           ///< triangles that name a vertex which does not exist
  std::size_t bad_vertices = 0;          ///< vertices with a coordinate that is NaN or infinite
  std::size_t degenerate_triangles = 0;  ///< triangles whose area is below 1e-14 of the squared extent
  std::size_t open_edges = 0;            ///< edges with one triangle
  std::size_t crowded_edges = 0;         ///< edges with more than two triangles
  std::size_t misoriented_edges = 0;     ///< edges whose two triangles pass them in the same sense
  bool inside_out = false;  ///< a closed, oriented mesh whose volume is negative: the normals point inwards
  int euler = 0;            ///< vertices in use - edges + triangles; 2 for a surface like a sphere's
  double volume = 0.0;      ///< [m^3], signed; means something when the mesh is closed and oriented

  /// Every edge has exactly two triangles.
  [[nodiscard]] bool is_closed() const { return open_edges == 0 && crowded_edges == 0; }
  /// Neighbours pass their common edge in opposite senses.
  [[nodiscard]] bool is_oriented() const { return misoriented_edges == 0; }
  /// Closed, oriented, outward and free of degenerate triangles: volume and inside are well defined.
  [[nodiscard]] bool is_solid() const;
  /// The first thing that keeps the mesh from being a solid, with the remedy, as a sentence; empty when it is one.
  [[nodiscard]] std::string problem() const;
};

/// Counts what is wrong with a mesh. Never throws on a bad mesh. Cost O(n log n).
[[nodiscard]] MeshReport check_mesh(const TriangleMesh& mesh);

/// The mesh with every triangle turned over, so that an inside-out solid becomes a solid.
[[nodiscard]] TriangleMesh turned_inside_out(TriangleMesh mesh);

/// One vertex for all that lie within `distance` [m] of each other along every axis; triangles that collapse are
/// dropped. File formats such as STL store each triangle's corners separately.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& mesh, double distance);

/// The bounding box of points [m]; Aabb::empty() for none.
[[nodiscard]] Aabb bounds_of(std::span<const Vec3> points);

/// A closed box mesh of 12 triangles with the given half lengths [m], centred on the origin.
[[nodiscard]] TriangleMesh box_mesh(const Vec3& half_lengths);

/// A closed prism over a regular polygon that inscribes a cylinder along z, centred on the origin.
/// @param radius [m], @param half_length [m], @param sides number of corners on the rim, at least 3.
[[nodiscard]] TriangleMesh cylinder_mesh(double radius, double half_length, int sides);

}  // namespace scree
