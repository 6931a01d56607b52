#include "manifold.hpp"

#include <algorithm>
#include <cmath>

#include "scree/collision/contact.hpp"
#include "scree/math/contact_frame.hpp"
#include "surface_feature.hpp"

namespace scree::convex {
namespace {

constexpr std::size_t kMaxPoints = 8;
/// A corner this much deeper than the solids are is one of a feature seen edge-on [size of the pair].
constexpr double kTolerance = 1e-6;

/// A corner seen along the normal, and the edges that meet in it: those of b start at kOther.
struct Corner2 {
  double x = 0.0, y = 0.0;
  std::uint32_t before = 0, after = 0;
};
constexpr std::uint32_t kOther = 64;

/// A feature seen along the normal, with the plane or line in which it lies.
struct Outline {
  std::vector<Corner2> corner;
  double x0 = 0.0, y0 = 0.0, h0 = 0.0;  // a point of it
  double slope_x = 0.0, slope_y = 0.0;
  bool flat = false;  // its height is known everywhere on it

  [[nodiscard]] double height(double x, double y) const { return h0 + slope_x * (x - x0) + slope_y * (y - y0); }
};

double turn(const Corner2& p, const Corner2& q, double x, double y) {
  return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
}

void fit_line(const Outline& seen, double h1, Outline& out) {
  const double dx = seen.corner[1].x - seen.corner[0].x, dy = seen.corner[1].y - seen.corner[0].y;
  const double squared = dx * dx + dy * dy;
  const double rise = h1 - out.h0;
  out.flat = squared > 1e-12 && rise * rise < 100.0 * squared;
  if (!out.flat) return;
  out.slope_x = rise * dx / squared;
  out.slope_y = rise * dy / squared;
}

/// Newell's normal in (x, y, height).
void fit_plane(std::span<const Vec3> points, Outline& out) {
  Vec3 n;
  for (std::size_t i = 0; i < points.size(); ++i)
    n += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  const double size = norm(n);
  out.flat = size > 1e-12 && std::abs(n.z) > 0.1 * size;
  if (!out.flat) return;
  out.slope_x = -n.x / n.z;
  out.slope_y = -n.y / n.z;
  if (n.z < 0.0) std::reverse(out.corner.begin(), out.corner.end());
}

Outline outline(const SurfaceFeature& feature, const ContactFrame& frame, const Vec3& origin,
                std::uint32_t first_edge) {
  Outline out;
  std::array<Vec3, SurfaceFeature::kMaxCorners> seen;
  for (std::size_t i = 0; i < feature.count; ++i) {
    seen[i] = to_contact(frame, feature.corner[i] - origin);  // height, x, y
    seen[i] = {seen[i].y, seen[i].z, seen[i].x};
    const auto edge = first_edge + static_cast<std::uint32_t>(i);
    const auto last = first_edge + static_cast<std::uint32_t>((i + feature.count - 1) % feature.count);
    out.corner.push_back({seen[i].x, seen[i].y, last, edge});
  }
  out.x0 = seen[0].x;
  out.y0 = seen[0].y;
  out.h0 = seen[0].z;
  if (feature.count == 2) {  // one edge, two ends
    for (Corner2& end : out.corner) end.before = end.after;
  }
  if (feature.count == 2) fit_line(out, seen[1].z, out);
  if (feature.count > 2) fit_plane({seen.data(), feature.count}, out);
  return out;
}

/// What of the subject, a polygon or a line, lies to the left of the edge from p to q.
void clip(std::vector<Corner2>& subject, const Corner2& p, const Corner2& q, std::uint32_t edge,
          std::vector<Corner2>& scratch) {
  scratch.clear();
  const std::size_t count = subject.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Corner2& from = subject[i];
    const double here = turn(p, q, from.x, from.y);
    if (here >= 0.0) scratch.push_back(from);
    if (count == 2 && i == 1) break;  // a line does not come back
    const Corner2& to = subject[(i + 1) % count];
    const double there = turn(p, q, to.x, to.y);
    if ((here >= 0.0) == (there >= 0.0)) continue;
    const double t = here / (here - there);
    Corner2 cut{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.after, edge};
    if (here < 0.0) std::swap(cut.before, cut.after);
    scratch.push_back(cut);
  }
  subject.swap(scratch);
}

/// The common part of two lines that are parallel; nothing of others.
std::vector<Corner2> clip_lines(const Outline& a, const Outline& b) {
  const Corner2 &p = a.corner[0], &q = a.corner[1];
  const double dx = q.x - p.x, dy = q.y - p.y, squared = dx * dx + dy * dy;
  const double bx = b.corner[1].x - b.corner[0].x, by = b.corner[1].y - b.corner[0].y;
  if (std::abs(dx * by - dy * bx) > 1e-3 * std::sqrt(squared * (bx * bx + by * by))) return {};
  const auto along = [&](const Corner2& c) { return ((c.x - p.x) * dx + (c.y - p.y) * dy) / squared; };
  const double s = along(b.corner[0]), t = along(b.corner[1]);
  const double low = std::max(0.0, std::min(s, t)), high = std::min(1.0, std::max(s, t));
  if (!(low < high)) return {};
  return {{p.x + low * dx, p.y + low * dy, 0, kOther}, {p.x + high * dx, p.y + high * dy, 1, kOther + 1}};
}

std::vector<Corner2> common_part(const Outline& a, const Outline& b) {
  if (!a.flat || !b.flat) return {};
  if (a.corner.size() == 2 && b.corner.size() == 2) return clip_lines(a, b);
  const bool a_is_cut = b.corner.size() > 2;
  std::vector<Corner2> subject = a_is_cut ? a.corner : b.corner, scratch;
  const std::vector<Corner2>& by = a_is_cut ? b.corner : a.corner;
  for (std::size_t i = 0; i < by.size() && !subject.empty(); ++i) {
    // A reversed outline counts its edges backwards: each still has its own number.
    clip(subject, by[i], by[(i + 1) % by.size()], by[i].after, scratch);
  }
  return subject;
}

/// Keeps the deepest and those farthest out in seven directions.
void thin_out(const ContactFrame& frame, std::vector<ManifoldPoint>& points) {
  if (points.size() <= kMaxPoints) return;
  std::vector<char> keep(points.size(), 0);
  const auto choose = [&](const auto& value) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (value(points[i]) > value(points[best])) best = i;
    }
    keep[best] = 1;
  };
  choose([](const ManifoldPoint& p) { return -p.gap; });
  for (std::size_t k = 0; k + 1 < kMaxPoints; ++k) {
    const double angle = 6.283185307179586 * static_cast<double>(k) / static_cast<double>(kMaxPoints - 1);
    const Vec3 d = std::cos(angle) * frame.tangent1 + std::sin(angle) * frame.tangent2;
    choose([&](const ManifoldPoint& p) { return dot(d, p.point); });
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i] != 0) points[kept++] = points[i];
  }
  points.resize(kept);
}

}  // namespace

