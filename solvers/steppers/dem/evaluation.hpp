// Evaluation: what all contacts share when forces are asked for, and how much of a step a contact acts.
#pragma once

#include <algorithm>
#include <cstddef>

#include "scree/interfaces/contact_law.hpp"
#include "verlet.hpp"

namespace scree::dem {

/// One evaluation of all contact forces.
struct Evaluation {
  const ContactLaw* law = nullptr;
  Stage stage = Stage::middle;
  double h = 0.0;       ///< sub-step [s]
  double last_h = 0.0;  ///< that of the step before, to which springs were carried ahead [s]
  double reach = 0.0;   ///< of the law [m]
  std::size_t materials = 0;
  bool at_contact_point =
      false;                ///< forces act where the surfaces meet, in place of at each body's own undeformed surface
  std::size_t history = 0;  ///< doubles that the law keeps
  bool rolls = false;       ///< the law resists rolling

  /// ContactBatch::ahead of a contact: `since` the surfaces met, where it is new [s].
  [[nodiscard]] double ahead(bool is_new, double since) const {
    if (is_new) return stage == Stage::first ? 0.0 : since;
    return stage == Stage::first ? -0.5 * last_h : 0.5 * h;
  }
};

/// Time since the surfaces met, of a new contact that closes with `approach` [m/s]: at most a step [s].
inline double time_since(double overlap, double approach, double h) {
  return overlap < approach * h ? std::max(overlap, 0.0) / approach : h;
}

/// A force of an evaluation stands for half a step on either side of it, where the contact lasts so long; for the whole time
/// since the surfaces met, where the contact is new, and until they part, where that comes within a step. Without this, a
/// dashpot, whose force jumps when surfaces meet, is right to first order in the step only. As a part of what the kick
/// assumes [1].
inline double acting_part(const Evaluation& e, bool is_new, double since, double overlap, double approach) {
  // A neck acts beyond the surfaces, and begins and ends when the law says so.
  if (e.reach > 0.0) return 1.0;
  const double before = is_new ? since : 0.5 * e.h;
  const double after = overlap < -approach * e.h ? std::max(overlap, 0.0) / -approach : 0.5 * e.h;
  switch (e.stage) {
    case Stage::first:
      return after / (0.5 * e.h);
    case Stage::last:
      return before / (0.5 * e.h);
    case Stage::middle:
      break;
  }
  return (before + after) / e.h;
}

/// Part of the step that the impulse of an evaluation's force belongs to [s].
inline double kick_time(const Evaluation& e) { return e.stage == Stage::middle ? e.h : 0.5 * e.h; }

}  // namespace scree::dem
