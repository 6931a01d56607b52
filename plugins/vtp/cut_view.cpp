#include "vtp/cut_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scree/interfaces/scene_services.hpp"

namespace scree {

namespace {

CutPlane plane_of(const Options& options) {
  const Vec3 normal = options.vector("normal");
  if (norm(normal) == 0.0)
    throw options.error("normal", "has no length; give the direction of what is to be taken away");
  return {options.vector("point"), normalized(normal), options.text("show") == "cut"};
}

// The six planes of a box, which take away what is outside.
void append_box(const Options& box, std::vector<CutPlane>& planes) {
  const Vec3 lower = box.vector("lower"), upper = box.vector("upper");
  for (int axis = 0; axis < 3; ++axis) {
    if (!(lower[axis] < upper[axis])) throw box.error("upper", "must be greater than 'lower' in x, y and z");
    Vec3 out;
    out[axis] = 1.0;
    planes.push_back({upper, out, false});
    planes.push_back({lower, -out, false});
  }
}

std::vector<BodyId> ids_of(const Options& options, const char* key, const SceneServices& services) {
  std::vector<BodyId> ids;
  for (const std::string& name : options.texts(key)) ids.push_back(services.body(name).id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

// The part of a convex polygon below a plane (Sutherland and Hodgman 1974).
void clip_polygon(const CutPlane& plane, std::vector<Vec3>& polygon, std::vector<Vec3>& work) {
  work.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = plane.height(a), at_b = plane.height(b);
    if (at_a <= 0.0) work.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) work.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  polygon.swap(work);
}

}  // namespace

std::vector<Parameter> CutView::parameters() {
  std::vector<Parameter> plane{
      Parameter::vector("point", "m", "a point of the plane"),
      Parameter::vector("normal", "1", "points to the side that is taken away"),
      Parameter::choice("show", {"rest", "cut"}, "everything on the other side, or only the bodies that the plane cuts")
          .by_default("rest")};
  std::vector<Parameter> box{Parameter::vector("lower", "m", "lower corner"),
                             Parameter::vector("upper", "m", "upper corner")};
  std::vector<Parameter> cylinder{Parameter::vector("from", "m", "beginning of the axis"),
                                  Parameter::vector("to", "m", "end of the axis"),
                                  Parameter::number("radius", "m", "of the cylinder").above(0.0)};
  return {Parameter::tables("plane", std::move(plane), "planes that cut the view").optional(),
          Parameter::variant(
              "region",
              {{"box", "between two corners", std::move(box)}, {"cylinder", "about an axis", std::move(cylinder)}},
              "only what lies in it is shown")
              .optional(),
          Parameter::texts("hide", "names of scene bodies that are not shown").by_default(std::vector<std::string>{}),
          Parameter::texts("as_walls", "names of dynamic scene bodies that are shown as walls are: a drum on a joint")
              .by_default(std::vector<std::string>{})};
}

void CutView::setup(const Options& options, const SceneServices& services) {
  for (const Options& plane : options.tables("plane")) planes_.push_back(plane_of(plane));
  if (options.has("region")) {
    const Options& region = options.table("region");
    if (region.type() == "box") {
      append_box(region, planes_);
    } else {
      cylinder_ = {region.vector("from"), region.vector("to"), region.number("radius")};
      if (norm(cylinder_.to - cylinder_.from) == 0.0) throw region.error("to", "must differ from 'from'");
    }
  }
  hidden_ = ids_of(options, "hide", services);
  walls_ = ids_of(options, "as_walls", services);
}

bool CutView::contains(const std::vector<BodyId>& sorted, BodyId id) {
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

bool CutView::in_cylinder(const Vec3& p) const {
  if (cylinder_.radius == 0.0) return true;
  const Vec3 axis = cylinder_.to - cylinder_.from, arm = p - cylinder_.from;
  const double along = dot(arm, axis) / squared_norm(axis);
  return along >= 0.0 && along <= 1.0 && norm(arm - along * axis) <= cylinder_.radius;
}

bool CutView::keeps(const Vec3& centre, double radius) const {
  for (const CutPlane& plane : planes_) {
    const double height = plane.height(centre);
    if (plane.only_cut ? std::abs(height) > radius : height > 0.0) return false;
  }
  return in_cylinder(centre);
}

bool CutView::keeps_point(const Vec3& p) const {
  for (const CutPlane& plane : planes_) {
    if (!plane.only_cut && plane.height(p) > 0.0) return false;
  }
  return in_cylinder(p);
}

bool CutView::crossed(const std::array<Vec3, 3>& corners) const {
  for (const CutPlane& plane : planes_) {
    if (!plane.only_cut) continue;
    const double a = plane.height(corners[0]), b = plane.height(corners[1]), c = plane.height(corners[2]);
    if (std::min({a, b, c}) > 0.0 || std::max({a, b, c}) < 0.0) return false;
  }
  return true;
}

void CutView::clip(Surface& surface, std::size_t first) const {
  if (planes_.empty() && cylinder_.radius == 0.0) return;
  const std::vector<std::array<std::uint32_t, 3>> whole{surface.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                                                        surface.triangles.end()};
  surface.triangles.resize(first);
  std::vector<Vec3> polygon, work;
  for (const std::array<std::uint32_t, 3>& t : whole) {
    const std::array<Vec3, 3> corners{surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
    if (!crossed(corners) || !in_cylinder((corners[0] + corners[1] + corners[2]) / 3.0)) continue;
    polygon.assign(corners.begin(), corners.end());
    bool is_cut = false;
    for (const CutPlane& plane : planes_) {
      const bool above =
          std::any_of(polygon.begin(), polygon.end(), [&](const Vec3& p) { return plane.height(p) > 0.0; });
      if (plane.only_cut || !above) continue;
      clip_polygon(plane, polygon, work);
      is_cut = true;
    }
    if (!is_cut) {
      surface.triangles.push_back(t);
      continue;
    }
    const auto base = static_cast<std::uint32_t>(surface.points.size());
    surface.points.insert(surface.points.end(), polygon.begin(), polygon.end());
    for (std::uint32_t k = 1; k + 1 < polygon.size(); ++k) surface.triangles.push_back({base, base + k, base + k + 1});
  }
}

void drop_unused_points(Surface& surface) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(surface.points.size(), kUnused);
  for (const auto& t : surface.triangles) {
    for (const std::uint32_t corner : t) number[corner] = 0;
  }
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == kUnused) continue;
    surface.points[next] = surface.points[i];
    number[i] = next++;
  }
  surface.points.resize(next);
  for (auto& t : surface.triangles) {
    for (std::uint32_t& corner : t) corner = number[corner];
  }
}

}  // namespace scree
