#include "conformance/hollow_drum_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scree::test {
namespace {

constexpr double kGapError = 1e-3;    // [size of the solid]
constexpr double kShownError = 5e-4;  // of what a direction leaves free, where two are as good [size]
constexpr double kTurn = 2.0 * std::numbers::pi;

/// The plane at a support of the solid across d, from the origin [m].
double support_of(const std::vector<ReferenceSolid>& parts, const Vec3& d) {
  const ReferenceSolid origin{ShapeKind::sphere, {}, {}, {}, {}, {}};
  double farthest = -std::numeric_limits<double>::infinity();
  for (const ReferenceSolid& part : parts) farthest = std::max(farthest, -separation_along(part, origin, d));
  return farthest;
}

/// The least of what the mantle leaves free in any direction [m]: stations all around, and golden sections about the best.
double mantle_gap(double radius, const std::vector<ReferenceSolid>& parts) {
  constexpr int kStations = 720;
  const auto at = [&](double angle) { return mantle_gap_along(radius, parts, angle); };
  std::array<double, kStations> gap{};
  for (int k = 0; k < kStations; ++k) gap[static_cast<std::size_t>(k)] = at(kTurn * k / kStations);
  double least = std::ranges::min(gap);
  for (std::size_t k = 0; k < kStations; ++k) {
    if (gap[k] > gap[(k + 1) % kStations] || gap[k] >= gap[(k + kStations - 1) % kStations]) continue;
    double low = kTurn * (static_cast<double>(k) - 1.0) / kStations, high = low + 2.0 * kTurn / kStations;
    for (int step = 0; step < 40; ++step) {
      const double third = (high - low) / 3.0;
      (at(low + third) < at(high - third) ? high : low) += at(low + third) < at(high - third) ? -third : third;
    }
    least = std::min(least, at(0.5 * (low + high)));
  }
  return least;
}

std::vector<ReferenceSolid> placed(const PrimitiveData& solid, const Pose& pose) {
  return reference_solids(solid, pose);
}

/// A gap in sizes of the solid: none of its middle is beyond a wall by more than its size.
double wanted_gap(RandomNumbers& random) {
  const double kind = random.uniform(0.0, 1.0);
  if (kind < 0.3) return -random.decades(1e-5, 0.1);
  if (kind < 0.4) return random.uniform(-1e-9, 1e-9);
  if (kind < 0.8) return random.decades(1e-5, 0.3);
  return random.uniform(0.0, 1.0);
}

/// Moves the solid outwards until the mantle leaves `gap` [m].
void push_to_mantle(DrumPose& out, Pose& inside, double radius, double gap, double angle) {
  const Vec3 way{std::cos(angle), std::sin(angle), 0.0};
  const Vec3 from = inside.position;
  double near = 0.0, far = radius + 2.0 * out.size;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (near + far);
    inside.position = from + middle * way;
    (mantle_gap_along(radius, placed(out.solid, inside), angle) > gap ? near : far) = middle;
  }
}

/// An orientation: any, or with the axes along those of the drum, or lying across it.
Quat orientation(RandomNumbers& random) {
  const double kind = random.uniform(0.0, 1.0), half = random.uniform(0.0, std::numbers::pi);
  const double c = std::sqrt(0.5);
  const Quat about_axis{std::cos(half), 0, 0, std::sin(half)};
  if (kind < 0.2) return about_axis;
  if (kind < 0.4) return about_axis * Quat{c, 0, c, 0};
  return random.rotation();
}

/// Which wall a normal in the drum's frame is of: 0, 1, 2, or 3 for none.
std::size_t wall_of(const Vec3& n) {
  if (std::abs(n.z) < 1e-6) return 0;
  if (n.z < -1.0 + 1e-9) return 1;
  return n.z > 1.0 - 1e-9 ? 2 : 3;
}

}  // namespace

double mantle_gap_along(double radius, const std::vector<ReferenceSolid>& parts, double angle) {
  return radius - support_of(parts, {std::cos(angle), std::sin(angle), 0.0});
}

