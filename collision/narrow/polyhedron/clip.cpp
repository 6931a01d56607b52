#include "clip.hpp"

#include <algorithm>
#include <utility>

namespace scree::polyhedron {
namespace {

/// Kinds of feature, in its two highest bits.
enum class FeatureKind : std::uint32_t { corner_of_a, corner_of_b, edge_pair, other };

std::uint32_t named(FeatureKind kind, std::uint32_t first, std::uint32_t second) {
  constexpr std::uint32_t kMost = 0x7fff;
  return static_cast<std::uint32_t>(kind) << 30 | (first & kMost) << 15 | (second & kMost);
}

/// Cuts a ring of corners at a plane: dot(inwards, x) >= offset stays. `edge` names the plane.
void cut(const Vec3& inwards, double offset, double slack, std::uint32_t edge, std::vector<ClipCorner>& polygon,
         std::vector<ClipCorner>& kept) {
  kept.clear();
  const auto height = [&](const ClipCorner& c) { return dot(inwards, c.at) - offset; };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ClipCorner& here = polygon[k];
    const ClipCorner& next = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double h0 = height(here), h1 = height(next);
    const bool in0 = h0 >= -slack, in1 = h1 >= -slack;
    if (in0) kept.push_back(here);
    if (in0 == in1) continue;
    // Within the slack both may lie on one side of the plane.
    const Vec3 at = here.at + std::clamp(h0 / (h0 - h1), 0.0, 1.0) * (next.at - here.at);
    kept.push_back(in0 ? ClipCorner{at, here.edge_out, edge} : ClipCorner{at, edge, here.edge_out});
  }
  polygon.swap(kept);
}

}  // namespace

void clip(const PlacedPair& pair, const FacePair& faces, double slack, Manifold& out) {
  const Polytope& reference = faces.of_a ? pair.a : pair.b;
  const Polytope& incident = faces.of_a ? pair.b : pair.a;
  const std::uint32_t of_b = faces.of_a ? 1 : 0;
  out.polygon.clear();
  const auto place = [&](std::uint32_t corner) { return faces.of_a ? pair.corner_b(corner) : pair.a.corner(corner); };
  if (faces.incident == kNoFace) {
    // A segment is a ring of two corners.
    out.polygon.push_back({place(0), of_b, of_b, 0});
    out.polygon.push_back({place(1), of_b, of_b, 1});
  } else {
    const auto sides = incident.sides_of(faces.incident);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const Side& before = sides[k > 0 ? k - 1 : sides.size() - 1];
      out.polygon.push_back(
          {place(sides[k].corner), before.edge * 2 + of_b, sides[k].edge * 2 + of_b, sides[k].corner});
    }
  }
  const auto sides = reference.sides_of(faces.reference);
  const Vec3& normal = reference.faces[faces.reference].normal;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Vec3 from = reference.corner(sides[k].corner);
    const Vec3 to = reference.corner(sides[k + 1 < sides.size() ? k + 1 : 0].corner);
    Vec3 inwards = normalized(cross(normal, to - from));
    double offset = dot(inwards, from);
    if (!faces.of_a) {
      inwards = pair.turn * inwards;
      offset += dot(inwards, pair.shift);
    }
    cut(inwards, offset, slack, sides[k].edge * 2 + 1 - of_b, out.polygon, out.clipped);
  }
}

std::uint32_t feature_of_corner(std::uint32_t of_b, std::uint32_t i) {
  return named(of_b != 0 ? FeatureKind::corner_of_b : FeatureKind::corner_of_a, i, 0);
}

std::uint32_t feature_of_edges(std::uint32_t edge_a, std::uint32_t edge_b, std::uint32_t end) {
  return named(FeatureKind::other, edge_a * 2 + end, edge_b);
}

std::uint32_t feature_of(const PlacedPair& pair, const ClipCorner& corner) {
  const auto [low, high] = std::minmax(corner.edge_in, corner.edge_out);
  if (corner.corner != kNoCorner) return feature_of_corner(low % 2, corner.corner);
  if (low % 2 != high % 2) {
    const bool low_of_b = low % 2 != 0;
    return named(FeatureKind::edge_pair, (low_of_b ? high : low) / 2, (low_of_b ? low : high) / 2);
  }
  // Two sides of the reference face meet in one of its corners.
  const auto& edges = low % 2 != 0 ? pair.b.edges : pair.a.edges;
  const Edge &one = edges[low / 2], &two = edges[high / 2];
  if (one.from == two.from || one.from == two.to) return feature_of_corner(low % 2, one.from);
  if (one.to == two.from || one.to == two.to) return feature_of_corner(low % 2, one.to);
  return named(FeatureKind::other, low, high);
}

}  // namespace scree::polyhedron
