#include <ccd/ccd.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>

#include <exception>
#include <limits>

#include "fcl_phase.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

constexpr unsigned kMaxIterations = 500;
constexpr double kTolerance = 1e-6;  // [size of the pair]
/// libccd's EPA has no limit of its own: once it has asked so often, it is told that there is nothing beyond.
constexpr int kMaxQuestions = 300;

/// A solid as libccd asks for it.
struct FclShape {
  const convex::ConvexSolid* solid;
  double round;
  int questions = 0;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  auto* shape = static_cast<FclShape*>(const_cast<void*>(object));  // ours, and not constant
  if (++shape->questions > kMaxQuestions) {
    ccdVec3Set(out, 0.0, 0.0, 0.0);
    return;
  }
  const Vec3 d{direction->v[0], direction->v[1], direction->v[2]};
  Vec3 point = convex::core_support(*shape->solid, d);
  if (shape->round > 0.0) point += shape->round * normalized(d);
  ccdVec3Set(out, point.x, point.y, point.z);
}

Vec3 from_fcl(const fcl::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Nothing known.
convex::Answer failed() {
  convex::Answer answer;
  answer.distance = std::numeric_limits<double>::quiet_NaN();
  return answer;
}

/// FCL's distance of the cores; nothing where they meet.
convex::Answer ask_distance(const convex::ConvexSolid& solid_a, const convex::ConvexSolid& solid_b) {
  FclShape a{&solid_a, 0.0}, b{&solid_b, 0.0};
  fcl::Vector3d on_a = fcl::Vector3d::Zero(), on_b = fcl::Vector3d::Zero();
  convex::Answer answer = failed();
  double distance = 0.0;
  if (!fcl::detail::GJKDistance<double>(&a, &support, &b, &support, kMaxIterations, kTolerance, &distance, &on_a,
                                        &on_b) ||
      !(distance > 0.0)) {
    return answer;
  }
  answer.distance = distance;
  answer.on_a = from_fcl(on_a);
  answer.on_b = from_fcl(on_b);
  answer.normal = answer.on_b - answer.on_a;
  return answer;
}

/// libccd's depth of the solids. The place that it gives is a mean of corners and not used.
convex::Answer ask_depth(const convex::ConvexSolid& solid_a, const convex::ConvexSolid& solid_b) {
  FclShape a{&solid_a, solid_a.round}, b{&solid_b, solid_b.round};
  ccd_t settings;
  CCD_INIT(&settings);
  settings.support1 = &support;
  settings.support2 = &support;
  settings.max_iterations = kMaxIterations;
  settings.epa_tolerance = kTolerance;
  ccd_real_t depth = 0.0;
  ccd_vec3_t direction, place;
  convex::Answer answer = failed();
  answer.of_cores = false;
  if (ccdGJKPenetration(&a, &b, &settings, &depth, &direction, &place) != 0) return answer;
  answer.distance = -depth;
  answer.normal = {direction.v[0], direction.v[1], direction.v[2]};
  answer.on_a.x = std::numeric_limits<double>::quiet_NaN();
  return answer;
}

}  // namespace

convex::Answer FclNarrowPhase::ask(const convex::ConvexSolid& a, const convex::ConvexSolid& b) const {
  try {
    const convex::Answer apart = ask_distance(a, b);
    return apart.distance > 0.0 ? apart : ask_depth(a, b);
  } catch (const std::exception&) {  // FCL throws where its simplex degenerates
    return failed();
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::NarrowPhase, scree::FclNarrowPhase>(
      "fcl",
      "FCL's GJK and libccd's EPA on all kinds; where they fail: the best of climbs over directions. No hollow "
      "cylinders.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("fcl", "1.0.0", &list)};