DrumPose drum_pose(ShapeKind inside, int trial) {
  RandomNumbers random{static_cast<std::uint64_t>(trial) * 1000 + 500 + static_cast<std::uint64_t>(inside)};
  DrumPose out;
  out.size = random.decades(1e-4, 10.0);
  const double radius = out.size * random.decades(1.0, 50.0), half_length = out.size * random.decades(1.0, 50.0);
  out.drum = primitive_data(ShapeKind::cylinder, {radius, half_length, 0}, true);
  out.solid = random_solid(inside, out.size, random);
  out.drum_first = trial % 2 == 0;
  out.reach = out.size * random.uniform(0.01, 0.5);
  out.drum_pose = {random.in_cube(3.0), random.rotation()};
  Pose in_drum{{0, 0, random.uniform(-0.5, 0.5) * (half_length - out.size)}, orientation(random)};
  const int walls = trial % 4;  // none, mantle, lid, both
  if (walls % 2 == 1) push_to_mantle(out, in_drum, radius, wanted_gap(random) * out.size, random.uniform(0.0, kTurn));
  if (walls >= 2) {
    const double up = random.uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0;
    const double reach = support_of(placed(out.solid, {{}, in_drum.orientation}), {0, 0, up});
    in_drum.position.z = up * (half_length - reach - wanted_gap(random) * out.size);
  }
  out.pose = out.drum_pose * in_drum;
  // As the phase sees it, with what is rounded on the way.
  const std::vector<ReferenceSolid> parts = placed(out.solid, inverse(out.drum_pose) * out.pose);
  out.gap = {mantle_gap(radius, parts), half_length - support_of(parts, {0, 0, 1}),
             half_length - support_of(parts, {0, 0, -1})};
  out.description = "trial " + std::to_string(trial) + ", size " + std::to_string(out.size) + " m, true gaps " +
                    std::to_string(out.gap[0] / out.size) + ", " + std::to_string(out.gap[1] / out.size) + " and " +
                    std::to_string(out.gap[2] / out.size) + " sizes";
  return out;
}

std::string fault_of(NarrowPhase& phase, const DrumPose& pose) {
  PairScene scene{pose.drum_first ? pose.drum : pose.solid, pose.drum_first ? pose.solid : pose.drum};
  const ContactBuffer contacts = scene.collide(phase, pose.drum_first ? pose.drum_pose : pose.pose,
                                               pose.drum_first ? pose.pose : pose.drum_pose, pose.reach);
  const double slack = kGapError * pose.size, radius = pose.drum.primitive.size.x;
  const std::vector<ReferenceSolid> parts = placed(pose.solid, inverse(pose.drum_pose) * pose.pose);
  std::array<bool, 3> held{};
  for (const Contact& c : contacts) {
    if (!is_finite(c.point) || !is_finite(c.normal) || !std::isfinite(c.gap)) return "a contact is not finite";
    if (std::abs(norm(c.normal) - 1.0) > 1e-9) return "a normal is not of unit length";
    if (!(c.gap < pose.reach)) return "a gap is beyond the reach";
    const Vec3 n = (pose.drum_first ? 1.0 : -1.0) * rotate_back(pose.drum_pose.orientation, c.normal);
    const std::size_t wall = wall_of(n);
    if (wall == 3) return "a normal is that of no wall";
    if (c.gap < pose.gap[wall] - slack) return "a contact is deeper than is true";
    const bool right =
        wall != 0 || mantle_gap_along(radius, parts, std::atan2(-n.y, -n.x)) < pose.gap[0] + kShownError * pose.size;
    held[wall] = held[wall] || (right && c.gap < pose.gap[wall] + slack);
  }
  if (!std::ranges::is_sorted(contacts, std::less_equal{}, &Contact::feature)) return "features do not increase";
  for (std::size_t wall = 0; wall < 3; ++wall) {
    if (!held[wall] && pose.gap[wall] < pose.reach - slack) return "no true contact of wall " + std::to_string(wall);
  }
  return {};
}

}  // namespace scree::test
