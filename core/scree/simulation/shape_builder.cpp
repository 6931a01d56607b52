#include "scree/simulation/shape_builder.hpp"

#include <algorithm>
#include <cmath>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/mesh_file.hpp"

namespace scree {
namespace {

/// A primitive with the mass properties of its solid, in the frame of the shape.
struct BuiltPart {
  PrimitiveData data;
  MassProperties mass;
  bool has_volume = true;
  std::string why_not;  ///< why it has no volume
};

std::vector<Vec3> to_points(const Options& options, const char* key) {
  const std::vector<double>& flat = options.numbers(key);
  if (flat.empty() || flat.size() % 3 != 0) {
    throw options.error(key, "needs three numbers a point, but has " + std::to_string(flat.size()) +
                                 "; write x, y, z of each point, one after the other");
  }
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return points;
}

/// Exactly one of an inline list and a file must be given.
bool from_file(const Options& options, const char* inline_key) {
  if (options.has(inline_key) == options.has("file")) {
    throw options.error(std::string{"a "} + options.type() + " needs either '" + inline_key + "' or 'file'");
  }
  return options.has("file");
}

/// The mesh that 'file' names. @throws Error at the setting when it cannot be read.
TriangleMesh mesh_of(const Options& options) {
  try {
    return read_mesh_file(options.path("file"), options.number("scale"));
  } catch (const Error& problem) {
    throw Error{problem.kind(), options.location("file"), problem.what()};
  }
}

std::vector<Triangle> to_triangles(const Options& options, std::size_t vertices) {
  const std::vector<double>& flat = options.numbers("triangles");
  std::vector<Triangle> triangles(flat.size() / 3);
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    if (flat[i] < 0.0 || flat[i] >= static_cast<double>(vertices) || flat[i] != std::floor(flat[i])) {
      throw options.error("triangles", "names a vertex that does not exist in triangle " + std::to_string(i / 3) +
                                           "; " + "indices run from 0 to " + std::to_string(vertices - 1));
    }
    triangles[i / 3][i % 3] = static_cast<std::uint32_t>(flat[i]);
  }
  return triangles;
}

BuiltPart build_hull(const Options& options) {
  BuiltPart part;
  std::vector<Vec3> points = from_file(options, "points") ? mesh_of(options).vertices : to_points(options, "points");
  try {
    const ConvexHull hull = convex_hull(points);
    part.data.vertices = hull.vertices;
    part.data.faces = hull.faces;
    part.data.triangles = hull.triangles;
    part.mass = mesh_mass_properties(surface_of(hull));
  } catch (const Error& problem) {
    throw options.error(problem.what());
  }
  return part;
}

BuiltPart build_mesh(const Options& options) {
  BuiltPart part;
  TriangleMesh mesh;
  if (from_file(options, "vertices")) {
    mesh = mesh_of(options);
  } else {
    if (!options.has("triangles")) throw options.error("a triangle_mesh with 'vertices' needs 'triangles' as well");
    mesh.vertices = to_points(options, "vertices");
    mesh.triangles = to_triangles(options, mesh.vertices.size());
  }
  const MeshReport report = check_mesh(mesh);
  if (report.inside_out) mesh = turned_inside_out(mesh);
  part.data.vertices = mesh.vertices;
  part.data.triangles = mesh.triangles;
  part.has_volume = check_mesh(mesh).is_solid();
  if (part.has_volume) part.mass = mesh_mass_properties(mesh);
  part.why_not = report.problem();
  return part;
}

BuiltPart build_cluster(const Options& options) {
  BuiltPart part;
  for (const Options& sphere : options.tables("spheres")) {
    part.data.spheres.push_back({sphere.vector("centre"), sphere.number("radius")});
  }
  if (part.data.spheres.empty()) throw options.error("spheres", "must hold at least one sphere");
  part.mass = cluster_mass_properties(part.data.spheres);
  return part;
}

BuiltPart build_round(const Options& options) {
  BuiltPart part;
  Primitive& p = part.data.primitive;
  const std::string& type = options.type();
  const double radius = options.number("radius");
  if (type == "sphere") {
    p.size = {radius, 0, 0};
    part.mass = sphere_mass_properties(radius);
    return part;
  }
  const double half = 0.5 * options.number(type == "cone" ? "height" : "length");
  p.size = {radius, half, 0};
  if (type == "capsule") part.mass = capsule_mass_properties(radius, half);
  if (type == "cone") part.mass = cone_mass_properties(radius, half);
  if (type == "cylinder") {
    part.mass = cylinder_mass_properties(radius, half);
    p.hollow = options.boolean("hollow");
    part.has_volume = !p.hollow;
    part.why_not = "a hollow cylinder has no mass";
  }
  return part;
}

ShapeKind kind_of(const std::string& type) {
  for (std::size_t k = 0; k < kShapeKindCount; ++k) {
    if (type == to_string(static_cast<ShapeKind>(k))) return static_cast<ShapeKind>(k);
  }
  throw std::logic_error{"shape type '" + type + "' has no primitive"};
}

BuiltPart build_unplaced(const Options& options) {
  const ShapeKind kind = kind_of(options.type());
  BuiltPart part;
  switch (kind) {
    case ShapeKind::sphere:
    case ShapeKind::cylinder:
    case ShapeKind::capsule:
    case ShapeKind::cone:
      part = build_round(options);
      break;
    case ShapeKind::box:
      part.data.primitive.size = 0.5 * options.vector("size");
      part.mass = box_mass_properties(part.data.primitive.size);
      break;
    case ShapeKind::ellipsoid:
      part.data.primitive.size = options.vector("semi_axes");
      part.mass = ellipsoid_mass_properties(part.data.primitive.size);
      break;
    case ShapeKind::plane:
      part.has_volume = false;
      part.why_not = "a plane has no mass";
      break;
    case ShapeKind::sphere_cluster:
      part = build_cluster(options);
      break;
    case ShapeKind::convex_hull:
      part = build_hull(options);
      break;
    case ShapeKind::triangle_mesh:
      part = build_mesh(options);
      break;
  }
  part.data.primitive.kind = kind;
  return part;
}

BuiltPart build_part(const Options& options) {
  BuiltPart part = build_unplaced(options);
  Pose pose = pose_of(options);
  if (options.type() == "plane") {
    const Vec3 normal = options.vector("normal");
    if (norm(normal) == 0.0) throw options.error("normal", "cannot be the zero vector");
    pose.orientation = pose.orientation * rotation_between({0, 0, 1}, normalized(normal));
  }
  part.data.primitive.local = pose;
  if (part.has_volume) part.mass = placed(part.mass, pose);
  return part;
}

}  // namespace

