// The check of a CollisionPipeline that every two kinds which may meet are somebody's.
#include "scree/collision/collider_kind.hpp"
#include "scree/collision/collision_pipeline.hpp"

namespace scree {
namespace {

using collider_kind::index;
using collider_kind::kKinds;
using collider_kind::unsupported;

/// Which bodies have a kind of primitive: none, one or several.
struct Holders {
  std::size_t first = 0;
  int count = 0;  // of different bodies, up to two

  void add(std::size_t body) {
    if (count == 0) first = body;
    if (count == 0 || (count == 1 && body != first)) ++count;
  }
};

/// True when a body of `a` and another one of `b` exist.
bool can_differ(const Holders& a, const Holders& b) {
  return a.count > 0 && b.count > 0 && (a.count > 1 || b.count > 1 || a.first != b.first);
}

}  // namespace

void CollisionPipeline::check_support(const BodyView& bodies) const {
  // By kind and by group; without groups all bodies are in the first one.
  using ByGroup = std::array<Holders, CollisionFilter::kMostGroups>;
  std::array<ByGroup, kKinds> present{};
  std::array<ByGroup, kKinds> moving{};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const Primitive& primitive : shapes_.primitives(shapes_.shapes()[bodies.shape[i]])) {
      if (!primitive.collides) continue;
      const CollisionGroup group = bodies.collision_group.empty() ? CollisionGroup{0} : bodies.collision_group[i];
      present[index(primitive)][group].add(i);
      if (bodies.motion[i] == Motion::dynamic) moving[index(primitive)][group].add(i);
    }
  }
  const auto can_meet = [&](std::size_t a, std::size_t b) {
    for (CollisionGroup g = 0; g < CollisionFilter::kMostGroups; ++g) {
      for (CollisionGroup h = 0; moving[a][g].count > 0 && h < CollisionFilter::kMostGroups; ++h) {
        if (filter_.groups_meet(g, h) && can_differ(moving[a][g], present[b][h])) return true;
      }
    }
    return false;
  };
  for (std::size_t a = 0; a < kKinds; ++a) {
    for (std::size_t b = 0; b < kKinds; ++b) {
      // Planes never meet planes: both are half spaces without an edge.
      const bool planes = a == index(ShapeKind::plane) && b == index(ShapeKind::plane);
      if (phase_[a][b] < 0 && !planes && can_meet(a, b)) throw unsupported(a, b);
    }
  }
}

}  // namespace scree
