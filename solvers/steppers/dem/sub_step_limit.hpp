// How many sub-steps an outer step may have, and what is said of a scene that asks for more.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "scree/base/error.hpp"
#include "scree/config/options.hpp"
#include "scree/model/material.hpp"

namespace scree::dem {

/// More would not end: a sub-step takes a microsecond at least.
inline constexpr double kMostSubSteps = 1e6;

/// A step that would have too many sub-steps.
struct EndlessStep {
  double dt = 0.0;                          ///< of the outer step [s]
  double count = 0.0;                       ///< sub-steps
  bool asked = false;                       ///< the scene's own sub_step makes them so many; else the stiffest contact
  std::array<std::uint32_t, 2> stiffest{};  ///< its materials
  bool first = true;                        ///< step of the run; later ones diverge
};

/// What to throw. `scene` is the section of the stepper.
inline Error error_of(const EndlessStep& step, const Options& scene, const Materials& materials) {
  char text[160];
  std::snprintf(text, sizeof text,
                "a step of %.4g s would take %.3g sub-steps of %.3g s, more than the %.0e that dem takes", step.dt,
                step.count, step.dt / step.count, kMostSubSteps);
  const std::string cause =
      step.asked ? std::string{"; take a longer `sub_step`, 0 for the longest that is stable, or a shorter time_step"}
                 : ": the contact law calls no longer one stable for '" + materials[step.stiffest[0]].name + "' on '" +
                       materials[step.stiffest[1]].name +
                       "', whose contact is too stiff or too strongly damped for its mass; make it softer or damp it "
                       "less, or set `sub_step` with force_step = true";
  if (!step.first) return Error{ErrorKind::diverged, "time_stepper:dem: " + (text + cause)};
  return scene.error("time_stepper:dem: " + (text + cause));
}

}  // namespace scree::dem
