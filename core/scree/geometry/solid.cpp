#include "scree/geometry/solid.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>

#include "scree/geometry/signed_distance.hpp"

namespace scree {
namespace {

/// Sides of the prism from which the samples of a cylinder start; even, so that corners lie opposite each other.
constexpr int kCylinderSides = 32;

double largest_distance(const std::vector<Vec3>& points) {
  double squared = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j)
      squared = std::max(squared, squared_norm(points[i] - points[j]));
  }
  return std::sqrt(squared);
}

double signed_volume(const TriangleMesh& mesh) { return check_mesh(mesh).volume; }

/// Takes a point beside the surface onto it, along the normal of the face that it was sampled from.
SurfaceSample onto_surface(const Solid& solid, const Vec3& p, const Vec3& normal) {
  return {p - solid.signed_distance(p) * normal, normal};
}

void sample_faces(const Solid& solid, int count, std::vector<SurfaceSample>& samples) {
  double total = 0.0;
  const auto area_vector = [&](const Triangle& t) {
    const Vec3& a = solid.surface.vertices[t[0]];
    return 0.5 * cross(solid.surface.vertices[t[1]] - a, solid.surface.vertices[t[2]] - a);
  };
  for (const Triangle& t : solid.surface.triangles) total += norm(area_vector(t));

  // Points of the R2 sequence, folded from the unit square into the triangle; each triangle gets its share.
  constexpr double kPlastic = 1.32471795724474602596;
  double due = 0.5;
  long index = 0;
  for (const Triangle& t : solid.surface.triangles) {
    const Vec3 area = area_vector(t), normal = normalized(area);
    const Vec3& a = solid.surface.vertices[t[0]];
    const Vec3 ab = solid.surface.vertices[t[1]] - a, ac = solid.surface.vertices[t[2]] - a;
    for (due += count * norm(area) / total; due >= 1.0; due -= 1.0) {
      ++index;
      double u = std::fmod(0.5 + static_cast<double>(index) / kPlastic, 1.0);
      double v = std::fmod(0.5 + static_cast<double>(index) / (kPlastic * kPlastic), 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      samples.push_back(onto_surface(solid, a + u * ab + v * ac, normal));
    }
  }
}

void sample_edges_and_corners(const Solid& solid, double spacing, std::vector<SurfaceSample>& samples) {
  const TriangleMesh& mesh = solid.surface;
  std::vector<Vec3> corner_normals(mesh.vertices.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Vec3>> edges;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 normal = normalized(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = t[k], q = t[(k + 1) % 3];
      corner_normals[p] += normal;
      edges[{std::min(p, q), std::max(p, q)}].push_back(normal);
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    samples.push_back({mesh.vertices[i], normalized(corner_normals[i])});
  }
  constexpr double kSharp = 0.95;  // cosine of the angle between faces below which their edge stands out
  for (const auto& [ends, normals] : edges) {
    if (normals.size() != 2 || dot(normals[0], normals[1]) > kSharp) continue;
    const Vec3 &a = mesh.vertices[ends.first], &b = mesh.vertices[ends.second];
    const int pieces = 1 + static_cast<int>(norm(b - a) / spacing);
    for (int k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      samples.push_back({(1.0 - share) * a + share * b, normalized(normals[0] + normals[1])});
    }
  }
}

}  // namespace

Solid box_solid(const Vec3& h) {
  return {[h](const Vec3& p) { return box_signed_distance(h, p); }, box_mesh(h), 8.0 * h.x * h.y * h.z, 2.0 * norm(h)};
}

Solid cylinder_solid(double radius, double half_length) {
  return {[=](const Vec3& p) { return cylinder_signed_distance(radius, half_length, p); },
          cylinder_mesh(radius, half_length, kCylinderSides), 2.0 * std::numbers::pi * radius * radius * half_length,
          2.0 * std::hypot(radius, half_length)};
}

Solid hull_solid(const ConvexHull& hull) {
  return {[hull](const Vec3& p) { return hull_signed_distance(hull, p); }, surface_of(hull),
          signed_volume(surface_of(hull)), largest_distance(hull.vertices)};
}

Solid mesh_solid(const TriangleMesh& mesh) {
  const auto distance = std::make_shared<const MeshDistance>(mesh);
  return {[distance](const Vec3& p) { return distance->signed_distance(p); }, mesh, signed_volume(mesh),
          largest_distance(mesh.vertices)};
}

std::vector<SurfaceSample> sample_surface(const Solid& solid, int count) {
  std::vector<SurfaceSample> samples;
  sample_faces(solid, count, samples);
  double area = 0.0;
  for (const Triangle& t : solid.surface.triangles) {
    const Vec3& a = solid.surface.vertices[t[0]];
    area += 0.5 * norm(cross(solid.surface.vertices[t[1]] - a, solid.surface.vertices[t[2]] - a));
  }
  sample_edges_and_corners(solid, std::sqrt(area / count), samples);
  return samples;
}

}  // namespace scree
