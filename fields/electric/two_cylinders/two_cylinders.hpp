// TwoCylinders: the electrostatic field between a grounded roll and a parallel cylindrical electrode, in free space and
// without space charge. Exact solution of Laplace's equation in the plane (bipolar coordinates).
//
// Glossary, lengths in m:
//     R1, R2   radius of the roll and of the electrode        L       distance of their axes
//     alpha    angle of the line from roll to electrode, counter-clockwise from x seen from +z
//     U        potential of the electrode [V]; the roll is at 0
//     X, Y     in the frame of the roll's axis, X along the line of centres:
//                 X = x cos alpha + y sin alpha,   Y = y cos alpha - x sin alpha
//     h1, h2   distances of the axes from the plane of symmetry of the equivalent line charges
//     j        distance of those line charges from that plane
//
//     h1 = (L^2 + R1^2 - R2^2) / 2L,   h2 = L - h1,   j = sqrt(h1^2 - R1^2)
//     f  = U / ln{ (h1 + j - R1)(h2 + j - R2) / [ (R1 + j - h1)(R2 + j - h2) ] }
//     ra = (j - h1 + X)^2 + Y^2,   rb = (j + h1 - X)^2 + Y^2
//     V  = f { 1/2 ln(ra / rb) + ln[ (h1 + j - R1) / (R1 + j - h1) ] }
//     E_X = -f [ (j - h1 + X)/ra + (j + h1 - X)/rb ],   E_Y = -f [ Y/ra - Y/rb ],   then rotated back by alpha
//
// Inside a conductor the field is zero and the potential is the conductor's. Source: Critelli, Tasora, Degiorgi,
// Colledani, "Particle Simulation of Granular Flows in Electrostatic Separation Processes", derived again and checked
// with finite elements.
//
// A side envelope g(z) scales field and potential alike, so that E = -grad V holds in every plane of constant z. The axial
// component -V g'(z) of that gradient is left out: E_z = 0, and E has no potential near the sides.
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "side_envelope.hpp"

namespace scree {

/// The field of a roll-type electrostatic separator. The axis of the roll is z.
class TwoCylinders final : public ElectricField {
 public:
  /// @throws Error (usage) when roll and electrode touch or overlap.
  explicit TwoCylinders(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void evaluate(std::span<const Vec3> position, double time, std::span<Vec3> field,
                std::span<double> potential) const override;

 private:
  /// A point relative to the roll's axis, in the frame of the line of centres, and what all formulas share.
  struct Local {
    double along_a, along_b;  ///< j - h1 + X and j + h1 - X [m]
    double y;                 ///< Y [m]
    double ra, rb;            ///< squared distances from the line charges [m2]
    bool in_roll, in_electrode;
  };
  [[nodiscard]] Local to_local(const Vec3& position) const;
  [[nodiscard]] Vec3 field_at(const Local& local) const;
  [[nodiscard]] double potential_at(const Local& local) const;

  double roll_radius_;       ///< R1 [m]
  double electrode_radius_;  ///< R2 [m]
  double distance_;          ///< L [m]
  double voltage_;           ///< U [V]
  Vec3 centre_;              ///< a point of the roll's axis in the middle of the machine [m], world
  double cos_angle_, sin_angle_;
  double h1_, h2_, j_;  ///< [m]
  double factor_;       ///< f [V]
  double constant_;     ///< second logarithm of V [1]
  SideEnvelope envelope_;
};

}  // namespace scree
