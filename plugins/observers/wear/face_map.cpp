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

/// The corner that the longest edge begins at.
std::size_t longest_edge(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = norm(b - a), bc = norm(c - b), ca = norm(a - c);
  if (ab >= bc && ab >= ca) return 0;
  return bc >= ca ? 1 : 2;
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
    const std::size_t longest = longest_edge(out.vertices[t[0]], out.vertices[t[1]], out.vertices[t[2]]);
    const std::uint32_t a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
    if (norm(out.vertices[b] - out.vertices[a]) <= largest) {
      out.triangles.push_back(t);
      continue;
    }
    const auto middle = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(0.5 * (out.vertices[a] + out.vertices[b]));
    left.push_back({middle, b, c});
    left.push_back({a, middle, c});
  }
  return out;
}

std::size_t count_divided(const TriangleMesh& mesh, double largest, std::size_t most) {
  std::size_t count = 0;
  std::vector<std::array<Vec3, 3>> left;
  for (const Triangle& triangle : mesh.triangles) {
    left.push_back({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]});
    while (!left.empty()) {
      const std::array<Vec3, 3> t = left.back();
      left.pop_back();
      const std::size_t longest = longest_edge(t[0], t[1], t[2]);
      const Vec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3], middle = 0.5 * (a + b);
      if (norm(b - a) <= largest) {
        if (++count > most) return count;
        continue;
      }
      left.push_back({middle, b, c});
      left.push_back({a, middle, c});
    }
  }
  return count;
}

namespace {

/// The surfaces of a shape's primitives before they are divided.
struct Undivided {
  std::vector<TriangleMesh> meshes;
  std::vector<char> divides;  // by mesh

  [[nodiscard]] std::size_t count(double largest) const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      if (divides[k] != 0 && sum <= kMostFaces) sum += count_divided(meshes[k], largest, kMostFaces - sum);
    }
    return sum;
  }
};

// Half the edge makes four times the faces.
void refuse_too_many(const Undivided& surface, double largest) {
  if (surface.count(largest) <= kMostFaces) return;
  double undivided = 0.0, times = 1.0;
  for (std::size_t k = 0; k < surface.meshes.size(); ++k) {
    if (surface.divides[k] != 0) undivided += static_cast<double>(surface.meshes[k].triangles.size());
  }
  if (undivided > static_cast<double>(kMostFaces)) throw TooManyFaces{undivided, 0.0, 0};
  std::size_t possible = kMostFaces + 1;
  for (; possible > kMostFaces; possible = surface.count(largest)) largest *= 2.0, times *= 4.0;
  throw TooManyFaces{times * static_cast<double>(possible), largest, possible};
}

}  // namespace

FaceMap::FaceMap(const ShapeSet& shapes, const Shape& shape, const FaceOptions& options) {
  const std::span<const Primitive> primitives = shapes.primitives(shape);
  Undivided surface;
  std::vector<Vec3> corners;
  for (const Primitive& primitive : primitives) {
    const TriangleMesh& mesh = surface.meshes.emplace_back(surface_mesh(shapes, primitive, options));
    surface.divides.push_back(primitive.collides && (options.largest > 0.0 || !keeps_faces(primitive)) ? 1 : 0);
    corners.insert(corners.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  const Aabb extent = bounds_of(corners);
  const double largest = options.largest > 0.0 ? options.largest : norm(extent.upper - extent.lower) / kPartsOfExtent;
  refuse_too_many(surface, largest);
  for (std::uint32_t k = 0; k < primitives.size(); ++k) {
    Part part;
    part.first = triangles_.size();
    TriangleMesh& mesh = surface.meshes[k];
    if (primitives[k].collides && !mesh.triangles.empty()) {
      part.mesh = surface.divides[k] != 0 ? divided(mesh, largest) : std::move(mesh);
      part.tree = std::make_unique<TriangleTree>(part.mesh);
    }
    append(part, k);
    parts_.push_back(std::move(part));
  }
}

void FaceMap::append(const Part& part, std::uint32_t primitive) {
  const auto base = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
  for (const Triangle& t : part.mesh.triangles) {
    triangles_.push_back({t[0] + base, t[1] + base, t[2] + base});
    area_.push_back(area_of(part.mesh, t));
    primitive_.push_back(primitive);
  }
}

std::size_t FaceMap::nearest(std::uint32_t primitive, const Vec3& point) const {
  const Part& part = parts_[primitive];
  return part.first + closest_triangle(part.mesh, *part.tree, point).triangle;
}

}  // namespace scree
