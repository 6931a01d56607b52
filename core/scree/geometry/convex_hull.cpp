#include "scree/geometry/convex_hull.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "scree/base/error.hpp"
#include "scree/base/require.hpp"

namespace scree {
namespace {

/// Points moved and scaled into a box of about unit size, where Qhull's tolerances mean something.
struct Normalised {
  Vec3 origin;
  double scale = 1.0;
  std::vector<double> coordinates;  // x y z a point

  [[nodiscard]] std::size_t size() const { return coordinates.size() / 3; }
  [[nodiscard]] Vec3 point(std::size_t i) const {
    return {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  }
};

Normalised normalise(std::span<const Vec3> points) {
  const Aabb box = bounds_of(points);
  Normalised result;
  result.origin = 0.5 * (box.lower + box.upper);
  const Vec3 extent = box.upper - box.lower;
  result.scale = std::max({extent.x, extent.y, extent.z});
  if (!(result.scale > 0.0)) return result;
  for (const Vec3& p : points) {
    const Vec3 n = (p - result.origin) / result.scale;
    result.coordinates.insert(result.coordinates.end(), {n.x, n.y, n.z});
  }
  return result;
}

/// The point that is furthest by a measure, and the value of the measure there.
template <typename Measure>
std::pair<std::size_t, double> furthest(const Normalised& points, Measure measure) {
  std::pair<std::size_t, double> best{0, -1.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const double value = measure(points.point(i)); value > best.second) best = {i, value};
  }
  return best;
}

/// "point", "line", "plane", or nothing for points that span a solid.
const char* flatness(const Normalised& points) {
  constexpr double kThin = 1e-9;
  if (points.size() == 0) return "in one point";
  const Vec3 a = points.point(0);
  const auto [ib, length] = furthest(points, [&](const Vec3& p) { return norm(p - a); });
  const Vec3 along = normalized(points.point(ib) - a);
  const auto [ic, width] = furthest(points, [&](const Vec3& p) { return norm(cross(along, p - a)); });
  if (width < kThin) return "on one line";
  const Vec3 normal = normalized(cross(along, points.point(ic) - a));
  const double height = furthest(points, [&](const Vec3& p) { return std::abs(dot(normal, p - a)); }).second;
  return height < kThin ? "in one plane" : nullptr;
}

/// One run of Qhull with its own state (the reentrant library) and its messages kept for the error.
class QhullRun {
 public:
  explicit QhullRun(Normalised& points) {
    messages_ = open_memstream(&text_, &length_);
    qh_zero(&state_, messages_);
    char command[] = "qhull";
    status_ = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), points.coordinates.data(), False, command,
                           nullptr, messages_);
  }
  ~QhullRun() {
    qh_freeqhull(&state_, !qh_ALL);
    int blocks = 0, bytes = 0;
    qh_memfreeshort(&state_, &blocks, &bytes);
    (void)std::fclose(messages_);
    std::free(text_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  void require_success() {
    if (status_ == 0) return;
    (void)std::fflush(messages_);
    const std::string text{text_, length_};
    throw Error{ErrorKind::usage,
                "no convex hull could be made of these points; Qhull says: " + text.substr(0, text.find('\n'))};
  }
  qhT* state() { return &state_; }

 private:
  qhT state_;
  FILE* messages_ = nullptr;
  char* text_ = nullptr;
  std::size_t length_ = 0;
  int status_ = 0;
};

/// A plane of the hull and its corners in order, as indices of input points.
struct Polygon {
  Vec3 normal;
  std::vector<std::uint32_t> corners;
};

std::vector<Polygon> read_polygons(qhT* qh, const Normalised& points) {
  std::vector<Polygon> polygons;
  facetT* facet = nullptr;
  FORALLfacets {
    Polygon polygon{{facet->normal[0], facet->normal[1], facet->normal[2]}, {}};
    setT* ring = qh_facet3vertex(qh, facet);
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(ring) polygon.corners.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
    qh_settempfree(qh, &ring);

    Vec3 area;
    for (std::size_t k = 0; k + 2 < polygon.corners.size(); ++k) {
      const Vec3 a = points.point(polygon.corners[0]);
      area += cross(points.point(polygon.corners[k + 1]) - a, points.point(polygon.corners[k + 2]) - a);
    }
    if (dot(area, polygon.normal) < 0.0) std::ranges::reverse(polygon.corners);
    // Start at the lowest index, so that the fan of triangles does not hang on Qhull's order.
    std::rotate(polygon.corners.begin(), std::ranges::min_element(polygon.corners), polygon.corners.end());
    polygons.push_back(std::move(polygon));
  }
  std::ranges::sort(polygons, {}, &Polygon::corners);
  return polygons;
}

ConvexHull build(std::span<const Vec3> points, const std::vector<Polygon>& polygons) {
  ConvexHull hull;
  std::map<std::uint32_t, std::uint32_t> new_index;
  for (const Polygon& polygon : polygons) {
    for (const std::uint32_t corner : polygon.corners) new_index[corner] = 0;
  }
  for (auto& [source, index] : new_index) {
    index = static_cast<std::uint32_t>(hull.vertices.size());
    hull.vertices.push_back(points[source]);
    hull.sources.push_back(source);
  }
  for (const Polygon& polygon : polygons) {
    Face face{polygon.normal, -std::numeric_limits<double>::infinity()};
    // The outermost corner carries the plane, so that no corner sticks out of the solid.
    for (const std::uint32_t c : polygon.corners) face.offset = std::max(face.offset, dot(face.normal, points[c]));
    for (std::size_t k = 0; k + 2 < polygon.corners.size(); ++k) {
      hull.triangles.push_back(
          {new_index[polygon.corners[0]], new_index[polygon.corners[k + 1]], new_index[polygon.corners[k + 2]]});
      hull.triangle_face.push_back(static_cast<std::uint32_t>(hull.faces.size()));
    }
    hull.faces.push_back(face);
  }
  return hull;
}

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points) {
  if (points.size() < 4) {
    throw Error{ErrorKind::usage, "a convex hull needs at least 4 points, but there are " +
                                      std::to_string(points.size()) + "; add corners"};
  }
  const auto bad = std::ranges::find_if(points, [](const Vec3& p) { return !is_finite(p); });
  if (bad != points.end()) {
    throw Error{ErrorKind::usage, "point " + std::to_string(bad - points.begin()) +
                                      " of a convex hull is not finite; every coordinate must be a number"};
  }
  Normalised normalised = normalise(points);
  if (const char* flat = flatness(normalised)) {
    throw Error{ErrorKind::usage,
                std::string{"all points of a convex hull lie "} + flat + "; a hull needs points that span a volume"};
  }
  QhullRun run{normalised};
  run.require_success();
  return build(points, read_polygons(run.state(), normalised));
}

TriangleMesh surface_of(const ConvexHull& hull) { return {hull.vertices, hull.triangles}; }

ConvexHull scaled(ConvexHull hull, double factor) {
  SCREE_REQUIRE(factor > 0.0, "scaled(): the factor must be positive");
  for (Vec3& v : hull.vertices) v *= factor;
  for (Face& f : hull.faces) f.offset *= factor;
  return hull;
}

}  // namespace scree
