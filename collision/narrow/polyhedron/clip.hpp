// The incident face, clipped by the sides of the reference face.
#pragma once

#include "manifold.hpp"

namespace scree::polyhedron {

/// Two faces that look at each other.
struct FacePair {
  bool of_a = true;             ///< the reference face belongs to a
  std::uint32_t reference = 0;  ///< face
  std::uint32_t incident = 0;   ///< face of the other solid; kNoFace for a segment
};

/// Leaves in out.polygon what of the incident face lies over the reference face, in the frame of a. Corners that are outside
/// by less than `slack` [m] stay where they are.
void clip(const PlacedPair& pair, const FacePair& faces, double slack, Manifold& out);

/// The name of a corner of the clipped polygon: that of a corner of a solid, or of a pair of edges.
[[nodiscard]] std::uint32_t feature_of(const PlacedPair& pair, const ClipCorner& corner);
/// The name of corner i of a (`of_b` 0) or b (1).
[[nodiscard]] std::uint32_t feature_of_corner(std::uint32_t of_b, std::uint32_t i);
/// The name of end 0 or 1 of what two parallel edges share.
[[nodiscard]] std::uint32_t feature_of_edges(std::uint32_t edge_a, std::uint32_t edge_b, std::uint32_t end);
/// The name of a point that lies on no corner or edge in particular.
inline constexpr std::uint32_t kNoFeature = 0xffffffff;

}  // namespace scree::polyhedron
