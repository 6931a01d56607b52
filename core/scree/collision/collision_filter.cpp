#include "scree/collision/collision_filter.hpp"

#include <algorithm>

#include "scree/base/require.hpp"

namespace scree {

void CollisionFilter::set_groups_meet(CollisionGroup a, CollisionGroup b, bool meet) {
  SCREE_REQUIRE(a < kMostGroups && b < kMostGroups, "a collision filter knows 32 groups");
  ++version_;
  const auto set = [meet](std::uint32_t& mask, CollisionGroup group) {
    const std::uint32_t bit = std::uint32_t{1} << group;
    mask = meet ? mask | bit : mask & ~bit;
  };
  set(mask_[a], b);
  set(mask_[b], a);
  groups_differ_ = std::ranges::any_of(mask_, [](std::uint32_t mask) { return mask != ~std::uint32_t{0}; });
}

void CollisionFilter::exclude(BodyId a, BodyId b) {
  ++version_;
  const std::pair<BodyId, BodyId> pair = std::minmax(a, b);
  const auto at = std::ranges::lower_bound(excluded_, pair, {}, &Exclusion::pair);
  if (at != excluded_.end() && at->pair == pair) {
    ++at->count;
  } else {
    excluded_.insert(at, {pair, 1});
  }
}

void CollisionFilter::admit(BodyId a, BodyId b) {
  ++version_;
  const std::pair<BodyId, BodyId> pair = std::minmax(a, b);
  const auto at = std::ranges::lower_bound(excluded_, pair, {}, &Exclusion::pair);
  SCREE_REQUIRE(at != excluded_.end() && at->pair == pair, "a pair is admitted that was not excluded");
  if (--at->count == 0) excluded_.erase(at);
}

void CollisionFilter::look_up(const BodyView& bodies) {
  records_.assign(bodies.size(), {});
  for (std::size_t i = 0; i < bodies.collision_group.size(); ++i) records_[i].group = bodies.collision_group[i];
  excluded_at_.clear();
  const auto index = [&](BodyId id) {
    const auto at = std::ranges::lower_bound(bodies.id, id);
    return at != bodies.id.end() && *at == id ? at - bodies.id.begin() : -1;
  };
  for (const Exclusion& exclusion : excluded_) {
    const auto a = index(exclusion.pair.first), b = index(exclusion.pair.second);
    if (a < 0 || b < 0) continue;
    records_[static_cast<std::size_t>(a)].listed = records_[static_cast<std::size_t>(b)].listed = true;
    excluded_at_.emplace_back(static_cast<BodyIndex>(a), static_cast<BodyIndex>(b));
  }
}

bool CollisionFilter::is_excluded(BodyIndex a, BodyIndex b) const {
  return std::ranges::binary_search(excluded_at_, std::pair{std::min(a, b), std::max(a, b)});
}

}  // namespace scree