Pose pose_of(const Options& options) {
  const Vec3 axis = options.vector("rotation_axis");
  if (norm(axis) == 0.0) throw options.error("rotation_axis", "cannot be the zero vector");
  return {options.vector("position"), from_rotation_vector(options.number("rotation_angle") * normalized(axis))};
}

ShapeData build_shape(const std::string& name, const Options& options, ShapeFrame frame) {
  std::vector<BuiltPart> parts;
  if (options.type() == "compound") {
    for (const Options& part : options.tables("parts")) parts.push_back(build_part(part));
    if (parts.empty()) throw options.error("parts", "must hold at least one part");
  } else {
    parts.push_back(build_part(options));
  }
  ShapeData shape;
  shape.name = name;
  std::vector<MassProperties> masses;
  for (const BuiltPart& part : parts) {
    if (part.has_volume) masses.push_back(part.mass);
    if (!part.has_volume && frame == ShapeFrame::principal) {
      throw options.error("shape '" + name + "' cannot move by forces, because " + part.why_not +
                          "; give the body motion = \"fixed\" or \"kinematic\", or another shape");
    }
  }
  if (!masses.empty()) {
    const MassProperties total = composed(masses);
    shape.volume = total.volume;
    shape.unit_inertia = total.inertia;
    if (frame == ShapeFrame::principal) shape.body_to_shape = {total.centre, total.orientation};
  }
  const Pose shape_to_body = inverse(shape.body_to_shape);
  for (BuiltPart& part : parts) {
    part.data.primitive.local = shape_to_body * part.data.primitive.local;
    shape.primitives.push_back(std::move(part.data));
  }
  return shape;
}

}  // namespace scree
