// Pairs of solids and poses for judging narrow phases: every kind, sizes over five decades, and all the ways to meet.
#pragma once

#include <string>
#include <vector>

#include "conformance/narrow_phase_reference.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {

/// A solid of a kind, no larger than `size` [m] and not much smaller. A mesh is the surface of a hull.
[[nodiscard]] PrimitiveData random_solid(ShapeKind kind, double size, RandomNumbers& random);

/// How two solids meet.
enum class Meeting { shallow, deep, touching, apart, parallel_faces, parallel_edges, concentric, anywhere };
inline constexpr int kMeetings = 8;
[[nodiscard]] const char* to_string(Meeting meeting);

/// Two solids at their poses, and what is true of them.
struct NarrowPhasePose {
  PrimitiveData a, b;
  Pose pose_a, pose_b;
  double size = 0.0;   ///< of the smaller one [m]
  double reach = 0.0;  ///< [m]
  /// Of each part of a with each part of b; the least gap is the pair's.
  std::vector<ReferenceGap> truth;
  std::vector<ReferenceSolid> parts_a, parts_b;
  double gap = 0.0;  ///< the least [m]
  std::string description;
};

/// The pose number `trial` of two kinds: the same in every run.
[[nodiscard]] NarrowPhasePose narrow_phase_pose(ShapeKind a, ShapeKind b, int trial);

}  // namespace scree::test
