#include "bed.hpp"

#include <cstdio>
#include <numbers>
#include <unordered_map>

#include "scree/geometry/mass_properties.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

ShapeData sphere_shape(double radius) {
  const MassProperties ball = sphere_mass_properties(radius);
  ShapeData shape;
  PrimitiveData part;
  part.primitive.kind = ShapeKind::sphere;
  part.primitive.size = {radius, 0, 0};
  shape.primitives.push_back(std::move(part));
  shape.volume = ball.volume;
  shape.unit_inertia = ball.inertia;
  return shape;
}

/// A fixed half space with its surface through `point` [m] and an outward normal that is the z axis turned by `turn`.
NewBody wall(std::uint32_t shape, std::uint32_t material, const Vec3& point, const Quat& turn) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  NewBody body;
  body.motion = Motion::fixed;
  body.shape = shape;
  body.material = material;
  body.pose = {point, turn};
  body.mass = kInfinite;
  body.inertia = {kInfinite, kInfinite, kInfinite};
  return body;
}

}  // namespace

std::vector<Parameter> BedSource::parameters() {
  return {
      Parameter::path("file", "table of spheres: their number and the side of the box, then x y z r vx vy vz a line"),
      Parameter::text("material", "name of the material of all spheres"),
      Parameter::text("walls",
                      "material of a floor at z = 0 and four walls around the box of the file; none if left out")
          .optional(),
      Parameter::integer("limit", "take the first so many spheres only").at_least(1).optional(),
      Parameter::vector("offset", "m", "added to every position").by_default(Vec3{})};
}

void BedSource::setup(SceneServices& services) {
  material_ = services.material(options_.text("material"));
  if (options_.has("walls")) wall_material_ = services.material(options_.text("walls"));
  density_ = services.materials()[material_].density;
  shapes_ = &services.shapes();
  const auto limit = options_.has("limit") ? static_cast<std::size_t>(options_.integer("limit"))
                                           : std::numeric_limits<std::size_t>::max();
  try {
    bed_ = read_bed(options_.path("file"), limit);
  } catch (const Error& problem) {
    // A bad row has a place of its own, in the bed file.
    if (problem.kind() != ErrorKind::io) throw;
    throw Error{problem.kind(), options_.location("file"), problem.what()};
  }
  double mass = 0.0, least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const BedSphere& sphere : bed_.spheres) {
    mass += density_ * sphere_mass_properties(sphere.radius).volume;
    least = std::min(least, sphere.radius);
    largest = std::max(largest, sphere.radius);
  }
  char text[200];
  std::snprintf(text, sizeof text, "%zu spheres of %.4g to %.4g mm radius, %.6g kg, in a box of side %.6g m",
                bed_.spheres.size(), 1e3 * least, 1e3 * largest, mass, bed_.side);
  services.log(text);
}

void BedSource::emit(const BodyView&, double, double, std::vector<NewBody>& out) {
  if (done_) return;
  done_ = true;
  const Vec3 offset = options_.vector("offset");
  out.reserve(out.size() + bed_.spheres.size() + 5);
  if (wall_material_) add_walls(offset, out);
  std::unordered_map<double, std::uint32_t> shape_of;  // by radius
  for (const BedSphere& sphere : bed_.spheres) {
    const auto [shape, is_new] = shape_of.try_emplace(sphere.radius, 0);
    if (is_new) shape->second = shapes_->add(sphere_shape(sphere.radius));
    const MassProperties ball = sphere_mass_properties(sphere.radius);
    NewBody body;
    body.shape = shape->second;
    body.material = material_;
    body.pose.position = sphere.centre + offset;
    body.velocity = sphere.velocity;
    body.mass = density_ * ball.volume;
    body.inertia = density_ * ball.inertia;
    body.radius = sphere.radius;
    out.push_back(std::move(body));
  }
  bed_ = {};
}

void BedSource::add_walls(const Vec3& offset, std::vector<NewBody>& out) {
  ShapeData plane;
  PrimitiveData part;
  part.primitive.kind = ShapeKind::plane;
  plane.primitives.push_back(part);
  const std::uint32_t shape = shapes_->add(plane);
  const double half = 0.5 * bed_.side, quarter_turn = std::numbers::pi / 2;
  const auto add = [&](const Vec3& point, const Vec3& turn) {
    out.push_back(wall(shape, *wall_material_, point + offset, from_rotation_vector(turn)));
  };
  add({}, {});
  add({-half, 0, 0}, {0, quarter_turn, 0});
  add({half, 0, 0}, {0, -quarter_turn, 0});
  add({0, -half, 0}, {-quarter_turn, 0, 0});
  add({0, half, 0}, {quarter_turn, 0, 0});
}

void BedSource::save(StateWriter& out) const { out.write("done", std::uint64_t{done_}); }

void BedSource::load(const StateReader& in) {
  done_ = in.integer("done") != 0;
  if (done_) bed_ = {};
}

}  // namespace scree
