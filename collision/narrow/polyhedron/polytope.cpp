#include "polytope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"

namespace scree::polyhedron {
namespace {

using Lanes = double __attribute__((vector_size(kLane * sizeof(double))));
using Places = std::int64_t __attribute__((vector_size(kLane * sizeof(double))));

/// Faces whose normals agree to this are one plane: far above what Qhull leaves, far below what a contact notices.
constexpr double kSamePlane = 1e-12;

Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

template <class Item>
void fetch(std::span<const Item> items) {
  constexpr std::size_t kCacheLine = 64, kMost = 1024;
  const char* const at = reinterpret_cast<const char*>(items.data());
  for (std::size_t i = 0; i < std::min(items.size_bytes(), kMost); i += kCacheLine) __builtin_prefetch(at + i);
}

/// The given faces without those that lie in the plane of an earlier one.
std::vector<Face> different_planes(std::span<const Face> faces) {
  std::vector<Face> planes;
  for (const Face& face : faces) {
    const auto same = [&](const Face& plane) { return dot(plane.normal, face.normal) > 1.0 - kSamePlane; };
    if (std::none_of(planes.begin(), planes.end(), same)) planes.push_back(face);
  }
  return planes;
}

/// The plane that a triangle of the surface lies in.
std::uint32_t plane_of(std::span<const Face> planes, const std::array<Vec3, 3>& corners) {
  const Vec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < planes.size(); ++f) {
    if (dot(planes[f].normal, area) < 0.0) continue;
    double off = 0.0;
    for (const Vec3& c : corners) off = std::max(off, std::abs(dot(planes[f].normal, c) - planes[f].offset));
    if (off >= least) continue;
    least = off;
    best = f;
  }
  return best;
}

using Way = std::pair<std::uint32_t, std::uint32_t>;

/// The rim of a set of triangles of one plane: sides without an opposite one, walked once round. Empty when they are not
/// one ring.
std::vector<std::uint32_t> rim_of(std::span<const Triangle> triangles) {
  std::map<Way, int> ways;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++ways[{t[k], t[(k + 1) % 3]}];
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [way, count] : ways) {
    if (ways.contains({way.second, way.first})) continue;
    if (count != 1 || !next.emplace(way).second) return {};
  }
  std::vector<std::uint32_t> rim;
  if (next.empty()) return rim;
  std::uint32_t at = next.begin()->first;
  do {
    rim.push_back(at);
    const auto step = next.find(at);
    if (step == next.end()) return {};
    at = step->second;
  } while (at != rim.front() && rim.size() <= next.size());
  return rim.size() == next.size() ? rim : std::vector<std::uint32_t>{};
}

}  // namespace

void fetch_faces(const Polytope& solid) {
  fetch(solid.faces);
  fetch(solid.edges);
  fetch(solid.sides);
  fetch(solid.first_side);
}

std::uint32_t farthest(const Polytope& solid, const Vec3& direction) {
  const Lanes x = Lanes{} + direction.x, y = Lanes{} + direction.y, z = Lanes{} + direction.z;
  const std::uint32_t groups = (solid.corner_count + kLane - 1) / kLane;
  const double* at = solid.lanes;
  Lanes most = load(at) * x + load(at + kLane) * y + load(at + 2 * kLane) * z;
  Places place{};
  for (std::uint32_t g = 1; g < groups; ++g) {
    at += 3 * kLane;
    const Lanes value = load(at) * x + load(at + kLane) * y + load(at + 2 * kLane) * z;
    const Places better = value > most;
    most = better ? value : most;
    place = better ? Places{} + std::int64_t{g} : place;
  }
  // The least index of those that reach the maximum, without branches that nobody can predict.
  const double top = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  const Places index = most == top ? place * kLane + Places{0, 1, 2, 3} : Places{} + kNever;
  const std::int64_t first = std::min(std::min(index[0], index[1]), std::min(index[2], index[3]));
  return static_cast<std::uint32_t>(std::min(first, std::int64_t{solid.corner_count - 1}));
}

bool several_above(const Polytope& solid, const Vec3& direction, double height) {
  const Lanes x = Lanes{} + direction.x, y = Lanes{} + direction.y, z = Lanes{} + direction.z;
  Places above{};
  for (std::uint32_t g = 0; g < solid.corner_count; g += kLane) {
    const double* at = solid.lanes + std::size_t{g} * 3;
    above -= load(at) * x + load(at + kLane) * y + load(at + 2 * kLane) * z > height;
  }
  return above[0] + above[1] + above[2] + above[3] > 1;
}

void append_lanes(std::span<const Vec3> corners, std::vector<double>& lanes) {
  for (std::size_t g = 0; g < corners.size(); g += kLane) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t k = g; k < g + kLane; ++k) lanes.push_back(corners[std::min(k, corners.size() - 1)][axis]);
    }
  }
}

