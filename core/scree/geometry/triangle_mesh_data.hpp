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

  // From here on filled by examine_mesh() only (mesh_examination.hpp).
  std::size_t crossings = 0;         ///< pairs of triangles that pass through each other; counted up to 1000
  Vec3 crossing_at;                  ///< one place where they do [m]
  std::size_t shells = 0;            ///< parts that do not hang together by edges
  std::size_t misplaced_shells = 0;  ///< shells that lie in another with the same sense, or face inwards alone
  bool one_sided = false;            ///< no choice of normals agrees at all edges, as on a Moebius strip

  /// Every edge has exactly two triangles.
  [[nodiscard]] bool is_closed() const { return open_edges == 0 && crowded_edges == 0; }
  /// Neighbours pass their common edge in opposite senses.
  [[nodiscard]] bool is_oriented() const { return misoriented_edges == 0; }
  /// Closed, oriented, outward and free of degenerate triangles: volume and inside are well defined.
  [[nodiscard]] bool is_solid() const;
  /// What keeps the mesh from being a solid, worst first, each with its remedy, as sentences; empty when it is one.
  [[nodiscard]] std::vector<std::string> problems() const;
  /// The first of problems(); empty for none.
  [[nodiscard]] std::string problem() const;
};

/// Counts what is wrong with a mesh. Never throws on a bad mesh. Cost O(n log n).
[[nodiscard]] MeshReport check_mesh(const TriangleMesh& mesh);

/// The mesh with every triangle turned over, so that an inside-out solid becomes a solid.
[[nodiscard]] TriangleMesh turned_inside_out(TriangleMesh mesh);

/// The mesh without the triangles that check_mesh() counts as degenerate; vertices stay.
[[nodiscard]] TriangleMesh without_degenerate(TriangleMesh mesh);

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
