// Gravity: the same acceleration for every body.
//
//     F = m g,   U = - sum m g . x      [T]
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/force_field.hpp"

namespace scree {

/// Uniform gravity in any direction.
class Gravity final : public ForceField {
 public:
  explicit Gravity(const Options& options);
  static std::vector<Parameter> parameters();

  void add_forces(const BodyView& bodies, double time, WrenchView out) const override;
  [[nodiscard]] bool is_steady() const override { return true; }
  [[nodiscard]] bool is_conservative() const override { return true; }
  /// [J]; zero for bodies at the world's origin.
  [[nodiscard]] double potential_energy(const BodyView& bodies, double time) const override;

 private:
  Vec3 acceleration_;  ///< [m/s2], world
};

}  // namespace scree
