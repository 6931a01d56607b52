// EnergyAccount: where the energy of the dynamic bodies is, and where it went.
//
// With T the kinetic energy, from the beginning of the run to any later step,
//
//     T - T0 = force_work + boundary_work + joint_work - contact_loss + fed_kinetic
//
// to rounding, as every step counts an impulse times the mean of the velocities
// before and after it. (Turning a body whose moments differ without the
// gyroscopic torque, dvi's default, changes T by itself and is not counted.) The
// potential energy U belongs to positions: where all fields state one, U + force_work
// stays within h m g |v| / 2 of a body, since positions move with the velocities
// at the end of a step.
#pragma once

#include "scree/interfaces/time_stepper.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// Energies at the end of a step, and what was done since the beginning of the run, restarts included.
struct EnergyAccount {
  double kinetic = 0.0;      ///< of the dynamic bodies, translation and rotation [J]
  double potential = 0.0;    ///< sum over the fields that state one [J]
  StepWork work;             ///< since the beginning of the run
  double fed_kinetic = 0.0;  ///< kinetic energy of what sources added, less that of what sinks took [J]

  /// What a continued run goes on with: everything but the energies of the moment.
  void save(StateWriter& out) const;
  void load(const StateReader& in);
};

}  // namespace scree
