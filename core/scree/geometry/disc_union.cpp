#include "scree/geometry/disc_union.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Adds the boundary integrals of Green's theorem over one arc, counter-clockwise from angle a to angle b:
/// area = 1/2 (x dy - y dx), x: x^2/2 dy, y: -y^2/2 dx, xx: x^3/3 dy, yy: -y^3/3 dx, xy: x^2 y/2 dy.
void add_arc(const Disc& disc, double a, double b, PlanarMoments& sum) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  const double u = disc.x, v = disc.y, r = disc.radius;
  // Integrals of cos^n and sin^n over the arc, and of sin cos^n.
  const double c1 = sb - sa, s1 = ca - cb;
  const double c2 = 0.5 * (b - a + sb * cb - sa * ca), s2 = (b - a) - c2;
  const double c3 = c1 - (sb * sb * sb - sa * sa * sa) / 3.0;
  const double s3 = s1 - (ca * ca * ca - cb * cb * cb) / 3.0;
  const double c4 = 0.25 * (cb * cb * cb * sb - ca * ca * ca * sa) + 0.75 * c2;
  const double s4 = 0.25 * (sa * sa * sa * ca - sb * sb * sb * cb) + 0.75 * s2;
  const double sc1 = 0.5 * (ca * ca - cb * cb);
  const double sc2 = (ca * ca * ca - cb * cb * cb) / 3.0;
  const double sc3 = 0.25 * (ca * ca * ca * ca - cb * cb * cb * cb);

  sum.area += 0.5 * r * (u * c1 + v * s1 + r * (b - a));
  sum.x += 0.5 * r * (u * u * c1 + 2.0 * u * r * c2 + r * r * c3);
  sum.y += 0.5 * r * (v * v * s1 + 2.0 * v * r * s2 + r * r * s3);
  sum.xx += r / 3.0 * (u * u * u * c1 + 3.0 * u * u * r * c2 + 3.0 * u * r * r * c3 + r * r * r * c4);
  sum.yy += r / 3.0 * (v * v * v * s1 + 3.0 * v * v * r * s2 + 3.0 * v * r * r * s3 + r * r * r * s4);
  sum.xy += 0.5 * r *
            (v * (u * u * c1 + 2.0 * u * r * c2 + r * r * c3) + r * (u * u * sc1 + 2.0 * u * r * sc2 + r * r * sc3));
}

}  // namespace

bool DiscUnion::find_covered(std::span<const Disc> discs, std::size_t i) {
  covered_.clear();
  const Disc& disc = discs[i];
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    const Disc& other = discs[j];
    const double dx = other.x - disc.x, dy = other.y - disc.y;
    const double squared = dx * dx + dy * dy;
    const double sum = disc.radius + other.radius, difference = other.radius - disc.radius;
    if (squared >= sum * sum) continue;
    if (squared <= difference * difference) {
      const bool same = squared == 0.0 && difference == 0.0;
      if (same ? j < i : difference > 0.0) return false;  // of equal discs the first one counts
      continue;
    }
    const double distance = std::sqrt(squared);
    const double cosine = (squared - difference * sum) / (2.0 * distance * disc.radius);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    double middle = std::atan2(dy, dx);
    if (middle < 0.0) middle += kTurn;
    const double begin = middle - half, end = middle + half;
    covered_.push_back({std::max(begin, 0.0), std::min(end, kTurn)});
    if (begin < 0.0) covered_.push_back({begin + kTurn, kTurn});
    if (end > kTurn) covered_.push_back({0.0, end - kTurn});
  }
  std::sort(covered_.begin(), covered_.end(), [](const Arc& a, const Arc& b) { return a.begin < b.begin; });
  return true;
}

PlanarMoments DiscUnion::moments(std::span<const Disc> discs) {
  PlanarMoments sum;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (!find_covered(discs, i)) continue;
    double reached = 0.0;
    for (const Arc& arc : covered_) {
      if (arc.begin > reached) add_arc(discs[i], reached, arc.begin, sum);
      reached = std::max(reached, arc.end);
    }
    if (reached < kTurn) add_arc(discs[i], reached, kTurn, sum);
  }
  return sum;
}

}  // namespace scree
