#include "particle_template.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/shaving.hpp"
#include "scree/geometry/sphere_decomposition.hpp"
#include "scree/model/random.hpp"

namespace scree {
namespace {

/// Random hulls tried for a variant before the shape is refused.
constexpr int kTries = 20;

/// The fewest spheres that come well within the limits, else as many as the scene allows.
template <class Decompose>
ParticleTemplate fit_cluster(const Options& shape, const MassProperties& solid, const Decompose& decompose) {
  SphereDecompositionOptions wanted{static_cast<int>(shape.integer("max_spheres")), kEnoughHausdorff};
  SphereDecomposition cluster = decompose(wanted);
  if (std::abs(cluster.volume_error) > kVolumeLimit) {
    wanted.enough_hausdorff = 0.0;
    cluster = decompose(wanted);
  }
  ParticleTemplate unit = normalised(std::move(cluster.spheres), solid);
  unit.volume_error = cluster.volume_error;
  unit.hausdorff = cluster.hausdorff_of_equivalent;
  return unit;
}

ParticleTemplate fit_hull(const Options& shape, const std::vector<Vec3>& points) {
  const ConvexHull hull = convex_hull(points);
  return fit_cluster(shape, mesh_mass_properties(surface_of(hull)),
                     [&](const SphereDecompositionOptions& wanted) { return decompose_hull(hull, wanted); });
}

bool is_good(const ParticleTemplate& unit) {
  return std::abs(unit.volume_error) <= kVolumeLimit && unit.hausdorff <= kHausdorffLimit;
}

/// Corners on an ellipsoid with these half axes, so that the hull has the wanted proportions.
std::vector<Vec3> random_corners(const Vec3& half_axes, std::int64_t count, RandomStream& random) {
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < count; ++i) {
    points.push_back(hadamard(rotate(random.orientation(), {0, 0, 1}), half_axes));
  }
  return points;
}

std::vector<Vec3> written_points(const Options& shape) {
  const std::vector<double>& flat = shape.numbers("points");
  if (flat.size() % 3 != 0)
    throw shape.error("points", "needs three numbers a point, but has " + std::to_string(flat.size()));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < flat.size(); i += 3) points.push_back({flat[i], flat[i + 1], flat[i + 2]});
  return points;
}

/// Random hulls, each drawn again until its cluster is good; after `kTries` the last one goes on to be refused.
TemplateSet make_hulls(const Options& shape) {
  if (shape.has("points")) return {{fit_hull(shape, written_points(shape))}};
  TemplateSet set;
  RandomStream random{static_cast<std::uint64_t>(shape.integer("hull_seed")), "random hulls"};
  for (std::int64_t i = 0; i < shape.integer("variants"); ++i) {
    for (int attempt = 1;; ++attempt) {
      ParticleTemplate hull =
          fit_hull(shape, random_corners(shape.vector("proportions"), shape.integer("corners"), random));
      if (is_good(hull) || attempt == kTries) {
        set.templates.push_back(std::move(hull));
        break;
      }
      ++set.redrawn;
    }
    if (!is_good(set.templates.back())) break;
  }
  return set;
}

ParticleTemplate make_shaving(const Options& shape) {
  const std::vector<Sphere> spheres =
      shaving_spheres({shape.number("aspect"), 1.0, shape.number("bend"), shape.number("twist"),
                       static_cast<int>(shape.integer("spheres"))});
  return normalised(spheres, cluster_mass_properties(spheres));
}

ParticleTemplate make_sphere() { return {{{{}, 0.5}}, sphere_mass_properties(0.5).inertia, 0.5, 0.0, 0.0, {}}; }

void check_errors(const ParticleTemplate& unit, const Options& shape, const std::string& family) {
  if (is_good(unit)) return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "family '%s': %zu spheres come within %.1f %% of the volume and %.1f %% of the size of this %s, but %g %% "
      "and %g %% are needed; make it less thin or angular, or allow more max_spheres (up to 32)",
      family.c_str(), unit.spheres.size(), 100 * std::abs(unit.volume_error), 100 * unit.hausdorff,
      shape.type().c_str(), 100 * kVolumeLimit, 100 * kHausdorffLimit);
  throw shape.error(text);
}

}  // namespace

