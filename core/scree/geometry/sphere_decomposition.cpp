#include "scree/geometry/sphere_decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/base/require.hpp"
#include "scree/geometry/decomposition_cache.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/solid_deviation.hpp"
#include "scree/geometry/sphere_fit.hpp"

namespace scree {
namespace {

constexpr int kRounds = 4;
constexpr int kSweeps = 5;  // of moving centres in a round
constexpr int kJumps = 1;   // of idle balls in a round
constexpr int kQuickSamples = 600;

/// Rounds lengths of a unit solid to 2^-40, so that similar solids of any scale become the very same one.
double snapped(double x) { return std::ldexp(std::round(std::ldexp(x, 40)), -40); }
Vec3 snapped(const Vec3& v) { return {snapped(v.x), snapped(v.y), snapped(v.z)}; }

void require_lengths(std::initializer_list<double> lengths, const char* what) {
  for (const double length : lengths) {
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw Error{ErrorKind::usage, std::string{"every length of a "} + what + " must be above zero and finite"};
    }
  }
}

/// Fits so many balls to a solid of size one and measures them.
SphereDecomposition fit_balls(const Solid& unit, int count) {
  SphereFit fit{unit, count};
  fit.choose_greedily(0.03);
  fit.match_volume(0.01);
  // Every round searches more finely; the best round wins, since E and the Hausdorff distance do not fall in step.
  double best = std::numeric_limits<double>::infinity(), step = 0.04;
  std::vector<Sphere> spheres;
  for (int round = 0; round < kRounds; ++round, step *= 0.7) {
    fit.move_centres(kSweeps, step);
    if (round + 1 < kRounds) fit.relocate(kJumps);
    fit.match_volume(1e-3);
    const double distance = measure_distances(unit, fit.spheres(), kQuickSamples).hausdorff();
    if (distance < best) {
      best = distance;
      spheres = fit.spheres();
    }
  }
  const SolidDeviation deviation = measure_deviation(unit, spheres);
  return {std::move(spheres), deviation.volume_error, deviation.hausdorff() / unit.size,
          deviation.hausdorff() / equivalent_diameter(unit.volume)};
}

void check(const SphereDecompositionOptions& options) {
  if (options.max_spheres < 1 || options.max_spheres > 1000) {
    throw Error{ErrorKind::usage,
                "a solid can be decomposed into 1 to 1000 spheres, not " + std::to_string(options.max_spheres)};
  }
}

SphereDecomposition decompose_anew(const Solid& unit, const SphereDecompositionOptions& options) {
  if (options.enough_hausdorff > 0.0) {
    for (int count = 1; count < options.max_spheres; count *= 2) {
      SphereDecomposition few = fit_balls(unit, count);
      if (few.hausdorff_of_equivalent <= options.enough_hausdorff) return few;
    }
  }
  return fit_balls(unit, options.max_spheres);
}

/// The bytes of what an answer depends on.
class Content {
 public:
  explicit Content(std::string kind) : bytes_{std::move(kind)} {}

  Content& add(double x) {
    const double value = x == 0.0 ? 0.0 : x;  // -0 and 0 are one length
    return append(&value, sizeof value);
  }
  Content& add(const Vec3& v) { return add(v.x).add(v.y).add(v.z); }
  Content& add(const TriangleMesh& mesh) {
    add(static_cast<double>(mesh.vertices.size()));
    for (const Vec3& v : mesh.vertices) add(v);
    for (const Triangle& t : mesh.triangles) append(t.data(), sizeof t);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Content& append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  std::string bytes_;
};

/// The balls for a solid of size one, computed or remembered.
SphereDecomposition decompose(const Solid& unit, Content content, const SphereDecompositionOptions& options) {
  check(options);
  content.add(options.max_spheres).add(options.enough_hausdorff);
  return DecompositionCache::of_program().find_or(content.bytes(), [&] { return decompose_anew(unit, options); });
}

/// Moves and scales a mesh to size one about the middle of its box; returns the map back.
struct UnitFrame {
  Vec3 origin;
  double size;
  Vec3 to_unit(const Vec3& p) const { return snapped((p - origin) / size); }
};

SphereDecomposition back(SphereDecomposition d, const UnitFrame& frame) {
  d = scaled(std::move(d), frame.size);
  for (Sphere& s : d.spheres) s.centre += frame.origin;
  return d;
}

}  // namespace

SphereDecomposition decompose_box(const Vec3& h, const SphereDecompositionOptions& options) {
  require_lengths({h.x, h.y, h.z}, "box");
  const double size = 2.0 * norm(h);
  const Vec3 unit = snapped(h / size);
  return scaled(decompose(box_solid(unit), Content{"box"}.add(unit), options), size);
}

SphereDecomposition decompose_cylinder(double radius, double half_length, const SphereDecompositionOptions& options) {
  require_lengths({radius, half_length}, "cylinder");
  const double size = 2.0 * std::hypot(radius, half_length);
  const double unit_radius = snapped(radius / size), unit_half = snapped(half_length / size);
  const Content content = Content{"cylinder"}.add(unit_radius).add(unit_half);
  return scaled(decompose(cylinder_solid(unit_radius, unit_half), content, options), size);
}

SphereDecomposition decompose_hull(const ConvexHull& hull, const SphereDecompositionOptions& options) {
  const Aabb box = bounds_of(hull.vertices);
  const UnitFrame frame{0.5 * (box.lower + box.upper), hull_solid(hull).size};
  ConvexHull unit = hull;
  for (Vec3& v : unit.vertices) v = frame.to_unit(v);
  for (Face& f : unit.faces) f.offset = (f.offset - dot(f.normal, frame.origin)) / frame.size;
  const Content content = Content{"hull"}.add(surface_of(unit));
  return back(decompose(hull_solid(unit), content, options), frame);
}

SphereDecomposition decompose_mesh(const TriangleMesh& mesh, const SphereDecompositionOptions& options) {
  const Aabb box = bounds_of(mesh.vertices);
  const UnitFrame frame{0.5 * (box.lower + box.upper), mesh_solid(mesh).size};
  TriangleMesh unit = mesh;
  for (Vec3& v : unit.vertices) v = frame.to_unit(v);
  return back(decompose(mesh_solid(unit), Content{"mesh"}.add(unit), options), frame);
}

SphereDecomposition scaled(SphereDecomposition d, double factor) {
  SCREE_REQUIRE(factor > 0.0, "scaled(): the factor must be positive");
  for (Sphere& s : d.spheres) s = {factor * s.centre, factor * s.radius};
  return d;
}

}  // namespace scree
