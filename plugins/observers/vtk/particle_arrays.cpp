#include "particle_arrays.hpp"

#include <algorithm>

namespace scree {

namespace {

template <class Value>
std::vector<Value> picked(std::span<const Value> column, std::span<const BodyIndex> which) {
  std::vector<Value> values(which.size());
  std::transform(which.begin(), which.end(), values.begin(), [&](BodyIndex i) { return column[i]; });
  return values;
}

std::vector<std::int32_t> picked_indices(std::span<const std::uint32_t> column, std::span<const BodyIndex> which) {
  std::vector<std::int32_t> values(which.size());
  std::transform(which.begin(), which.end(), values.begin(),
                 [&](BodyIndex i) { return static_cast<std::int32_t>(column[i]); });
  return values;
}

std::int32_t type_of(const ShapeSet& shapes, std::uint32_t shape) {
  const auto primitives = shapes.primitives(shapes.shapes()[shape]);
  return static_cast<std::int32_t>(primitives.size() == 1 ? static_cast<std::size_t>(primitives[0].kind)
                                                          : kShapeKindCount);
}

std::vector<std::int32_t> types(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> which) {
  std::vector<std::int32_t> values(which.size());
  std::transform(which.begin(), which.end(), values.begin(),
                 [&](BodyIndex i) { return type_of(shapes, bodies.shape[i]); });
  return values;
}

std::vector<double> charges(const BodyView& bodies, std::span<const BodyIndex> which) {
  const Attributes& attributes = *bodies.attributes;
  if (attributes.has("charge")) return picked(attributes.column(attributes.id("charge")), which);
  std::vector<double> sum(which.size(), 0.0);
  for (AttributeId column = 0; column < attributes.count(); ++column) {
    if (attributes.info(column).unit != "C") continue;
    for (std::size_t k = 0; k < which.size(); ++k) sum[k] += attributes.column(column)[which[k]];
  }
  return sum;
}

}  // namespace

PolyData particle_data(const BodyView& bodies, std::span<const BodyIndex> which, const ShapeSet& shapes,
                       Precision precision) {
  const auto scalars = [&](const char* name, std::span<const double> column) {
    return to_array(name, picked(column, which), precision);
  };
  const auto vectors = [&](const char* name, std::span<const Vec3> column) {
    return to_array(name, std::span<const Vec3>{picked(column, which)}, precision);
  };
  PolyData data;
  data.point_count = which.size();
  data.points = vectors("Points", bodies.position);
  data.point_data = {to_array("id", picked(bodies.id, which)),
                     to_array("type", types(bodies, shapes, which)),
                     to_array("shape", picked_indices(bodies.shape, which)),
                     to_array("material", picked_indices(bodies.material, which)),
                     scalars("radius", bodies.radius),
                     scalars("mass", bodies.mass),
                     to_array("charge", charges(bodies, which), precision),
                     vectors("velocity", bodies.velocity),
                     vectors("angular_velocity", bodies.angular_velocity),
                     to_array("orientation_wxyz", std::span<const Quat>{picked(bodies.orientation, which)}, precision)};
  for (AttributeId column = 0; column < bodies.attributes->count(); ++column) {
    const std::string& name = bodies.attributes->info(column).name;
    if (name != "charge") data.point_data.push_back(scalars(name.c_str(), bodies.attribute(column)));
  }
  return data;
}

PolyData sphere_data(const BodyView& bodies, std::span<const BodyIndex> which, const ShapeSet& shapes,
                     Precision precision) {
  const std::vector<double> charge_of = charges(bodies, which);
  std::vector<Vec3> centre, velocity;
  std::vector<double> radius, charge;
  std::vector<std::uint64_t> id;
  std::vector<std::int32_t> type, material;
  const auto add = [&](std::size_t k, const Pose& frame, const Sphere& sphere) {
    const BodyIndex i = which[k];
    centre.push_back(transform(frame, sphere.centre));
    velocity.push_back(bodies.velocity[i] + cross(bodies.angular_velocity[i], centre.back() - bodies.position[i]));
    radius.push_back(sphere.radius);
    charge.push_back(charge_of[k]);
    id.push_back(bodies.id[i]);
    type.push_back(type_of(shapes, bodies.shape[i]));
    material.push_back(static_cast<std::int32_t>(bodies.material[i]));
  };
  for (std::size_t k = 0; k < which.size(); ++k) {
    const BodyIndex i = which[k];
    for (const Primitive& p : shapes.primitives(shapes.shapes()[bodies.shape[i]])) {
      const Pose frame = Pose{bodies.position[i], bodies.orientation[i]} * p.local;
      if (p.kind == ShapeKind::sphere) add(k, frame, {{}, p.size.x});
      for (const Sphere& s : shapes.spheres().subspan(p.first_sphere, p.sphere_count)) add(k, frame, s);
    }
  }
  PolyData data;
  data.point_count = centre.size();
  data.points = to_array("Points", std::span<const Vec3>{centre}, precision);
  data.point_data = {to_array("id", id),
                     to_array("type", type),
                     to_array("material", material),
                     to_array("radius", radius, precision),
                     to_array("charge", charge, precision),
                     to_array("velocity", std::span<const Vec3>{velocity}, precision)};
  return data;
}

}  // namespace scree