void PolytopeSet::add(const ShapeSet& shapes, std::size_t first_new) {
  SCREE_REQUIRE(first_new <= records_.size(), "narrow phase polyhedron: bind() left out primitives");
  const auto primitives = shapes.primitives();
  grow_to(primitives.size(), records_);
  for (std::size_t i = records_.size(); i < primitives.size(); ++i) {
    const Primitive& p = primitives[i];
    if (p.kind == ShapeKind::box) {
      append(box(p.size));
    } else if (p.kind == ShapeKind::convex_hull) {
      append(hull(shapes, p));
    } else if (p.kind == ShapeKind::capsule) {
      append_capsule(p.size.x, p.size.y);
    } else {
      records_.emplace_back();
    }
  }
}

Polytope PolytopeSet::operator[](std::uint32_t primitive) const {
  const Record& r = records_[primitive];
  Polytope view;
  view.lanes = lanes_.data() + r.lane;
  view.corner_count = r.corner_count;
  view.faces = {faces_.data() + r.face, r.face_count};
  view.first_side = {first_side_.data() + r.first_side, r.face_count + 1};
  view.sides = {sides_.data() + r.side, r.side_count};
  view.edges = {edges_.data() + r.edge, r.edge_count};
  view.centre = r.centre;
  view.size = r.size;
  view.radius = r.radius;
  return view;
}

PolytopeSet::Draft PolytopeSet::box(const Vec3& half) {
  Draft draft;
  for (int i = 0; i < 8; ++i) {
    const auto sign = [i](int bit) { return (i >> bit & 1) != 0 ? 1.0 : -1.0; };
    draft.corners.push_back(hadamard({sign(0), sign(1), sign(2)}, half));
  }
  draft.faces = {{{-1, 0, 0}, half.x}, {{1, 0, 0}, half.x},  {{0, -1, 0}, half.y},
                 {{0, 1, 0}, half.y},  {{0, 0, -1}, half.z}, {{0, 0, 1}, half.z}};
  draft.rims = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return draft;
}

PolytopeSet::Draft PolytopeSet::hull(const ShapeSet& shapes, const Primitive& primitive) {
  SCREE_REQUIRE(primitive.face_count > 0 && primitive.triangle_count > 0,
                "a convex hull needs its faces and its triangles");
  Draft draft;
  const auto vertices = shapes.vertices().subspan(primitive.first_vertex, primitive.vertex_count);
  draft.corners.assign(vertices.begin(), vertices.end());
  draft.faces = different_planes(shapes.faces().subspan(primitive.first_face, primitive.face_count));
  std::vector<std::vector<Triangle>> on_plane(draft.faces.size());
  for (Triangle t : shapes.triangles().subspan(primitive.first_triangle, primitive.triangle_count)) {
    for (std::uint32_t& corner : t) corner -= primitive.first_vertex;
    on_plane[plane_of(draft.faces, {draft.corners[t[0]], draft.corners[t[1]], draft.corners[t[2]]})].push_back(t);
  }
  // A plane without triangles of its own lies within rounding of others; it still bounds the solid, but has no rim.
  for (const auto& triangles : on_plane) draft.rims.push_back(rim_of(triangles));
  return draft;
}

void PolytopeSet::begin(std::span<const Vec3> corners) {
  Record r;
  r.lane = static_cast<std::uint32_t>(lanes_.size());
  r.corner_count = static_cast<std::uint32_t>(corners.size());
  r.face = static_cast<std::uint32_t>(faces_.size());
  r.first_side = static_cast<std::uint32_t>(first_side_.size());
  r.side = static_cast<std::uint32_t>(sides_.size());
  r.edge = static_cast<std::uint32_t>(edges_.size());
  for (const Vec3& c : corners) r.centre += c;
  r.centre *= 1.0 / static_cast<double>(corners.size());
  for (const Vec3& c : corners) r.size = std::max(r.size, norm(c - r.centre));
  append_lanes(corners, lanes_);
  records_.push_back(r);
}

void PolytopeSet::append(const Draft& draft) {
  begin(draft.corners);
  Record& r = records_.back();
  std::map<Way, std::uint32_t> edge_of;
  for (std::uint32_t f = 0; f < draft.faces.size(); ++f) {
    faces_.push_back(draft.faces[f]);
    first_side_.push_back(r.side_count);
    const auto& rim = draft.rims[f];
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Way way{rim[k], rim[(k + 1) % rim.size()]};
      const auto opposite = edge_of.find({way.second, way.first});
      std::uint32_t edge = r.edge_count;
      if (opposite != edge_of.end()) {
        edge = opposite->second;
        edges_[r.edge + edge].right = f;
      } else {
        edges_.push_back({way.first, way.second, f, kNoFace});
        edge_of[way] = r.edge_count++;
      }
      sides_.push_back({way.first, edge});
      ++r.side_count;
    }
  }
  first_side_.push_back(r.side_count);
  r.face_count = static_cast<std::uint32_t>(draft.faces.size());
}

void PolytopeSet::append_capsule(double radius, double half_length) {
  const std::array<Vec3, 2> ends{Vec3{0, 0, -half_length}, Vec3{0, 0, half_length}};
  begin(ends);
  first_side_.push_back(0);
  edges_.push_back({0, 1, kNoFace, kNoFace});
  records_.back().edge_count = 1;
  records_.back().radius = radius;
}

}  // namespace scree::polyhedron
