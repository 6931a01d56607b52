#include "scree/geometry/sphere_union.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/geometry/disc_union.hpp"

namespace scree {
namespace {

/// Eight-point Gauss-Legendre rule on [0, 1], half of it; the other half mirrors it about 1/2.
constexpr std::array<double, 4> kNodes{0.0198550717512318842, 0.1016667612931866302, 0.2372337950418355071,
                                       0.4082826787521750975};
constexpr std::array<double, 4> kWeights{0.0506142681451881296, 0.1111905172266872353, 0.1568533229389436436,
                                         0.1813418916891809915};

/// A height at which the picture in the slices changes.
struct Event {
  double z;
  bool is_meeting;  ///< two discs begin or cease to meet: the area goes there as the 3/2 power of the height
};

void check(std::span<const Sphere> spheres) {
  if (spheres.empty()) throw Error{ErrorKind::usage, "a sphere cluster needs at least one sphere"};
  for (const Sphere& s : spheres) {
    if (!is_finite(s.centre) || !std::isfinite(s.radius) || !(s.radius > 0.0)) {
      throw Error{ErrorKind::usage, "every sphere of a cluster needs a finite centre and a radius above zero"};
    }
  }
}

/// Whether p lies in a ball other than i and j; a change of the picture at such a point is not seen.
bool is_hidden(std::span<const Sphere> spheres, const Vec3& p, std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (k == i || k == j) continue;
    if (squared_norm(p - spheres[k].centre) < spheres[k].radius * spheres[k].radius) return true;
  }
  return false;
}

/// Highest and lowest point of the circle in which two balls meet.
void add_circle_events(std::span<const Sphere> spheres, std::size_t i, std::size_t j, std::vector<Event>& events) {
  const Sphere &a = spheres[i], &b = spheres[j];
  const Vec3 between = b.centre - a.centre;
  const double distance = norm(between);
  if (distance >= a.radius + b.radius || distance <= std::abs(a.radius - b.radius)) return;
  const Vec3 n = between / distance;
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2.0 * distance);
  const double circle_radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const double slope = std::sqrt(std::max(0.0, 1.0 - n.z * n.z));
  const Vec3 uphill = slope > 1e-12 ? (Vec3{0, 0, 1} - n.z * n) / slope : Vec3{};
  for (const double sign : {-1.0, 1.0}) {
    const Vec3 p = a.centre + along * n + sign * circle_radius * uphill;
    if (!is_hidden(spheres, p, i, j)) events.push_back({p.z, true});
  }
}

/// All heights where the picture changes, ascending, none closer than `least` to its neighbour.
std::vector<Event> find_events(std::span<const Sphere> spheres, double least_share) {
  double low = spheres[0].centre.z - spheres[0].radius, high = low;
  std::vector<Event> events;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 tip = spheres[i].centre + Vec3{0, 0, sign * spheres[i].radius};
      low = std::min(low, tip.z);
      high = std::max(high, tip.z);
      if (!is_hidden(spheres, tip, i, i)) events.push_back({tip.z, false});
    }
    for (std::size_t j = i + 1; j < spheres.size(); ++j) add_circle_events(spheres, i, j, events);
  }
  events.push_back({low, false});
  events.push_back({high, false});
  std::ranges::sort(events, {}, &Event::z);

  const double least = least_share * (high - low);
  std::vector<Event> kept{events.front()};
  for (const Event& event : events) {
    if (event.z - kept.back().z > least) kept.push_back(event);
    kept.back().is_meeting |= event.is_meeting && event.z >= kept.back().z;
  }
  kept.back().z = high;
  return kept;
}

/// Cuts long intervals, because the square roots of a meeting reach beyond the interval that begins there.
std::vector<Event> with_long_intervals_cut(const std::vector<Event>& events, double greatest_share) {
  const double greatest = greatest_share * (events.back().z - events.front().z);
  std::vector<Event> result;
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const double length = events[i + 1].z - events[i].z;
    const int pieces = 1 + static_cast<int>(length / greatest);
    result.push_back(events[i]);
    for (int k = 1; k < pieces; ++k) result.push_back({events[i].z + length * k / pieces, false});
  }
  result.push_back(events.back());
  return result;
}

class Slicer {
 public:
  explicit Slicer(std::span<const Sphere> spheres) : spheres_{spheres} {}

  void add(double z, double weight, VolumeMoments& sum) {
    discs_.clear();
    for (const Sphere& s : spheres_) {
      const double squared = s.radius * s.radius - (z - s.centre.z) * (z - s.centre.z);
      if (squared > 0.0) discs_.push_back({s.centre.x, s.centre.y, std::sqrt(squared)});
    }
    const PlanarMoments m = union_.moments(discs_);
    sum.volume += weight * m.area;
    sum.first += weight * Vec3{m.x, m.y, z * m.area};
    const Mat3 second{{m.xx, m.xy, z * m.x}, {m.xy, m.yy, z * m.y}, {z * m.x, z * m.y, z * z * m.area}};
    sum.second = sum.second + Mat3{weight * second.row0, weight * second.row1, weight * second.row2};
  }

 private:
  std::span<const Sphere> spheres_;
  std::vector<Disc> discs_;
  DiscUnion union_;
};

/// One interval between two changes. Where discs begin to meet at an end, z = a + h (3 t^2 - 2 t^3) makes the area a
/// smooth function of t; elsewhere the slices of a ball are polynomials in z and the rule is exact as it stands.
void integrate(const Event& a, const Event& b, Slicer& slicer, VolumeMoments& sum) {
  const double h = b.z - a.z;
  const bool smooth = !a.is_meeting && !b.is_meeting;
  for (std::size_t k = 0; k < 8; ++k) {
    const double t = k < 4 ? kNodes[k] : 1.0 - kNodes[7 - k];
    const double weight = h * (k < 4 ? kWeights[k] : kWeights[7 - k]);
    if (smooth) {
      slicer.add(a.z + h * t, weight, sum);
    } else {
      slicer.add(a.z + h * t * t * (3.0 - 2.0 * t), weight * 6.0 * t * (1.0 - t), sum);
    }
  }
}

/// The moments of everything moved by `shift`.
VolumeMoments shifted(const VolumeMoments& m, const Vec3& shift) {
  const auto outer = [](const Vec3& a, const Vec3& b) { return Mat3{a.x * b, a.y * b, a.z * b}; };
  return {m.volume, m.first + m.volume * shift,
          m.second + outer(m.first, shift) + outer(shift, m.first) + outer(m.volume * shift, shift)};
}

}  // namespace

VolumeMoments sphere_union_moments(std::span<const Sphere> spheres, const SphereUnionOptions& options) {
  check(spheres);
  // An origin inside the cluster keeps digits when it lies far from the frame's origin.
  const Vec3 origin = spheres.front().centre;
  std::vector<Sphere> local{spheres.begin(), spheres.end()};
  for (Sphere& s : local) s.centre -= origin;

  const std::vector<Event> events =
      with_long_intervals_cut(find_events(local, options.least_interval), std::min(0.1, 40.0 * options.least_interval));
  Slicer slicer{local};
  VolumeMoments sum;
  for (std::size_t i = 0; i + 1 < events.size(); ++i) integrate(events[i], events[i + 1], slicer, sum);
  return shifted(sum, origin);
}

double sphere_union_volume(std::span<const Sphere> spheres, const SphereUnionOptions& options) {
  return sphere_union_moments(spheres, options).volume;
}

}  // namespace scree
