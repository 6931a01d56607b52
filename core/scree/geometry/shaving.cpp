#include "scree/geometry/shaving.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "scree/base/error.hpp"

namespace scree {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

[[noreturn]] void refuse(const std::string& sentence) { throw Error{ErrorKind::usage, "shaving: " + sentence}; }

void check(const ShavingParameters& p) {
  if (!(p.diameter > 0.0) || !std::isfinite(p.diameter)) refuse("the diameter must be above zero");
  if (!(p.length >= p.diameter) || !std::isfinite(p.length)) refuse("the length must be at least the diameter");
  if (!(p.bend >= 0.0 && p.bend <= kTurn)) refuse("the bend must lie between 0 and 360 degrees");
  if (!(std::abs(p.twist) <= 8.0 * kTurn)) refuse("the twist must lie between -8 and 8 turns");
  if (p.count < 0 || p.count > kMostShavingSpheres) {
    refuse("the count of spheres must lie between 1 and 32, or be 0 for as many as needed");
  }
}

int choose_count(const ShavingParameters& p) {
  const double line = p.length - p.diameter;
  const int wanted = 1 + static_cast<int>(std::ceil(line / (0.5 * p.diameter) - 1e-9));
  const int count = p.count > 0 ? p.count : std::min(wanted, kMostShavingSpheres);
  if (count == 1 && line > 0.0) refuse("one sphere cannot be longer than its diameter; give more spheres");
  if (count > 1 && line / (count - 1) >= p.diameter) {
    refuse(std::to_string(count) +
           " spheres of this diameter do not reach over the length; give more spheres (at most " +
           std::to_string(kMostShavingSpheres) + ") or a larger diameter");
  }
  return count;
}

/// Point of the centre line at arc length s. The frame (tangent x, normal y) turns at the constant rate
/// w = (torsion, 0, curvature) in its own axes, so the position is s J(s w) x with the left Jacobian of rotations,
/// J = 1 + (1 - cos a) / a^2 [v] + (a - sin a) / a^3 [v]^2, v = s w, a = |v|.
Vec3 centre_line(double s, double curvature, double torsion) {
  const Vec3 v = s * Vec3{torsion, 0.0, curvature};
  const double a = norm(v);
  const double first = a < 1e-4 ? 0.5 - a * a / 24.0 : (1.0 - std::cos(a)) / (a * a);
  const double second = a < 1e-3 ? 1.0 / 6.0 - a * a / 120.0 : (a - std::sin(a)) / (a * a * a);
  const Vec3 tangent{1, 0, 0};
  const Vec3 turned = cross(v, tangent);
  return s * (tangent + first * turned + second * cross(v, turned));
}

}  // namespace

std::vector<Sphere> shaving_spheres(const ShavingParameters& p) {
  check(p);
  const int count = choose_count(p);
  const double line = p.length - p.diameter;
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const double s = count > 1 ? line * (static_cast<double>(i) / (count - 1) - 0.5) : 0.0;
    const Vec3 centre = line > 0.0 ? centre_line(s, p.bend / line, p.twist / line) : Vec3{};
    spheres.push_back({centre, 0.5 * p.diameter});
  }
  return spheres;
}

}  // namespace scree
