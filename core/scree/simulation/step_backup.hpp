// StepBackup: what a step changes of the bodies, kept before it does, so that a step that fails can be undone.
#pragma once

#include <vector>

#include "scree/base/uninitialised.hpp"
#include "scree/math/quat.hpp"
#include "scree/math/vec3.hpp"

namespace scree {

class BodyStore;
class Executor;

class StepBackup {
 public:
  /// Poses, velocities and attributes as they are.
  void keep(const BodyStore& bodies, const Executor& executor);
  [[nodiscard]] bool kept() const { return kept_; }
  void restore(BodyStore& bodies) const;  ///< nothing, if nothing was kept in this step
  void forget() { kept_ = false; }        ///< for the next step
  /// The same; in large scenes the memory goes to what the next step needs before it keeps anything.
  void release_memory();

 private:
  bool kept_ = false;  // in this step
  UninitialisedVector<Vec3> position_, velocity_, angular_velocity_;
  UninitialisedVector<Quat> orientation_;
  std::vector<UninitialisedVector<double>> attributes_;
};

}  // namespace scree
