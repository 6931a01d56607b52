#include "face_map.hpp"

#include <algorithm>
#include <array>

#include "scree/geometry/closest_triangle.hpp"
#include "vtp/surface.hpp"

namespace scree {

namespace {

constexpr double kPartsOfExtent = 40.0;

bool keeps_faces(const Primitive& primitive) {
  return primitive.kind == ShapeKind::triangle_mesh || primitive.kind == ShapeKind::convex_hull;
}

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return 0.5 * norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
}

// A hollow cylinder is closed: its lids wear as well.
TriangleMesh surface_mesh(const ShapeSet& shapes, Primitive primitive, const FaceOptions& options) {
  primitive.hollow = false;
  Surface surface;
  append_surface(shapes, primitive, {}, SurfaceOptions{options.segments, options.plane_size}, surface);
  return {std::move(surface.points), std::move(surface.triangles)};
}

}  // namespace

TriangleMesh divided(const TriangleMesh& mesh, double largest) {
  TriangleMesh out;
  out.vertices = mesh.vertices;
  std::vector<Triangle> left{mesh.triangles.rbegin(), mesh.triangles.rend()};
  while (!left.empty()) {
    const Triangle t = left.back();
    left.pop_back();
    std::size_t longest = 0;
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k) {
      length[k] = norm(out.vertices[t[(k + 1) % 3]] - out.vertices[t[k]]);
      if (length[k] > length[longest]) longest = k;
    }
    if (length[longest] <= largest) {
      out.triangles.push_back(t);
      continue;
    }
    const std::uint32_t a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
    const auto middle = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(0.5 * (out.vertices[a] + out.vertices[b]));
    left.push_back({middle, b, c});
    left.push_back({a, middle, c});
  }
  return out;
}

FaceMap::FaceMap(const ShapeSet& shapes, const Shape& shape, const FaceOptions& options) {
  const std::span<const Primitive> primitives = shapes.primitives(shape);
  std::vector<TriangleMesh> meshes;
  std::vector<Vec3> corners;
  for (const Primitive& primitive : primitives) {
    meshes.push_back(surface_mesh(shapes, primitive, options));
    corners.insert(corners.end(), meshes.back().vertices.begin(), meshes.back().vertices.end());
  }
  const Aabb extent = bounds_of(corners);
  const double fine = norm(extent.upper - extent.lower) / kPartsOfExtent;
  for (std::uint32_t k = 0; k < primitives.size(); ++k) {
    Part part;
    part.first = triangles_.size();
    if (primitives[k].collides && !meshes[k].triangles.empty()) {
      const bool divide = options.largest > 0.0 || !keeps_faces(primitives[k]);
      part.mesh = divide ? divided(meshes[k], options.largest > 0.0 ? options.largest : fine) : std::move(meshes[k]);
      part.tree = std::make_unique<TriangleTree>(part.mesh);
    }
    const auto base = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
    for (const Triangle& t : part.mesh.triangles) {
      triangles_.push_back({t[0] + base, t[1] + base, t[2] + base});
      area_.push_back(area_of(part.mesh, t));
      primitive_.push_back(k);
    }
    parts_.push_back(std::move(part));
  }
}

std::size_t FaceMap::nearest(std::uint32_t primitive, const Vec3& point) const {
  const Part& part = parts_[primitive];
  return part.first + closest_triangle(part.mesh, *part.tree, point).triangle;
}

}  // namespace scree
