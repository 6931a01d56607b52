// The distance or depth of two solids, for judging narrow phases: found by search over directions, with none of their code.
//
// For a unit vector n from a to b, s(n) = -h_a(n) - h_b(-n) is the gap between the planes that support the two solids
// across n (h: support function). The largest s is the gap when it is positive, and minus the depth when it is not.
#pragma once

#include <vector>

#include "scree/model/shape_set.hpp"

namespace scree::test {

/// A solid of the reference: its support function needs nothing else.
struct ReferenceSolid {
  ShapeKind kind = ShapeKind::sphere;
  Vec3 size;                   ///< as Primitive::size [m]
  Pose pose;                   ///< to the world [m]
  std::vector<Vec3> vertices;  ///< of hulls and meshes, own frame [m]; a mesh counts as the hull of its vertices
  std::vector<Vec3> normals;   ///< of faces, own frame, unit
  std::vector<Vec3> edges;     ///< directions of edges, own frame
};

/// One convex part of a pair.
struct ReferenceGap {
  double gap = 0.0;  ///< [m]
  Vec3 normal;       ///< unit, from a to b
};

/// The solids of a primitive at a pose: one, or the spheres of a cluster.
[[nodiscard]] std::vector<ReferenceSolid> reference_solids(const PrimitiveData& data, const Pose& pose);

/// s(n) [m] of two solids; n is a unit vector. A plane gives minus infinity but along its own normal.
[[nodiscard]] double separation_along(const ReferenceSolid& a, const ReferenceSolid& b, const Vec3& n);

/// The largest s, to 1e-7 of the smaller solid: face normals and crossed edges of polyhedra, and many starts from which
/// golden sections climb.
[[nodiscard]] ReferenceGap reference_gap(const ReferenceSolid& a, const ReferenceSolid& b);

}  // namespace scree::test
