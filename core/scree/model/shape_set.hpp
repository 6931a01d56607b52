// ShapeSet: the geometry of all bodies, as contiguous records.
//
// A shape is a list of primitives, each with a pose in the body frame. Bodies
// that look alike share a shape. Lengths of vertices, spheres and triangles lie
// in common buffers that primitives point into by index.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scree/geometry/face.hpp"
#include "scree/geometry/sphere.hpp"
#include "scree/math/aabb.hpp"
#include "scree/math/pose.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// Kinds of collision primitive. Axes of revolution are the primitive's z axis.
enum class ShapeKind : std::uint8_t {
  sphere,          ///< size.x: radius
  sphere_cluster,  ///< a rigid union of spheres: items of spheres()
  box,             ///< size: half edges
  cylinder,        ///< size.x: radius, size.y: half length
  capsule,         ///< size.x: radius, size.y: half length of its axis
  cone,            ///< size.x: base radius, size.y: half height; apex at +z, base at -z
  plane,           ///< half space z <= 0 is solid; outward normal +z; unbounded
  convex_hull,     ///< items of vertices(); faces in faces()
  triangle_mesh,   ///< a closed or open surface: items of triangles(), indexing
                   ///< vertices()
  ellipsoid        ///< size: half axes
};
inline constexpr std::size_t kShapeKindCount = 10;

[[nodiscard]] const char* to_string(ShapeKind kind);

/// One primitive of a shape.
struct Primitive {
  ShapeKind kind = ShapeKind::sphere;
  bool hollow = false;   ///< a cylinder whose inside is free: a drum seen from inside
  bool collides = true;  ///< false: no pair is made with it
  Pose local;            ///< primitive to body [m]
  Vec3 size;             ///< by kind, see ShapeKind [m]
  std::uint32_t first_sphere = 0, sphere_count = 0;
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_face = 0, face_count = 0;  ///< of a hull
  std::uint32_t first_triangle = 0,
                triangle_count = 0;  ///< of a mesh or of the surface of a hull
  double bounding_radius = 0.0;      ///< about the primitive's origin [m]; infinite for a plane
};

/// Vertices of a triangle, indices into vertices(), counter-clockwise seen from
/// outside.
using Triangle = std::array<std::uint32_t, 3>;

/// A shape: primitives, and what a body of it weighs per unit of density.
struct Shape {
  std::uint32_t first_primitive = 0, primitive_count = 0;
  double volume = 0.0;             ///< of the solid [m3]
  Vec3 unit_inertia;               ///< principal moments for a density of 1 [m5]
  double bounding_radius = 0.0;    ///< about the centre of mass [m]; infinite with a plane
  double equivalent_radius = 0.0;  ///< of the sphere of equal volume [m]
};

/// A primitive to be put into a shape, with its own data.
struct PrimitiveData {
  Primitive primitive;  ///< kind, hollow, local, size; ranges are filled in by
                        ///< ShapeSet
  std::vector<Sphere> spheres;
  std::vector<Vec3> vertices;  ///< [m], primitive's frame
  std::vector<Face> faces;
  std::vector<Triangle> triangles;  ///< indices into `vertices`
};

/// A shape to be added.
struct ShapeData {
  std::string name;
  std::vector<PrimitiveData> primitives;  ///< their local poses are in the body frame
  double volume = 0.0;                    ///< [m3]
  Vec3 unit_inertia;                      ///< [m5]
  Pose body_to_shape;                     ///< as ShapeSet::body_to_shape() [m]
};

/// All shapes of a simulation. Shapes are only ever added.
class ShapeSet {
 public:
  /// Adds a shape and returns its index. Bounds are computed here.
  std::uint32_t add(const ShapeData& data);

  [[nodiscard]] std::span<const Shape> shapes() const { return shapes_; }
  [[nodiscard]] std::span<const Primitive> primitives() const { return primitives_; }
  [[nodiscard]] std::span<const Primitive> primitives(const Shape& s) const {
    return primitives().subspan(s.first_primitive, s.primitive_count);
  }
  [[nodiscard]] std::span<const Sphere> spheres() const { return spheres_; }
  [[nodiscard]] std::span<const Vec3> vertices() const { return vertices_; }
  [[nodiscard]] std::span<const Face> faces() const { return faces_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  /// The index of a shape by name, or -1.
  [[nodiscard]] std::int64_t find(std::string_view name) const;
  /// Empty for a shape without one.
  [[nodiscard]] std::string_view name(std::uint32_t shape) const;
  /// Where the body frame (centre of mass, principal axes) sits in the shape as written [m].
  [[nodiscard]] Pose body_to_shape(std::uint32_t shape) const;

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  /// What few shapes have: those of a feed, one a particle, go without.
  struct Written {
    std::uint32_t shape = 0;
    std::string name;
    Pose body_to_shape;
  };
  void write_down(std::uint32_t shape, std::string_view name, const Pose& body_to_shape);
  [[nodiscard]] const Written* written(std::uint32_t shape) const;

  std::vector<Shape> shapes_;
  std::vector<Written> written_;  // in order of shape
  std::vector<Primitive> primitives_;
  std::vector<Sphere> spheres_;
  std::vector<Vec3> vertices_;
  std::vector<Face> faces_;
  std::vector<Triangle> triangles_;
};

/// The tight axis-aligned box of a primitive at a pose of its own frame in the
/// world.
[[nodiscard]] Aabb bounds(const ShapeSet& shapes, const Primitive& primitive, const Pose& world);

}  // namespace scree
