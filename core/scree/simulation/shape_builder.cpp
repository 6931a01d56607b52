#include "scree/simulation/shape_builder.hpp"

#include <algorithm>
#include <cmath>

#include "scree/simulation/built_part.hpp"

namespace scree {
namespace {

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

/// Primitives that are given by a few lengths.
BuiltPart build_simple(const Options& options) {
  const ShapeKind kind = kind_of(options.type());
  BuiltPart part;
  if (kind == ShapeKind::box) {
    part.data.primitive.size = 0.5 * options.vector("size");
    part.mass = box_mass_properties(part.data.primitive.size);
  } else if (kind == ShapeKind::ellipsoid) {
    part.data.primitive.size = options.vector("semi_axes");
    part.mass = ellipsoid_mass_properties(part.data.primitive.size);
  } else if (kind == ShapeKind::plane) {
    part.has_volume = false;
    part.why_not = "a plane has no mass";
  } else {
    part = build_round(options);
  }
  part.data.primitive.kind = kind;
  return part;
}

BuiltPart build_unplaced(const Options& options, const PartContext& context) {
  const std::string& type = options.type();
  if (type == "sphere_cluster") return build_cluster(options);
  if (type == "convex_hull") return build_hull(options, context);
  if (type == "triangle_mesh") return build_mesh(options, context);
  if (type == "heightfield") return build_heightfield(options, context);
  return build_simple(options);
}

BuiltPart build_part(const Options& options, const PartContext& context) {
  BuiltPart part = build_unplaced(options, context);
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

ShapeData build_shape(const std::string& name, const Options& options, ShapeFrame frame, ShapeRemarks& remarks) {
  const PartContext context{name, frame, remarks};
  std::vector<BuiltPart> parts;
  if (options.type() == "compound") {
    for (const Options& part : options.tables("parts")) parts.push_back(build_part(part, context));
    if (parts.empty()) throw options.error("parts", "must hold at least one part");
  } else {
    parts.push_back(build_part(options, context));
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
