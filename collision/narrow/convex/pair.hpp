// ConvexPhase::Pair: what is known of two colliders while their contacts are found.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "convex_phase.hpp"
#include "manifold.hpp"

namespace scree::convex {

/// Bits of a feature that tell the points of two parts apart.
inline constexpr unsigned kPartShift = 16;

/// One pair of colliders while its contacts are found.
struct ConvexPhase::Pair {
  const ColliderView& colliders;
  ColliderPair pair;
  ContactBuffer& out;
  std::uint32_t a, b;  // primitives
  double size = 1.0;   // [m]: what is 1 in the pair's frame
  Vec3 origin;         // of the pair's frame [m], world
  double reach = 0.0;  // [size of the pair]
  bool fell_back = false;
  std::size_t begin = 0;  // of its contacts in `out`
  // Parts that overlap in a way that is not the mesh's own, in case no other one holds the two apart: their hulls do then.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> orphans{};
  std::vector<std::uint32_t> parts_a, parts_b;
  std::vector<ManifoldPoint> points;

  void add(std::uint64_t feature, const Vec3& point, const Vec3& normal, double gap) const {
    out.push_back({colliders.body[pair.a], colliders.body[pair.b], colliders.ordinal[pair.a], colliders.ordinal[pair.b],
                   feature, origin + size * point, normal, size * gap});
  }
};

}  // namespace scree::convex
