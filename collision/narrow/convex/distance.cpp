#include "distance.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace scree::convex {
namespace {

constexpr int kMaxSteps = 200;
/// The walk ends when the squared distance is known to this part.
constexpr double kAccuracy = 1e-14;
/// Cores that are nearer meet [size of the pair].
constexpr double kMeet = 1e-10;

/// A point of the difference b - a, and where it comes from.
struct Corner {
  Vec3 point, on_a, on_b;
};

/// Weights of corners whose sum is the point of a simplex nearest to the origin.
struct Weights {
  double squared = std::numeric_limits<double>::infinity();
  std::array<double, 4> of{};
};

class Simplex {
 public:
  void add(const Corner& corner) { corner_[count_++] = corner; }
  [[nodiscard]] bool full() const { return count_ == 4; }
  [[nodiscard]] bool holds(const Vec3& point) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (corner_[i].point == point) return true;
    }
    return false;
  }
  /// Goes to the nearest point, and drops corners that it does not need. `apart`: it is known not to hold the origin,
  /// whatever rounding makes of a flat one.
  Vec3 reduce(bool apart);
  [[nodiscard]] Closest result() const;

 private:
  void try_corner(std::size_t i, Weights& best) const;
  void try_edge(std::size_t i, std::size_t j, Weights& best) const;
  void try_face(std::size_t i, std::size_t j, std::size_t k, Weights& best) const;
  [[nodiscard]] bool holds_origin() const;
  void take(const std::array<double, 4>& weights, Weights& best) const;

  std::array<Corner, 4> corner_;
  std::array<double, 4> weight_{};
  std::size_t count_ = 0;
};

void Simplex::take(const std::array<double, 4>& weights, Weights& best) const {
  Vec3 v;
  for (std::size_t i = 0; i < count_; ++i) v += weights[i] * corner_[i].point;
  const double squared = squared_norm(v);
  if (squared < best.squared) best = {squared, weights};
}

void Simplex::try_corner(std::size_t i, Weights& best) const {
  std::array<double, 4> weights{};
  weights[i] = 1.0;
  take(weights, best);
}

void Simplex::try_edge(std::size_t i, std::size_t j, Weights& best) const {
  const Vec3 edge = corner_[j].point - corner_[i].point;
  const double t = -dot(edge, corner_[i].point) / squared_norm(edge);
  if (!(t > 0.0 && t < 1.0)) return;
  std::array<double, 4> weights{};
  weights[i] = 1.0 - t;
  weights[j] = t;
  take(weights, best);
}

void Simplex::try_face(std::size_t i, std::size_t j, std::size_t k, Weights& best) const {
  const Vec3 &p = corner_[i].point, &q = corner_[j].point, &r = corner_[k].point;
  const Vec3 normal = cross(q - p, r - p);
  const double area = squared_norm(normal);
  const double v = -dot(cross(p, r - p), normal) / area;
  const double w = -dot(cross(q - p, p), normal) / area;
  if (!(v > 0.0 && w > 0.0 && v + w < 1.0)) return;
  std::array<double, 4> weights{};
  weights[i] = 1.0 - v - w;
  weights[j] = v;
  weights[k] = w;
  take(weights, best);
}

bool Simplex::holds_origin() const {
  if (count_ < 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &p = corner_[(i + 1) % 4].point, &q = corner_[(i + 2) % 4].point, &r = corner_[(i + 3) % 4].point;
    const Vec3 normal = cross(q - p, r - p);
    // Strictly on the inner side of all four faces.
    if (!(dot(normal, corner_[i].point - p) * dot(normal, -p) > 0.0)) return false;
  }
  return true;
}

Vec3 Simplex::reduce(bool apart) {
  if (!apart && holds_origin()) return {};
  Weights best;
  for (std::size_t i = 0; i < count_; ++i) {
    try_corner(i, best);
    for (std::size_t j = 0; j < i; ++j) {
      try_edge(i, j, best);
      for (std::size_t k = 0; k < j; ++k) try_face(i, j, k, best);
    }
  }
  std::size_t kept = 0;
  Vec3 nearest;
  for (std::size_t i = 0; i < count_; ++i) {
    if (best.of[i] == 0.0) continue;
    corner_[kept] = corner_[i];
    weight_[kept] = best.of[i];
    nearest += best.of[i] * corner_[kept].point;
    ++kept;
  }
  count_ = kept;
  return nearest;
}

Closest Simplex::result() const {
  Closest found;
  for (std::size_t i = 0; i < count_; ++i) {
    found.on_a += weight_[i] * corner_[i].on_a;
    found.on_b += weight_[i] * corner_[i].on_b;
  }
  const Vec3 way = found.on_b - found.on_a;
  found.distance = norm(way);
  found.apart = found.distance > kMeet;
  if (found.apart) found.direction = way / found.distance;
  return found;
}

Corner corner_towards(const ConvexSolid& a, const ConvexSolid& b, const Vec3& shift, const Vec3& direction) {
  Corner corner;
  corner.on_a = core_support(a, -direction);
  corner.on_b = core_support(b, direction) + shift;
  corner.point = corner.on_b - corner.on_a;
  return corner;
}

}  // namespace

Closest distance(const ConvexSolid& a, const ConvexSolid& b, const Vec3& shift) {
  Simplex simplex;
  simplex.add(corner_towards(a, b, shift, a.pose.position - b.pose.position - shift));
  Vec3 v = simplex.reduce(false);
  bool apart = false;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double squared = squared_norm(v);
    if (squared < kMeet * kMeet) return {};
    const Corner corner = corner_towards(a, b, shift, -v);
    if (squared - dot(v, corner.point) <= kAccuracy * squared || simplex.holds(corner.point)) break;
    simplex.add(corner);
    apart = apart || dot(v, corner.point) > kMeet * std::sqrt(squared);
    const Vec3 nearer = simplex.reduce(apart);
    if (simplex.full()) return {};
    if (squared_norm(nearer) >= squared) break;  // rounding: no nearer any more
    v = nearer;
  }
  return simplex.result();
}

}  // namespace scree::convex
