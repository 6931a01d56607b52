// What a step does to the energy of the bodies.
//
// Glossary: v0, velocities at the beginning of the step; v_f = v0 + h M^-1 f; w = M^-1 D gamma; v1 = v_f +
// w; u = D^T v, as contact_assembly.hpp has it.
//
//     T1 - T0 = (v1 - v0) . M (v0 + v1) / 2 = h f . (v0 + v1) / 2 + gamma . D^T (v0 + v1) / 2
//
// over the dynamic bodies. Where a contact's other body has its own motion, or surfaces move against their bodies
// (surface_motion.hpp), u has a part u_s from that, and
//     contact_loss = - sum gamma . (u0 + u1) / 2,   boundary_work = - sum gamma . u_s.
#pragma once

#include <span>
#include <vector>

#include "contact_assembly.hpp"
#include "scree/interfaces/time_stepper.hpp"

namespace scree::dvi {

/// Answer of a step, in terms of the bodies and contacts of `assembly`.
struct StepAnswer {
  std::span<const Twist> w;               ///< per body of the problem [m/s], [rad/s]
  std::span<const Vec3> impulse;          ///< per contact [N s], its frame
  std::span<const Vec3> angular_impulse;  ///< per contact [N m s], its frame; empty for none
};

/// The work of a step. `motion`: v_f, and the bodies before they move. `partial` is workspace.
[[nodiscard]] StepWork step_work(const FreeMotion& motion, const ContactAssembly& assembly, const StepAnswer& answer,
                                 const Executor& executor, std::vector<StepWork>& partial);

}  // namespace scree::dvi
