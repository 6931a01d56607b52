// UniformField: the field between two large parallel plates.
//
//     E = constant,   V = - E . (x - origin)      [T]
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/electric_field.hpp"

namespace scree {

/// The same field everywhere.
class UniformField final : public ElectricField {
 public:
  explicit UniformField(const Options& options);
  static std::vector<Parameter> parameters();

  void evaluate(std::span<const Vec3> position, double time, std::span<Vec3> field,
                std::span<double> potential) const override;

 private:
  Vec3 field_;   ///< [V/m], world
  Vec3 origin_;  ///< where the potential is zero [m], world
};

}  // namespace scree
