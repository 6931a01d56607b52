// MetalCorona: metal grains take their charge from grounded bodies by induction and are pulled by the field.
//
//     Q = s 2/3 pi^3 eps r^2 |E|       held while the grain touches a grounded body           (eq. 11)
//     F = 0.832 Q E                    always, also in flight, where Q stays as it is         (eq. 10)
//
//     E     undisturbed field at the grain's centre [V/m]
//     r     radius of the sphere of the grain's volume [m]
//     eps   permittivity of the air, 8.85941e-12 F/m
//     s     sign of E . n, n pointing from the grounded body into the grain
//
// Both are exact for a conducting sphere that touches a plane electrode: Q and the factor
// 0.832 = (zeta(3) + 1/6) / zeta(2). Source: Critelli, Tasora, Degiorgi, Colledani, "Particle Simulation of Granular
// Flows in Electrostatic Separation Processes".
//
// Touching means a normal impulse in the last step, of a push or of a pull by cohesion. With several grounded contacts n is
// the direction of their joint push, in which a pull counts as a push of its size.
//
// Grains that are partly metal: the column `charge_induced` holds `metal_fraction` times Q, and the force follows from
// the column, which makes it `metal_fraction` times the force on metal.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/force_field.hpp"

namespace scree {

class ElectricField;
class Executor;

/// Charge and force of metal grains; writes `charge_induced` [C], reads `metal_fraction` [1].
class MetalCorona final : public ForceField {
 public:
  explicit MetalCorona(const Options& options);
  static std::vector<Parameter> parameters();

  /// @throws Error (usage) when the electric field or a grounded body does not exist.
  void setup(SceneServices& services) override;
  void add_forces(const BodyView& bodies, double time, WrenchView out) const override;
  /// Charges the grains that touch a grounded body. The charges live in the attribute column: there is no state here.
  void advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
               double dt) override;

 private:
  void add_forces_of(const BodyView& bodies, double time, std::size_t first, std::size_t last, WrenchView out) const;
  void find_grounded(const BodyView& bodies);
  void collect_pushes(const BodyView& bodies, const ContactView& contacts);

  std::string field_name_;
  std::vector<std::string> grounded_names_;
  double permittivity_;  ///< of the air [F/m]
  double force_factor_;  ///< [1]

  const ElectricField* field_ = nullptr;
  const Executor* executor_ = nullptr;
  std::vector<BodyId> grounded_;
  AttributeId charge_ = 0;
  AttributeId metal_fraction_ = 0;

  // Workspaces of advance(), kept between steps.
  std::vector<BodyIndex> grounded_index_;
  std::vector<Vec3> push_;           ///< of grounded bodies, per body [N s]; zero between calls
  std::vector<BodyIndex> touching_;  ///< bodies with a push
  std::vector<Vec3> centre_;         ///< of the touching bodies [m]
  std::vector<Vec3> field_there_;    ///< [V/m]
};

}  // namespace scree
