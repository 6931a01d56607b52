// Whether two triangles of a surface pass through each other, and by how much.
//
// Glossary
//   t        tolerance [m]: what lies within t of a plane counts as lying in it
//   d_k      signed distance of corner k of one triangle to the plane of the other [m], zero when within t
//   L        the line in which the two planes meet
//
// Method: Moeller, "A fast triangle-triangle intersection test" (1997): each triangle must have corners on both sides of
// the other's plane; both then cut L in a segment, and the triangles cross when these overlap by more than t. Touching
// (a corner or an edge on a face, a common edge) is no crossing. In one plane: separating axes, in two dimensions.
#pragma once

#include <array>
#include <optional>

#include "scree/math/vec3.hpp"

namespace scree {

/// The corners of a triangle [m].
using TriangleCorners = std::array<Vec3, 3>;

/// A point [m] where the two triangles pass through each other, or lie in one plane with the same normal and a common area;
/// none when they are apart or touch. Triangles without an area cross nothing. @param tolerance [m], positive
[[nodiscard]] std::optional<Vec3> crossing_of(const TriangleCorners& a, const TriangleCorners& b, double tolerance);

/// Whether the neighbours a and b fold back onto each other: they share the edge from a[0] to a[1], lie in one plane, and
/// their third corners are on the same side of that edge. @param third the corner of b off the edge
[[nodiscard]] bool is_folded(const TriangleCorners& a, const Vec3& third, double tolerance);

/// Whether an edge that lies in the plane of `face` runs through its inside for more than the tolerance, and the corners
/// `left` and `right` beside the edge are on opposite sides of the plane: a surface that passes through a face exactly
/// along one of its own edges.
[[nodiscard]] std::optional<Vec3> edge_crossing_of(const TriangleCorners& face, const std::array<Vec3, 2>& edge,
                                                   const Vec3& left, const Vec3& right, double tolerance);

}  // namespace scree
