// Silhouettes: what the primitives of a body look like from far away.
#pragma once

#include <vector>

#include "projection.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// A disc (radius > 0), or a polygon.
struct Silhouette {
  Point2 centre;                ///< [m]
  double radius = 0.0;          ///< of a disc [m]
  std::vector<Point2> outline;  ///< corners of a polygon, counter-clockwise [m]
  double depth = 0.0;           ///< of the centre, grows towards the viewer [m]
  bool collides = true;
  bool hollow = false;  ///< a cylinder seen along its axis whose inside is free
  Vec3 place = {};      ///< of the centre [m], world
};

/// The corners of the smallest convex polygon around points, counter-clockwise (Andrew's monotone chain, 1979).
[[nodiscard]] std::vector<Point2> convex_outline(std::vector<Point2> points);

/// Appends the silhouettes of a shape at the pose of its body: a disc for each sphere, a polygon for each other convex
/// primitive (round ones by corners on their outline), and a triangle for each of a mesh. Planes have none.
void append_silhouettes(const ShapeSet& shapes, const Shape& shape, const Pose& body, const Projection& projection,
                        std::vector<Silhouette>& out);

/// Grows a window to hold a silhouette.
void include(const Silhouette& silhouette, Window& window);

/// Whether a silhouette holds a point.
[[nodiscard]] bool covers(const Silhouette& silhouette, Point2 point);

}  // namespace scree
