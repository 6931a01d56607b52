#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>

#include <exception>
#include <limits>

#include "fcl_phase.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

constexpr unsigned kMaxIterations = 500;
constexpr double kTolerance = 1e-6;  // [size of the pair]
/// FCL's EPA has no limit of its own: once it has asked so often, it is told that there is nothing beyond.
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

convex::Answer measure(FclShape a, FclShape b) {
  convex::Answer answer;
  fcl::Vector3d on_a = fcl::Vector3d::Zero(), on_b = fcl::Vector3d::Zero();
  double distance = std::numeric_limits<double>::quiet_NaN();
  fcl::detail::GJKSignedDistance<double>(&a, &support, &b, &support, kMaxIterations, kTolerance, &distance, &on_a,
                                         &on_b);
  answer.on_a = from_fcl(on_a);
  answer.on_b = from_fcl(on_b);
  answer.normal = answer.on_b - answer.on_a;
  answer.distance = distance;
  return answer;
}

}  // namespace

convex::Answer FclNarrowPhase::ask(const convex::ConvexSolid& a, const convex::ConvexSolid& b) const {
  convex::Answer answer;
  answer.distance = std::numeric_limits<double>::quiet_NaN();
  try {
    answer = measure({&a, 0.0}, {&b, 0.0});
    if (a.round + b.round > 0.0 && !(answer.distance > 0.0)) {
      answer = measure({&a, a.round}, {&b, b.round});
      answer.of_cores = false;
    }
  } catch (const std::exception&) {  // FCL throws where its polytope degenerates
    answer.distance = std::numeric_limits<double>::quiet_NaN();
  }
  return answer;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins
      .add<scree::NarrowPhase, scree::FclNarrowPhase>(
          "fcl",
          "FCL's GJK and EPA on all kinds; where they fail: the best of climbs over directions. No hollow cylinders.")
      .default_place = 3;
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("fcl", "1.0.0", &list)};
