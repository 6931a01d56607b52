// FaceMap: the surface of a shape as triangles in the body frame, and the triangle at a place of it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scree/geometry/triangle_tree.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// How fine faces are.
struct FaceOptions {
  int segments = 64;        ///< of a full circle of round primitives
  double plane_size = 1.0;  ///< edge of the square that stands for a plane [m]
  double largest = 0.0;  ///< faces are divided until no edge is longer [m]; 0: a fortieth of the surface's extent for
                         ///< simple primitives, while meshes and hulls keep their faces
};

/// A map divides into no more faces than that; each takes some 250 bytes.
inline constexpr std::size_t kMostFaces = 1'000'000;

/// Faces of all primitives that collide, one range after the other.
class FaceMap {
 public:
  /// @throws TooManyFaces before they are made.
  FaceMap(const ShapeSet& shapes, const Shape& shape, const FaceOptions& options);

  [[nodiscard]] std::size_t size() const { return area_.size(); }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }  ///< [m], body frame
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<double>& areas() const { return area_; }  ///< [m2]
  [[nodiscard]] std::uint32_t primitive(std::size_t face) const { return primitive_[face]; }

  /// The face of `primitive` that is nearest to `point` [m], body frame.
  [[nodiscard]] std::size_t nearest(std::uint32_t primitive, const Vec3& point) const;

 private:
  /// The faces of one primitive as a mesh of its own, with a tree.
  struct Part {
    TriangleMesh mesh;
    std::unique_ptr<TriangleTree> tree;  // null for a primitive without faces
    std::size_t first = 0;               // face
  };

  void append(const Part& part, std::uint32_t primitive);

  std::vector<Part> parts_;  // by primitive
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<double> area_;
  std::vector<std::uint32_t> primitive_;
};

/// Thrown in place of dividing into more than kMostFaces.
struct TooManyFaces {
  double count = 0.0;        ///< that they would be, about [1]
  double proposed = 0.0;     ///< a `largest` that is possible [m]; 0: they are too many undivided
  std::size_t possible = 0;  ///< faces with that
};

/// The triangles that divided() would make, at most `most` + 1.
[[nodiscard]] std::size_t count_divided(const TriangleMesh& mesh, double largest, std::size_t most);

/// The mesh with every triangle halved across its longest edge until none is longer than `largest` [m]. Total area stays.
[[nodiscard]] TriangleMesh divided(const TriangleMesh& mesh, double largest);

}  // namespace scree
