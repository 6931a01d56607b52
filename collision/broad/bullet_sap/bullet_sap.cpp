#include "bullet_sap.hpp"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>

#include <algorithm>

#include "bullet_proxies.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

/// Boxes that the 16-bit form takes, and steps of its grid along an axis.
constexpr std::size_t kFewBoxes = 16000;
constexpr double kCoarseSteps = 65000.0;
/// The 16-bit form is used while an average box is this many steps of the grid long.
constexpr double kStepsPerBox = 32.0;

Aabb bounds_of(const BoxView& boxes) {
  Aabb all = boxes.box[0];
  for (const Aabb& box : boxes.box) all = merged(all, box);
  return all;
}

double longest(const Aabb& box) {
  const Vec3 extent = box.upper - box.lower;
  return std::max({extent.x, extent.y, extent.z});
}

bool holds(const Aabb& outer, const Aabb& inner) {
  return outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y && outer.lower.z <= inner.lower.z &&
         outer.upper.x >= inner.upper.x && outer.upper.y >= inner.upper.y && outer.upper.z >= inner.upper.z;
}

}  // namespace

BulletSap::BulletSap() = default;
BulletSap::~BulletSap() = default;

void BulletSap::make_room(const BoxView& boxes) {
  const Aabb bounds = bounds_of(boxes);
  // Much less room than the lists have is as bad as none: their grid would be too coarse.
  const bool fits = proxies_ != nullptr && boxes.size() <= capacity_ && holds(world_, bounds) &&
                    longest(world_) <= 8.0 * longest(bounds);
  if (fits) return;
  const double extent = longest(bounds);
  const double margin = extent > 0.0 ? 0.5 * extent : 1.0;
  world_ = {bounds.lower - Vec3{margin, margin, margin}, bounds.upper + Vec3{margin, margin, margin}};
  capacity_ = boxes.size() + boxes.size() / 2 + 64;
  double sum = 0.0;
  for (const Aabb& box : boxes.box) sum += longest(box);
  const double mean = sum / static_cast<double>(boxes.size());
  const bool few = capacity_ <= kFewBoxes && mean / longest(world_) * kCoarseSteps >= kStepsPerBox;
  proxies_.reset();
  const Vec3 size = world_.upper - world_.lower;
  const btVector3 lower{0, 0, 0}, upper{size.x, size.y, size.z};
  std::unique_ptr<btBroadphaseInterface> phase;
  if (few) {
    phase = std::make_unique<btAxisSweep3>(lower, upper, static_cast<unsigned short>(capacity_), nullptr, true);
  } else {
    phase = std::make_unique<bt32BitAxisSweep3>(lower, upper, static_cast<unsigned>(capacity_), nullptr, true);
  }
  proxies_ = std::make_unique<BulletProxies>(std::move(phase), world_.lower, 1.0, true);
}

void BulletSap::find_pairs(const BoxView& boxes, const Executor& /*executor*/, std::vector<CandidatePair>& out) {
  if (boxes.size() == 0) {
    proxies_.reset();
    return;
  }
  make_room(boxes);
  proxies_->find_pairs(boxes, out);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::BulletSap>("bullet_sap",
                                                   "Bullet's sweep and prune along three axes, kept between steps.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("bullet_sap", "1.0.0", &list)};
