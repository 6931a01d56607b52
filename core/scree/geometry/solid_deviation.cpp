#include "scree/geometry/solid_deviation.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "scree/geometry/sphere_union.hpp"

namespace scree {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Signed distance of the union at p: exact outside, the depth in the deepest ball inside.
double union_distance(std::span<const Sphere> spheres, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : spheres) least = std::min(least, norm(p - s.centre) - s.radius);
  return least;
}

bool is_inside_another(std::span<const Sphere> spheres, const Vec3& p, std::size_t i) {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (k != i && squared_norm(p - spheres[k].centre) < spheres[k].radius * spheres[k].radius) return true;
  }
  return false;
}

/// Way from p along the unit direction until no ball holds the point any more.
double way_out(std::span<const Sphere> spheres, const Vec3& p, const Vec3& direction) {
  double way = 0.0;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Sphere& s : spheres) {
      const Vec3 q = p + way * direction - s.centre;
      const double along = dot(q, direction), c = squared_norm(q) - s.radius * s.radius;
      const double step = c < 0.0 ? std::sqrt(along * along - c) - along : 0.0;
      if (step > 1e-12 * s.radius) {
        way += step;
        moved = true;
      }
    }
  }
  return way;
}

/// Points of a Fibonacci spiral over ball i that no other ball hides.
template <typename Visit>
void visit_ball(std::span<const Sphere> spheres, std::size_t i, int count, Visit visit) {
  constexpr double kGolden = std::numbers::pi * (3.0 - 2.2360679774997896964);
  for (int k = 0; k < count; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / count, r = std::sqrt(1.0 - z * z);
    const Vec3 p =
        spheres[i].centre + spheres[i].radius * Vec3{r * std::cos(kGolden * k), r * std::sin(kGolden * k), z};
    if (!is_inside_another(spheres, p, i)) visit(p);
  }
}

/// A circle in which two balls meet: centre + radius (cos u + sin v).
struct Circle {
  Vec3 centre, u, v;
  double radius;
};

/// The angles of the circle that lie in a ball, as two intervals within [0, 2 pi] (the second may be empty).
void add_hidden(const Circle& circle, const Sphere& ball, std::vector<std::array<double, 2>>& hidden) {
  const Vec3 to = ball.centre - circle.centre;
  const double a = dot(to, circle.u), b = dot(to, circle.v), swing = 2.0 * circle.radius * std::hypot(a, b);
  // |p - ball|^2 = base - swing cos(angle - middle) < radius^2
  const double excess = squared_norm(to) + circle.radius * circle.radius - ball.radius * ball.radius;
  if (excess >= swing) return;
  if (excess <= -swing) {
    hidden.push_back({0.0, kTurn});
    return;
  }
  double middle = std::atan2(b, a);
  if (middle < 0.0) middle += kTurn;
  const double half = std::acos(excess / swing), begin = middle - half, end = middle + half;
  hidden.push_back({std::max(begin, 0.0), std::min(end, kTurn)});
  if (begin < 0.0) hidden.push_back({begin + kTurn, kTurn});
  if (end > kTurn) hidden.push_back({0.0, end - kTurn});
}

/// Points on the circle in which balls i and j meet that no other ball hides; the ends of the free arcs among them,
/// since three balls meet there and the crevice is deepest.
template <typename Visit>
void visit_circle(std::span<const Sphere> spheres, std::size_t i, std::size_t j, int count, Visit visit) {
  const Sphere &a = spheres[i], &b = spheres[j];
  const Vec3 between = b.centre - a.centre;
  const double distance = norm(between);
  if (distance >= a.radius + b.radius || distance <= std::abs(a.radius - b.radius)) return;
  const Vec3 axis = between / distance;
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2.0 * distance);
  const Vec3 u = normalized(std::abs(axis.x) < 0.7 ? cross(axis, {1, 0, 0}) : cross(axis, {0, 1, 0}));
  const double radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Circle circle{a.centre + along * axis, u, cross(axis, u), radius};

  std::vector<std::array<double, 2>> hidden;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (k != i && k != j) add_hidden(circle, spheres[k], hidden);
  }
  hidden.push_back({kTurn, kTurn});
  std::ranges::sort(hidden);
  double reached = 0.0;
  for (const auto& [begin, end] : hidden) {
    const int pieces = begin > reached ? 1 + static_cast<int>(count * (begin - reached) / kTurn) : -1;
    for (int k = 0; k <= pieces; ++k) {
      const double angle = reached + (begin - reached) * k / pieces;
      visit(circle.centre + circle.radius * (std::cos(angle) * circle.u + std::sin(angle) * circle.v));
    }
    reached = std::max(reached, end);
  }
}

double cluster_to_solid(const Solid& solid, std::span<const Sphere> spheres, int samples) {
  double furthest = 0.0, area = 0.0;
  const auto visit = [&](const Vec3& p) { furthest = std::max(furthest, std::abs(solid.signed_distance(p))); };
  for (const Sphere& s : spheres) area += s.radius * s.radius;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double share = spheres[i].radius * spheres[i].radius / area;
    visit_ball(spheres, i, 16 + static_cast<int>(share * samples), visit);
    for (std::size_t j = i + 1; j < spheres.size(); ++j) visit_circle(spheres, i, j, 8 + samples / 400, visit);
  }
  return furthest;
}

double solid_to_cluster(const Solid& solid, std::span<const Sphere> spheres, int samples) {
  double furthest = 0.0;
  for (const SurfaceSample& sample : sample_surface(solid, samples)) {
    const double distance = union_distance(spheres, sample.point);
    furthest = std::max(furthest, distance >= 0.0 ? distance : way_out(spheres, sample.point, sample.normal));
  }
  return furthest;
}

}  // namespace

SolidDeviation measure_distances(const Solid& solid, std::span<const Sphere> spheres, int samples) {
  return {0.0, solid_to_cluster(solid, spheres, samples), cluster_to_solid(solid, spheres, samples)};
}

SolidDeviation measure_deviation(const Solid& solid, std::span<const Sphere> spheres, int samples) {
  SolidDeviation deviation = measure_distances(solid, spheres, samples);
  deviation.volume_error = sphere_union_volume(spheres) / solid.volume - 1.0;
  return deviation;
}

}  // namespace scree
