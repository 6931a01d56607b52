#include <algorithm>
#include <limits>
#include <map>

#include "scree/base/error.hpp"
#include "scree/geometry/closest_triangle.hpp"
#include "scree/geometry/signed_distance.hpp"

namespace scree {
namespace {

/// The mesh, if it is a solid.
TriangleMesh solid_mesh(TriangleMesh mesh) {
  if (const std::string problem = check_mesh(mesh).problem(); !problem.empty()) {
    throw Error{ErrorKind::usage, "the mesh does not bound a solid: " + problem};
  }
  return mesh;
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh) : mesh_{solid_mesh(std::move(mesh))}, tree_{mesh_} { compute_normals(); }

void MeshDistance::compute_normals() {
  vertex_normals_.assign(mesh_.vertices.size(), {});
  triangle_normals_.resize(mesh_.triangles.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> edges;
  const auto edge_key = [](std::uint32_t a, std::uint32_t b) { return std::pair{std::min(a, b), std::max(a, b)}; };
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const Vec3 normal = normalized(cross(b - a, c - a));
    triangle_normals_[i][3] = normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& at = mesh_.vertices[t[k]];
      const Vec3 next = mesh_.vertices[t[(k + 1) % 3]] - at, last = mesh_.vertices[t[(k + 2) % 3]] - at;
      vertex_normals_[t[k]] += std::atan2(norm(cross(next, last)), dot(next, last)) * normal;
      edges[edge_key(t[k], t[(k + 1) % 3])] += normal;
    }
  }
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) triangle_normals_[i][k] = edges[edge_key(t[k], t[(k + 1) % 3])];
  }
}

MeshDistance::Closest MeshDistance::closest(const Vec3& p) const {
  const NearTriangle near = closest_triangle(mesh_, tree_, p);
  const auto feature = static_cast<std::size_t>(near.at.feature);
  const Vec3& normal = feature < 3 ? vertex_normals_[mesh_.triangles[near.triangle][feature]]
                                   : triangle_normals_[near.triangle][feature - 3];
  const double sign = dot(p - near.at.point, normal) < 0.0 ? -1.0 : 1.0;
  return {near.at.point, sign * std::sqrt(near.squared_distance), near.triangle};
}

}  // namespace scree
