// The part of CollisionPipeline that looks for the walls of a few bodies, at velocities that were not known when all contacts of
// the step were sought.
#include <algorithm>
#include <tuple>

#include "scree/collision/collision_pipeline.hpp"

namespace scree {

void PartOfScene::take(const BodyView& bodies, std::span<const BodyIndex> movable, std::span<const Vec3> velocity,
                       std::span<const Vec3> angular_velocity) {
  index_.assign(movable.begin(), movable.end());
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] != Motion::dynamic) index_.push_back(i);
  }
  std::ranges::sort(index_);
  const auto pick = [this](const auto& from, auto& to) {
    to.clear();
    for (const BodyIndex i : index_) to.push_back(from[i]);
  };
  pick(bodies.id, id_);
  pick(bodies.motion, motion_);
  pick(bodies.shape, shape_);
  pick(bodies.position, position_);
  pick(bodies.orientation, orientation_);
  pick(velocity, velocity_);
  pick(angular_velocity, spin_);
  group_.clear();
  if (!bodies.collision_group.empty()) pick(bodies.collision_group, group_);
}

BodyView PartOfScene::view() const {
  BodyView view;
  view.id = id_;
  view.motion = motion_;
  view.shape = shape_;
  view.position = position_;
  view.orientation = orientation_;
  view.collision_group = group_;
  return view;
}

std::span<const Contact> CollisionPipeline::find_walls(const BodyView& bodies, std::span<const BodyIndex> few,
                                                       std::span<const Vec3> velocity,
                                                       std::span<const Vec3> angular_velocity, double dt) {
  part_.take(bodies, few, velocity, angular_velocity);
  rule_ = {.dt = dt, .slack = settings_.reach_slack};
  place_colliders(part_.view(), part_.velocity(), part_.angular_velocity());
  const ColliderView view = colliders_.view();
  wall_pairs_.clear();
  for (ColliderIndex i = 0; i < view.size(); ++i) {
    for (ColliderIndex wall = 0; view.movable[i] != 0 && wall < view.size(); ++wall) {
      if (view.movable[wall] != 0) continue;
      const CandidatePair pair{std::min(i, wall), std::max(i, wall)};
      double reach = 0.0;
      if (meet(pair, reach)) wall_pairs_.push_back({pair.a, pair.b, reach});
    }
  }
  std::ranges::sort(wall_pairs_, {}, [&](const ColliderPair& p) {
    return std::tuple{view.body[p.a], view.body[p.b], p.a, p.b};
  });
  wall_contacts_.clear();
  collide(wall_pairs_, wall_contacts_);
  for (Contact& c : wall_contacts_) {
    c.a = part_.index(c.a);
    c.b = part_.index(c.b);
  }
  if (large_) colliders_.release_step();
  return wall_contacts_;
}

}  // namespace scree
