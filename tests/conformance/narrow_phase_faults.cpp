// How contacts are judged.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "conformance/narrow_phase_case.hpp"

namespace scree::test {
namespace {

constexpr double kGapError = 1e-3;     // [size of the smaller solid]
constexpr double kShownError = 5e-4;   // of the gap that a normal shows, where two normals are as good [size]
constexpr double kOneDegree = 0.0175;  // [rad]

template <class... Numbers>
std::string words(const char* format, Numbers... numbers) {
  char text[200];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// A single contact by itself.
std::string fault_of_contact(const Contact& c, const NarrowPhasePose& pose, const ShapeSet& shapes) {
  if (!is_finite(c.point) || !is_finite(c.normal) || !std::isfinite(c.gap)) return "a contact is not finite";
  if (std::abs(norm(c.normal) - 1.0) > 1e-9) return words("a normal has length %g", norm(c.normal));
  if (!(c.gap < pose.reach)) return words("a gap of %g is beyond the reach of %g", c.gap, pose.reach);
  const double room = std::abs(c.gap) + kGapError * pose.size;
  const auto outside = [&](std::size_t i, const Pose& placed) {
    return !contains(expanded(bounds(shapes, shapes.primitives()[i], {}), room), transform_back(placed, c.point));
  };
  if (outside(0, pose.pose_a) || outside(1, pose.pose_b)) return "a contact lies outside of the solids";
  return {};
}

/// The angle to the normal of the part with the least gap [degree].
double off(const Vec3& n, const NarrowPhasePose& pose) {
  const Vec3& truth = std::ranges::min_element(pose.truth, {}, &ReferenceGap::gap)->normal;
  return std::atan2(norm(cross(n, truth)), dot(n, truth)) * 57.29577951308232;
}

/// Whether a normal is that of some part whose gap is the least.
bool is_true_normal(const Vec3& n, const NarrowPhasePose& pose) {
  for (std::size_t i = 0; i < pose.truth.size(); ++i) {
    const ReferenceGap& truth = pose.truth[i];
    if (truth.gap > pose.gap + kGapError * pose.size) continue;
    if (norm(cross(n, truth.normal)) < kOneDegree && dot(n, truth.normal) > 0.0) return true;
    const ReferenceSolid& a = pose.parts_a[i / pose.parts_b.size()];
    const ReferenceSolid& b = pose.parts_b[i % pose.parts_b.size()];
    if (separation_along(a, b, n) > truth.gap - kShownError * pose.size) return true;
  }
  return false;
}

}  // namespace

bool is_declared_exception(const NarrowPhaseCase& phase, int trial) {
  struct Exception {
    const char* phase;
    ShapeKind a, b;
    int trial;
  };
  // The tip of a cone through a facet: libccd's depth is refused, and the best climb out of the facet is none of the mesh.
  constexpr std::array<Exception, 1> kExceptions{{{"fcl", ShapeKind::cone, ShapeKind::triangle_mesh, 1695}}};
  return std::ranges::any_of(kExceptions, [&](const Exception& e) {
    return phase.name == e.phase && phase.a == e.a && phase.b == e.b && trial == e.trial;
  });
}

std::string fault_of(NarrowPhase& phase, const NarrowPhasePose& pose) {
  PairScene scene{pose.a, pose.b};
  const ContactBuffer contacts = scene.collide(phase, pose.pose_a, pose.pose_b, pose.reach);
  for (const Contact& c : contacts) {
    std::string fault = fault_of_contact(c, pose, scene.shapes());
    if (!fault.empty()) return fault;
  }
  if (!std::ranges::is_sorted(contacts, std::less_equal{}, &Contact::feature)) return "features do not increase";
  const double slack = kGapError * pose.size;
  if (contacts.empty()) {
    return pose.gap < pose.reach - slack ? words("no contact within the reach of %g", pose.reach) : "";
  }
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::gap);
  if (!(std::abs(deepest->gap - pose.gap) <= slack)) {
    return words("the gap is %g sizes, the normal %g degrees off", deepest->gap / pose.size,
                 off(deepest->normal, pose));
  }
  // A mesh may give several contacts as deep, each of another facet.
  const auto explains = [&](const Contact& c) {
    return c.gap < deepest->gap + slack && is_true_normal(c.normal, pose);
  };
  if (std::ranges::any_of(contacts, explains)) return {};
  return words("the normal is %g degrees off, the gap %g sizes", off(deepest->normal, pose), deepest->gap / pose.size);
}

}  // namespace scree::test