ParticleTemplate normalised(std::vector<Sphere> spheres, const MassProperties& solid) {
  const double scale = 1.0 / equivalent_diameter(solid.volume);
  const Pose principal{solid.centre, solid.orientation};
  ParticleTemplate unit;
  unit.bounding_radius = 0.0;
  for (Sphere& sphere : spheres) {
    sphere = {scale * transform_back(principal, sphere.centre), scale * sphere.radius};
    unit.bounding_radius = std::max(unit.bounding_radius, norm(sphere.centre) + sphere.radius);
  }
  unit.spheres = std::move(spheres);
  unit.unit_inertia = std::pow(scale, 5) * solid.inertia;
  return unit;
}

std::vector<Variant> particle_shapes() {
  const Parameter proportions = Parameter::vector("proportions", "1", "edge lengths or axes relative to each other")
                                    .above(0.0)
                                    .by_default(Vec3{1, 1, 1});
  const Parameter max_spheres = Parameter::integer("max_spheres", "most spheres that collision may see of a particle")
                                    .at_least(1)
                                    .at_most(32)
                                    .by_default(32);
  return {
      {"sphere", "A ball.", {}},
      {"box", "A cuboid.", {proportions, max_spheres}},
      {"cylinder",
       "A round bar or disc.",
       {Parameter::number("aspect", "1", "length over diameter").above(0.0).by_default(1.0), max_spheres}},
      {"hull",
       "The convex hull of given points, or of random points on an ellipsoid.",
       {Parameter::numbers("points", "1", "x, y, z of each corner, in any unit").optional(), proportions,
        Parameter::integer("corners", "corners of a random hull").at_least(4).at_most(64).by_default(12),
        Parameter::integer("variants", "how many different random hulls there are")
            .at_least(1)
            .at_most(256)
            .by_default(8),
        Parameter::integer("hull_seed", "of the random hulls").at_least(0).by_default(1), max_spheres}},
      {"shaving",
       "A bent, twisted row of spheres.",
       {Parameter::number("aspect", "1", "length over diameter of the row").at_least(1.0).by_default(4.0),
        Parameter::number("bend", "rad", "angle between its ends").at_least(0.0).by_default(std::numbers::pi / 3),
        Parameter::number("twist", "rad", "angle by which the bend turns along it").by_default(std::numbers::pi / 6),
        Parameter::integer("spheres", "number of spheres; 0: one every half diameter")
            .at_least(0)
            .at_most(32)
            .by_default(0)}}};
}

TemplateSet make_templates(const Options& shape, const std::string& family) {
  TemplateSet set;
  try {
    const std::string& type = shape.type();
    if (type == "sphere") set.templates = {make_sphere()};
    if (type == "box") {
      const Vec3 half = 0.5 * shape.vector("proportions");
      set.templates = {fit_cluster(shape, box_mass_properties(half), [&](const SphereDecompositionOptions& wanted) {
        return decompose_box(half, wanted);
      })};
    }
    if (type == "cylinder") {
      const double half = 0.5 * shape.number("aspect");
      set.templates = {
          fit_cluster(shape, cylinder_mass_properties(0.5, half),
                      [&](const SphereDecompositionOptions& wanted) { return decompose_cylinder(0.5, half, wanted); })};
    }
    if (type == "hull") set = make_hulls(shape);
    if (type == "shaving") set.templates = {make_shaving(shape)};
  } catch (const Error& problem) {
    throw shape.error("family '" + family + "': " + problem.what());
  }
  for (const ParticleTemplate& unit : set.templates) check_errors(unit, shape, family);
  return set;
}

ShapeData scaled_shape(const ParticleTemplate& unit, double size) {
  ShapeData shape;
  PrimitiveData part;
  if (unit.spheres.size() == 1 && unit.spheres[0].centre == Vec3{}) {
    part.primitive.kind = ShapeKind::sphere;
    part.primitive.size = {size * unit.spheres[0].radius, 0, 0};
  } else {
    part.primitive.kind = ShapeKind::sphere_cluster;
    part.spheres.reserve(unit.spheres.size());
    for (const Sphere& sphere : unit.spheres) part.spheres.push_back({size * sphere.centre, size * sphere.radius});
  }
  shape.primitives.push_back(std::move(part));
  shape.volume = std::numbers::pi / 6.0 * size * size * size;
  shape.unit_inertia = std::pow(size, 5) * unit.unit_inertia;
  return shape;
}

}  // namespace scree
