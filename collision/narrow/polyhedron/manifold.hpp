// Contact points of two polytopes that meet along a known direction: the incident face clipped by the sides of the reference
// face (Sutherland and Hodgman 1974), the ends of two parallel edges, or one point.
#pragma once

#include <cstdint>
#include <vector>

#include "placed_pair.hpp"

namespace scree::polyhedron {

/// How two solids meet: along which direction, how far, and where, without their sweeps, in the frame of a.
struct Meeting {
  Vec3 normal;       ///< unit, from a to b [1]
  double gap = 0.0;  ///< distance of the polytopes; negative where they overlap [m]
  Vec3 on_a, on_b;   ///< where [m]; used where no corner or edge says it better
};

/// One contact point.
struct ManifoldPoint {
  Vec3 at;                    ///< midway between the two swept surfaces [m], frame of a
  double gap = 0.0;           ///< of the swept surfaces [m]
  std::uint32_t feature = 0;  ///< corner or edges; independent of which face is the reference
};

inline constexpr std::uint32_t kNoCorner = 0xffffffff;

/// A corner of the clipped polygon between two edges. Edges are numbered twice their index, plus one for edges of b.
struct ClipCorner {
  Vec3 at;  ///< [m], frame of a
  std::uint32_t edge_in = 0, edge_out = 0;
  std::uint32_t corner = kNoCorner;  ///< of the incident solid; kNoCorner where it was cut
};

/// Contact points of one direction.
struct Manifold {
  Vec3 normal;           ///< from a to b, unit [1], frame of a
  bool of_face = false;  ///< the normal is that of a face
  std::vector<ManifoldPoint> points;
  std::vector<ClipCorner> polygon, clipped;  ///< workspace
};

/// Fills `out` with the points whose gap is below `reach` [m]. A face that explains the meeting replaces its normal: ties go to
/// faces, which keeps stacks quiet. The least gap is that of the meeting.
void make_manifold(const PlacedPair& pair, const Meeting& meeting, double reach, Manifold& out);

/// The same with face `face` of a as the reference, and nothing beside that face.
void make_face_manifold(const PlacedPair& pair, std::uint32_t face, double reach, Manifold& out);

/// The same along the meeting's own normal: the ends of two parallel edges, or one point.
void make_edge_manifold(const PlacedPair& pair, const Meeting& meeting, double reach, Manifold& out);

/// Keeps the deepest point and the extreme ones in seven directions across `normal`: what holds up a solid.
void keep_support(const Vec3& normal, std::vector<ManifoldPoint>& points);

}  // namespace scree::polyhedron
