// Drag: the resistance of a gas to a sphere of the body's volume.
//
//     u   = v - w                                relative to the wind w       [m/s]
//     Re  = rho |u| 2 r / eta                    Reynolds number              [1]
//     F   = -6 pi eta r u                        law `stokes`                 [T]
//     F   = -6 pi eta r (1 + 0.15 Re^0.687) u    law `schiller_naumann`, Re < 1000
//     F   = -0.5 * 0.44 rho pi r^2 |u| u         law `schiller_naumann`, Re >= 1000
//
// The second line is Cd = 24/Re (1 + 0.15 Re^0.687) written without the division by Re, hence exact at rest
// (Schiller & Naumann 1935).
//
// r is the radius of the volume-equivalent sphere, eta and rho are the gas's. No torque.
//
// Steppers use the force explicitly, at the velocity before the step h. The relative velocity then decays without
// changing its sign while h < m |u| / |F|, and grows without bound beyond twice that. For Stokes' law and a grain
// of density rho_p this is h < 2 rho_p r^2 / (9 eta): 0.26 s for a grain of 946 kg/m3 and 0.15 mm. The law is not bent for larger steps:
// setup() logs the rho_p r^2 above which the scene's step is safe.
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/force_field.hpp"

namespace scree {

class Executor;

/// Gas drag with a uniform wind.
class Drag final : public ForceField {
 public:
  explicit Drag(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void add_forces(const BodyView& bodies, double time, WrenchView out) const override;

 private:
  void add_stokes(const BodyView& bodies, std::size_t first, std::size_t last, WrenchView out) const;
  void add_schiller_naumann(const BodyView& bodies, std::size_t first, std::size_t last, WrenchView out) const;

  bool stokes_;
  double viscosity_;  ///< [Pa s]
  double density_;    ///< [kg/m3]
  Vec3 wind_;         ///< [m/s], world
  const Executor* executor_ = nullptr;
};

}  // namespace scree
