// TotalCharge: the charge of a body as results report it, the sum of what several fields write.
//
//     charge = charge_induced + charge_corona
//
// Every column has one writer: metal_corona writes the first term, image_force the second, and this part the sum. It
// adds no force.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/force_field.hpp"

namespace scree {

/// Writes the column `charge` [C].
class TotalCharge final : public ForceField {
 public:
  explicit TotalCharge(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void add_forces(const BodyView& bodies, double time, WrenchView out) const override;
  void advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
               double dt) override;

 private:
  std::vector<std::string> names_;
  std::vector<AttributeId> terms_;
  AttributeId charge_ = 0;
};

}  // namespace scree
