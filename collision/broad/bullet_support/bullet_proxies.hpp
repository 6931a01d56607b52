// BulletProxies: the boxes of a step as proxies of a Bullet broad phase.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <bit>
#include <memory>
#include <vector>

#include "scree/collision/box_register.hpp"

namespace scree {

/// A Bullet broad phase and what is in it. Bullet's coordinates are (x - origin) * scale.
class BulletProxies {
 public:
  /// `phase` is empty; `origin` [m], `scale` in Bullet's units a metre. `owns_proxies`: it frees its proxies when it is
  /// destroyed itself.
  BulletProxies(std::unique_ptr<btBroadphaseInterface> phase, const Vec3& origin, double scale, bool owns_proxies)
      : phase_{std::move(phase)}, origin_{origin}, scale_{scale}, owns_proxies_{owns_proxies} {}
  ~BulletProxies() {
    // Each proxy that goes walks through all pairs: with the pairs gone first, that costs nothing.
    struct All : btOverlapCallback {
      bool processOverlap(btBroadphasePair&) override { return true; }  // true: drop it
    } all;
    phase_->getOverlappingPairCache()->processAllOverlappingPairs(&all, nullptr);
    if (owns_proxies_) return;
    register_.clear([&](btBroadphaseProxy* proxy) { phase_->destroyProxy(proxy, nullptr); });
  }
  BulletProxies(const BulletProxies&) = delete;
  BulletProxies& operator=(const BulletProxies&) = delete;

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] btVector3 scaled(const Vec3& x) const {
    const Vec3 v = scale_ * (x - origin_);
    return {v.x, v.y, v.z};
  }

  /// Follows the boxes, and appends the pairs that overlap. Bullet keeps pairs of boxes that are larger than ours, and for
  /// some steps those that have parted; they are left out.
  void find_pairs(const BoxView& boxes, std::vector<CandidatePair>& out) {
    register_.update(
        boxes, [&](std::uint32_t i) { return add(boxes, i); },
        [&](btBroadphaseProxy* proxy, std::uint32_t i) {
          phase_->setAabb(proxy, scaled(boxes.box[i].lower), scaled(boxes.box[i].upper), nullptr);
          proxy->m_clientObject = to_pointer(i);
        },
        [&](btBroadphaseProxy* proxy) { phase_->destroyProxy(proxy, nullptr); });
    phase_->calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& pairs = phase_->getOverlappingPairCache()->getOverlappingPairArray();
    for (int k = 0; k < pairs.size(); ++k) {
      const std::uint32_t a = to_index(pairs[k].m_pProxy0->m_clientObject);
      const std::uint32_t b = to_index(pairs[k].m_pProxy1->m_clientObject);
      if (boxes.owner[a] != boxes.owner[b] && overlap(boxes.box[a], boxes.box[b])) out.push_back({a, b});
    }
  }

 private:
  // Bullet's own filter: immovable boxes do not ask for each other.
  static constexpr int kMovable = 1;
  static constexpr int kImmovable = 2;

  /// The index of a box travels with Bullet's proxy as its client pointer, which nobody follows.
  static void* to_pointer(std::uint32_t index) { return reinterpret_cast<void*>(std::uintptr_t{index}); }
  static std::uint32_t to_index(const void* pointer) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uintptr_t>(pointer));
  }

  btBroadphaseProxy* add(const BoxView& boxes, std::uint32_t i) {
    const bool movable = boxes.movable[i] != 0;
    return phase_->createProxy(scaled(boxes.box[i].lower), scaled(boxes.box[i].upper), 0, to_pointer(i),
                               movable ? kMovable : kImmovable, movable ? kMovable | kImmovable : kMovable, nullptr);
  }

  std::unique_ptr<btBroadphaseInterface> phase_;
  Vec3 origin_;
  double scale_;
  bool owns_proxies_;
  BoxRegister<btBroadphaseProxy*> register_;
};

}  // namespace scree
