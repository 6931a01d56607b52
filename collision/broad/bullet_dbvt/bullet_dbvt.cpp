#include "bullet_dbvt.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>

#include "bullet_proxies.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

BulletDbvt::BulletDbvt() = default;
BulletDbvt::~BulletDbvt() = default;

void BulletDbvt::choose_scale(const BoxView& boxes) {
  // Bullet enlarges boxes by 0.05 of its units (gDbvtMargin), which suits objects of size one. So the median box gets
  // that size, and when it changes much the trees are built anew.
  size_.clear();
  for (const Aabb& box : boxes.box) {
    const Vec3 extent = box.upper - box.lower;
    size_.push_back(std::max({extent.x, extent.y, extent.z}));
  }
  const auto middle = size_.begin() + static_cast<std::ptrdiff_t>(size_.size() / 2);
  std::nth_element(size_.begin(), middle, size_.end());
  const double unit = *middle > 0.0 ? *middle : 1.0;
  if (proxies_ != nullptr && unit * proxies_->scale() < 2.0 && unit * proxies_->scale() > 0.5) return;
  auto phase = std::make_unique<btDbvtBroadphase>();
  phase->setVelocityPrediction(0);
  proxies_ = std::make_unique<BulletProxies>(std::move(phase), Vec3{}, 1.0 / unit, false);
}

void BulletDbvt::find_pairs(const BoxView& boxes, const Executor& /*executor*/, std::vector<CandidatePair>& out) {
  if (boxes.size() == 0) {
    proxies_.reset();
    return;
  }
  choose_scale(boxes);
  proxies_->find_pairs(boxes, out);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::BulletDbvt>("bullet_dbvt",
                                                    "Bullet's dynamic bounding volume trees, kept between steps.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("bullet_dbvt", "1.0.0", &list)};
