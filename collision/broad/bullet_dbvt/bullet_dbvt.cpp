#include "bullet_dbvt.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

// Bullet's own filter: immovable boxes do not ask for each other.
constexpr int kMovable = 1;
constexpr int kImmovable = 2;

/// The index of a box travels with Bullet's proxy as its client pointer, which nobody follows.
void* to_pointer(std::uint32_t index) { return reinterpret_cast<void*>(std::uintptr_t{index}); }
std::uint32_t to_index(const void* pointer) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uintptr_t>(pointer));
}

}  // namespace

/// Bullet's trees and what is in them, by key. Proxies belong to `phase`.
struct BulletDbvt::World {
  struct Entry {
    std::uint64_t key;
    btBroadphaseProxy* proxy;
  };

  explicit World(double unit) : scale{1.0 / unit} { phase.setVelocityPrediction(0); }
  ~World() {
    for (const Entry& entry : entries) phase.destroyProxy(entry.proxy, nullptr);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  [[nodiscard]] btVector3 scaled(const Vec3& v) const { return {v.x * scale, v.y * scale, v.z * scale}; }
  btBroadphaseProxy* add(const Aabb& box, bool movable) {
    return phase.createProxy(scaled(box.lower), scaled(box.upper), 0, nullptr, movable ? kMovable : kImmovable,
                             movable ? kMovable | kImmovable : kMovable, nullptr);
  }

  double scale;  ///< Bullet's units in a metre
  btDbvtBroadphase phase;
  std::vector<Entry> entries;  ///< by key
  std::vector<Entry> merged;
};

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
  if (world_ != nullptr && unit * world_->scale < 2.0 && unit * world_->scale > 0.5) return;
  world_ = std::make_unique<World>(unit);
}

void BulletDbvt::update(const BoxView& boxes) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (!std::is_sorted(boxes.key.begin(), boxes.key.end())) {
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t l, std::uint32_t r) { return boxes.key[l] < boxes.key[r]; });
  }
  // Old and new keys side by side, both increasing.
  World& world = *world_;
  world.merged.clear();
  auto old = world.entries.begin();
  const auto drop = [&] { world.phase.destroyProxy((old++)->proxy, nullptr); };
  for (const std::uint32_t i : order_) {
    const bool movable = boxes.movable[i] != 0;
    while (old != world.entries.end() && old->key < boxes.key[i]) drop();
    btBroadphaseProxy* proxy = nullptr;
    if (old != world.entries.end() && old->key == boxes.key[i]) {
      if ((old->proxy->m_collisionFilterGroup == kMovable) == movable) {
        proxy = (old++)->proxy;
        world.phase.setAabb(proxy, world.scaled(boxes.box[i].lower), world.scaled(boxes.box[i].upper), nullptr);
      } else {
        drop();
      }
    }
    if (proxy == nullptr) proxy = world.add(boxes.box[i], movable);
    proxy->m_clientObject = to_pointer(i);
    world.merged.push_back({boxes.key[i], proxy});
  }
  while (old != world.entries.end()) drop();
  world.entries.swap(world.merged);
}

void BulletDbvt::find_pairs(const BoxView& boxes, const Executor& /*executor*/, std::vector<CandidatePair>& out) {
  if (boxes.size() == 0) {
    world_.reset();
    return;
  }
  choose_scale(boxes);
  update(boxes);
  world_->phase.calculateOverlappingPairs(nullptr);
  const btBroadphasePairArray& pairs = world_->phase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int k = 0; k < pairs.size(); ++k) {
    const std::uint32_t a = to_index(pairs[k].m_pProxy0->m_clientObject);
    const std::uint32_t b = to_index(pairs[k].m_pProxy1->m_clientObject);
    // Bullet keeps pairs of enlarged boxes, and for some steps those that have parted.
    if (boxes.owner[a] != boxes.owner[b] && overlap(boxes.box[a], boxes.box[b])) out.push_back({a, b});
  }
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
