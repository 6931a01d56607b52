// PhaseTrial: one broad phase and one chain of narrow phases on the bodies of one moment, timed and compared.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scree/collision/collision_pipeline.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/model/body_store.hpp"

namespace scree {

/// The bodies that phases are tried on.
struct PhaseScene {
  const ShapeSet* shapes = nullptr;
  BodyStore bodies;
  CollisionFilter filter;
  double dt = 0.0;  ///< [s]
};

/// Which phases.
struct PhaseNames {
  std::string broad;
  std::vector<std::string> chain;  ///< narrow phases, in the order asked

  [[nodiscard]] std::string narrow() const;  ///< "a+b"
};

/// How contacts differ from those of a reference, by pairs of primitives.
struct ContactDifference {
  std::size_t missed = 0;     ///< pairs that overlap in the reference and have no contact here
  std::size_t extra = 0;      ///< the other way round
  double gap = 0.0;           ///< largest difference of the deepest gap, in radii of the smaller body [1]
  double normal_angle = 0.0;  ///< largest angle between the normals of the deepest contacts [rad]
};

/// What came out.
struct PhaseTrial {
  PhaseNames names;
  CollisionCounts counts;
  double first_frame = 0.0;  ///< with empty memory [s]
  double frame = 0.0;        ///< fastest of the following ones, in which bodies move by one step [s]
  std::uint64_t fallbacks = 0;
  std::vector<Contact> contacts;
  ContactDifference difference;
};

/// Times `frames` frames, at least one: bodies go one step forth and back, so that phases which follow them have work, and end
/// where they began. @throws Error (usage) for a name that no plugin has, and for kinds that the chain does not support.
[[nodiscard]] PhaseTrial try_phases(const PluginCatalog& catalog, const PhaseNames& names, PhaseScene& scene,
                                    int frames, const Executor& executor);

/// Differences of `contacts` from `reference`, both sorted as the pipeline sorts. Pairs that overlap by less than 1e-6 of the
/// smaller radius in one of the two are not missed by the other.
[[nodiscard]] ContactDifference difference_of(std::span<const Contact> contacts, std::span<const Contact> reference,
                                              const BodyView& bodies);

}  // namespace scree
