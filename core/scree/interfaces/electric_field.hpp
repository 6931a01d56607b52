// ElectricField: the undisturbed field between the electrodes, which force
// fields look up by name.
#pragma once

#include <span>

#include "scree/interfaces/plugin.hpp"
#include "scree/math/vec3.hpp"

namespace scree {

class SceneServices;

/// Field and potential at many points at once.
class ElectricField : public Plugin {
 public:
  static constexpr const char* kKind = "electric_field";
  ~ElectricField() override;

  virtual void setup(SceneServices& services);

  /// Writes the field [V/m] (world) and the potential [V] at `position` [m]
  /// (world) at `time` [s]. Spans of equal length; `potential` may be empty
  /// when it is not wanted. Inside a conductor the field is zero.
  virtual void evaluate(std::span<const Vec3> position, double time, std::span<Vec3> field,
                        std::span<double> potential) const = 0;
};

}  // namespace scree