void find_manifold(const ConvexSolid& a, const ConvexSolid& b, const Separation& found, double reach,
                   std::vector<ManifoldPoint>& out) {
  out.clear();
  if (!(found.gap < reach)) return;
  const ContactFrame frame = contact_frame(found.normal);
  const Vec3 origin = 0.5 * (found.on_a + found.on_b);
  const SurfaceFeature of_a = surface_feature(a, found.normal), of_b = surface_feature(b, -found.normal);
  double deepest = reach;
  if (of_a.count > 1 && of_b.count > 1) {
    const Outline seen_a = outline(of_a, frame, origin, 0), seen_b = outline(of_b, frame, origin, kOther);
    for (const Corner2& c : common_part(seen_a, seen_b)) {
      const double low = seen_a.height(c.x, c.y), high = seen_b.height(c.x, c.y);
      if (!(high - low < reach)) continue;
      const std::uint32_t feature = 1 + (std::min(c.before, c.after) << 7 | std::max(c.before, c.after));
      const Vec3 place{0.5 * (low + high), c.x, c.y};
      out.push_back({feature, origin + to_world(frame, place), std::max(high - low, found.gap)});
      deepest = std::min(deepest, high - low);
    }
  }
  if (deepest < found.gap - kTolerance) out.clear();  // not the features that explain this contact
  if (out.empty() || deepest > found.gap + kTolerance) out.push_back({0, origin, found.gap});
  thin_out(frame, out);
  std::ranges::stable_sort(out, {}, &ManifoldPoint::feature);
  const auto same = [](const ManifoldPoint& l, const ManifoldPoint& r) { return l.feature == r.feature; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

}  // namespace scree::convex
