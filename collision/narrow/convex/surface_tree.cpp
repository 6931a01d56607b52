#include "surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace scree::convex {
namespace {

constexpr std::size_t kLeaf = 4;
/// Normals this far beyond an edge still count as those of the triangle [rad].
constexpr double kSlack = 0.01;
/// Corners this near to the farthest one are as far [size of the triangle].
constexpr double kSameHeight = 1e-6;

Aabb box_of(const SurfaceTriangle& t) {
  return merged(merged(Aabb{t.corner[0], t.corner[0]}, t.corner[1]), t.corner[2]);
}

}  // namespace

SurfaceTree::SurfaceTree(const ShapeSet& shapes, const Primitive& mesh) {
  const auto vertices = shapes.vertices();
  std::vector<Triangle> corners;
  for (const Triangle& t : shapes.triangles().subspan(mesh.first_triangle, mesh.triangle_count)) {
    SurfaceTriangle made;
    for (std::size_t k = 0; k < 3; ++k) made.corner[k] = vertices[t[k]];
    made.normal = normalized(cross(made.corner[1] - made.corner[0], made.corner[2] - made.corner[0]));
    if (!(squared_norm(made.normal) > 0.5)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      made.out[k] = normalized(cross(made.corner[(k + 1) % 3] - made.corner[k], made.normal));
    }
    triangle_.push_back(made);
    corners.push_back(t);
  }
  find_folds(corners);
  order_.resize(triangle_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (triangle_.empty()) return;
  node_.emplace_back();
  build(0, 0, order_.size());
}

void SurfaceTree::find_folds(const std::vector<Triangle>& corners) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> owner;  // of directed edges
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) owner[{corners[i][k], corners[i][(k + 1) % 3]}] = i;
  }
  std::map<std::uint32_t, std::vector<Vec3>> rays;  // along the edges that leave a vertex
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const Vec3 ray = normalized(triangle_[i].corner[next] - triangle_[i].corner[k]);
      rays[corners[i][k]].push_back(ray);
      rays[corners[i][next]].push_back(-ray);
    }
  }
  std::map<std::uint32_t, std::uint32_t> number;
  for (const auto& [vertex, list] : rays) {
    number[vertex] = static_cast<std::uint32_t>(rays_of_.size());
    const auto first = static_cast<std::ptrdiff_t>(rays_.size());
    rays_.insert(rays_.end(), list.begin(), list.end());
    rays_of_.emplace_back(first, static_cast<std::ptrdiff_t>(rays_.size()));
  }
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) triangle_[i].vertex[k] = number[corners[i][k]];
  }
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    SurfaceTriangle& t = triangle_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto neighbour = owner.find({corners[i][(k + 1) % 3], corners[i][k]});
      if (neighbour == owner.end()) {
        t.fold[k] = std::numbers::pi;
        t.next[k] = i;
        closed_ = false;
      } else {
        t.next[k] = neighbour->second;
        const Vec3& other = triangle_[neighbour->second].normal;
        t.fold[k] = std::atan2(dot(other, t.out[k]), dot(other, t.normal));
      }
    }
  }
}

void SurfaceTree::build(std::size_t node, std::size_t first, std::size_t last) {
  Aabb box = Aabb::empty(), centres = Aabb::empty();
  const auto centre = [&](std::uint32_t i) {
    return (triangle_[i].corner[0] + triangle_[i].corner[1] + triangle_[i].corner[2]) / 3.0;
  };
  for (std::size_t k = first; k < last; ++k) {
    box = merged(box, box_of(triangle_[order_[k]]));
    centres = merged(centres, centre(order_[k]));
  }
  node_[node] = {box, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), 0};
  if (last - first <= kLeaf) return;
  const Vec3 extent = centres.upper - centres.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const std::size_t middle = (first + last) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t l, std::uint32_t r) {
    const double x = centre(l)[axis], y = centre(r)[axis];
    return x < y || (x == y && l < r);
  });
  node_.emplace_back();
  build(node + 1, first, middle);
  node_[node].right = static_cast<std::uint32_t>(node_.size());
  node_.emplace_back();
  build(node_[node].right, middle, last);
}

void SurfaceTree::find(const Aabb& box, std::vector<std::uint32_t>& out) const {
  if (node_.empty()) return;
  const std::size_t begin = out.size();
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = node_[at];
    if (!overlap(node.box, box)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.last; ++k) {
      if (overlap(box_of(triangle_[order_[k]]), box)) out.push_back(order_[k]);
    }
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end());
}

bool SurfaceTree::owns(std::uint32_t i, const Vec3& n, double side) const {
  const SurfaceTriangle& t = triangle_[i];
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) height[k] = dot(n, t.corner[k] - t.corner[0]);
  const double top = std::ranges::max(height);
  const double level = kSameHeight * (norm(t.corner[1] - t.corner[0]) + norm(t.corner[2] - t.corner[0]));
  std::array<bool, 3> without{};
  for (std::size_t k = 0; k < 3; ++k) without[k] = height[k] < top - level;
  const double up = side * dot(n, t.normal);
  const auto count = std::ranges::count(without, true);
  if (count == 0) return up > 0.0 || !closed_;
  if (count == 1) {
    const std::size_t edge = without[0] ? 1 : (without[1] ? 2 : 0);
    const double fold = t.fold[edge] == std::numbers::pi ? std::numbers::pi : std::max(0.0, side * t.fold[edge]);
    return std::atan2(dot(n, t.out[edge]), up) < fold + kSlack && (up > -1.0 + kSlack);
  }
  const std::size_t corner = !without[0] ? 0 : (!without[1] ? 1 : 2);
  const auto [first, last] = rays_of_[t.vertex[corner]];
  return std::all_of(rays_.begin() + first, rays_.begin() + last,
                     [&](const Vec3& ray) { return dot(n, ray) < kSlack; });
}

}  // namespace scree::convex
