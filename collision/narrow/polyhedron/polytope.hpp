// Polytope: a convex solid as separating axes and clipping want it: corners, faces with their rims, edges with their faces.
//
// Boxes and hulls are polytopes; a capsule is one of two corners, swept by a sphere; a triangle of a mesh is one with two
// faces back to back. The swept sphere (`radius`) is left out of all distances until contacts are written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/geometry/face.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::polyhedron {

inline constexpr std::uint32_t kNoFace = 0xffffffff;
/// Corners are stored by fours: four x, four y, four z; the last four is filled up with its last corner.
inline constexpr std::uint32_t kLane = 4;

/// An edge and the two faces that it bounds; kNoFace for the edge of a segment.
struct Edge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t left = kNoFace, right = kNoFace;
};

/// One side of a face: the corner that it starts from, counter-clockwise seen from outside, and its edge.
struct Side {
  std::uint32_t corner = 0, edge = 0;
};

/// A polytope in its own frame; points into a PolytopeSet or another owner.
struct Polytope {
  const double* lanes = nullptr;  ///< corners by fours [m]
  std::uint32_t corner_count = 0;
  std::span<const Face> faces;
  std::span<const std::uint32_t> first_side;  ///< of each face, one more at the end
  std::span<const Side> sides;
  std::span<const Edge> edges;
  Vec3 centre;          ///< mean of the corners [m]
  double size = 0.0;    ///< farthest corner from the centre [m]
  double radius = 0.0;  ///< of the sphere that sweeps it [m]

  [[nodiscard]] Vec3 corner(std::uint32_t i) const {
    const double* at = lanes + std::size_t{i / kLane} * 3 * kLane + i % kLane;
    return {at[0], at[kLane], at[2 * kLane]};
  }
  [[nodiscard]] std::span<const Side> sides_of(std::uint32_t face) const {
    return sides.subspan(first_side[face], first_side[face + 1] - first_side[face]);
  }
};

/// Fetches faces, sides and edges into the cache, up to a kilobyte of each.
void fetch_faces(const Polytope& solid);

/// The first corner that is farthest along `direction`.
[[nodiscard]] std::uint32_t farthest(const Polytope& solid, const Vec3& direction);

/// True when more than one corner may rise above `height` [m] along `direction`; never false when it is so.
[[nodiscard]] bool several_above(const Polytope& solid, const Vec3& direction, double height);

/// Appends corners [m] in the layout of Polytope::lanes.
void append_lanes(std::span<const Vec3> corners, std::vector<double>& lanes);

/// The polytopes of all boxes, hulls and capsules of a ShapeSet.
class PolytopeSet {
 public:
  /// Adds the primitives from `first_new` on.
  void add(const ShapeSet& shapes, std::size_t first_new);
  /// The polytope of a primitive of one of these kinds. Ends with the next add().
  [[nodiscard]] Polytope operator[](std::uint32_t primitive) const;
  /// Fetches the corners of a primitive into the cache.
  void fetch(std::uint32_t primitive) const {
    const Record& r = records_[primitive];
    const double* const at = lanes_.data() + r.lane;
    const std::uint32_t doubles = std::min(3 * r.corner_count, kMostFetched);
    for (std::uint32_t i = 0; i < doubles; i += kCacheLine) __builtin_prefetch(at + i);
  }

 private:
  static constexpr std::uint32_t kCacheLine = 8;     // doubles
  static constexpr std::uint32_t kMostFetched = 64;  // doubles
  struct Record {
    std::uint32_t lane = 0, corner_count = 0;
    std::uint32_t face = 0, face_count = 0, first_side = 0;
    std::uint32_t side = 0, side_count = 0;
    std::uint32_t edge = 0, edge_count = 0;
    Vec3 centre;
    double size = 0.0, radius = 0.0;
  };
  /// A solid while it is being made: the rim of each face as corners.
  struct Draft {
    std::vector<Vec3> corners;
    std::vector<Face> faces;
    std::vector<std::vector<std::uint32_t>> rims;
  };
  static Draft box(const Vec3& half);
  static Draft hull(const ShapeSet& shapes, const Primitive& primitive);
  void append(const Draft& draft);
  void append_capsule(double radius, double half_length);
  void begin(std::span<const Vec3> corners);

  std::vector<Record> records_;  // by primitive
  std::vector<double> lanes_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> first_side_;
  std::vector<Side> sides_;
  std::vector<Edge> edges_;
};

}  // namespace scree::polyhedron
