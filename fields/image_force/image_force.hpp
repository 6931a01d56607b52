// ImageForce: non-metal grains are charged by the corona and held on the roll by the image of their charge.
//
//     |Q| raised to 3 pi eps0 (2r)^2 |E| er/(er + 2)    inside a charging zone, never lowered     (eq. 13)
//     Q = 0                                             inside a discharge zone (a brush)
//     F = Q^2 / (4 pi eps (2r)^2)                       towards the roll's axis, near the roll    (eq. 12)
//
//     E      undisturbed field at the grain's centre [V/m]
//     r      radius of the sphere of the grain's volume [m]
//     er     relative permittivity of the grain [1]
//     eps0   8.8541878128e-12 F/m;  eps of the air, 8.85941e-12 F/m
//
// (13) is Pauthenier's limit, reached at once. Source: Critelli, Tasora, Degiorgi, Colledani, "Particle Simulation of
// Granular Flows in Electrostatic Separation Processes".
//
// The charge has the sign of the corona's ions, which come from the electrode and drift to the roll: negative where the
// field points away from the roll's axis. The force does not depend on it.
//
// Near the roll: the gap distance - R - r is below `reach`, by default one radius r of the grain, and the grain's centre
// lies between the ends of the roll. With `discharge_contact_age`, a grain that has touched the roll without a break for
// longer than that loses its charge once it is outside of the charging zones.
//
// Grains that are partly metal: the column `charge_corona` holds (1 - metal_fraction) times Q, and the force is
// (1 - metal_fraction) times that on non-metal.
#pragma once

#include <string>
#include <vector>

#include "roll.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/force_field.hpp"
#include "zone.hpp"

namespace scree {

class ElectricField;
class Executor;

/// Charge and force of non-metal grains; writes `charge_corona` [C] (and `roll_contact_age` [s] when a discharge by age
/// is asked for), reads `metal_fraction` [1] and `relative_permittivity` [1].
class ImageForce final : public ForceField {
 public:
  explicit ImageForce(const Options& options);
  static std::vector<Parameter> parameters();

  /// @throws Error (usage) when the electric field or the roll does not exist, or the roll has no cylinder.
  void setup(SceneServices& services) override;
  void add_forces(const BodyView& bodies, double time, WrenchView out) const override;
  /// Charges and discharges. All state lives in attribute columns.
  void advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
               double dt) override;

 private:
  void update_contact_age(const BodyView& bodies, const ContactView& contacts, std::span<double> age, double dt);
  void update_charges(const BodyView& bodies, Attributes& attributes, double time, std::size_t first,
                      std::size_t last) const;
  [[nodiscard]] double corona_charge(double radius, double permittivity, double field) const;

  std::string field_name_;
  std::string roll_name_;
  std::vector<Zone> charging_zones_;
  std::vector<Zone> discharge_zones_;
  double vacuum_permittivity_;    ///< eps0 [F/m]
  double air_permittivity_;       ///< eps [F/m]
  double reach_;                  ///< [m]; negative: one radius of the grain
  double discharge_contact_age_;  ///< [s]; negative: never

  const ElectricField* field_ = nullptr;
  const Executor* executor_ = nullptr;
  Roll roll_;
  BodyId roll_id_ = 0;
  AttributeId charge_ = 0;
  AttributeId metal_fraction_ = 0;
  AttributeId permittivity_ = 0;
  AttributeId contact_age_ = 0;
  std::vector<char> touches_roll_;  ///< per body, workspace of advance()
};

}  // namespace scree
