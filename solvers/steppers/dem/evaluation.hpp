// Evaluation: what all contacts share when forces are asked for, and how much of a step a contact acts.
#pragma once

#include <algorithm>
#include <cmath>
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
};

/// How far ahead the springs of a contact are to be carried, and how much of what the kick assumes it acts. Numbers throughout,
/// 1 for yes and 0 for no, so that loops over lanes stay such.
struct Acting {
  double ahead = 0.0;    ///< ContactBatch::ahead [s]
  double part = 1.0;     ///< [1]
  double leaving = 0.0;  ///< 1: the force stands for all of the time until the next evaluation
  double shift = 0.0;    ///< from the overlap now to its mean over the time that the force stands for [m]
};

/// What the evaluation before says of a contact.
struct Earlier {
  double is_new = 1.0;   ///< 1: it was not there
  double leaving = 0.0;  ///< Acting::leaving
};

/// A force of an evaluation stands for half a step on either side of it where the contact lasts so long; for the whole time
/// since the surfaces met where the contact is new; and, where they may part before the evaluation after the next, for all of
/// the time until they part or that next one, which then does not look back. Over that time the law sees the mean overlap.
/// Without this, a dashpot, whose force jumps when surfaces meet, is right to first order in the step only; with the overlap of
/// the evaluation itself, springs would push for longer than they are compressed, and elastic impacts gain energy. Without
/// branches, for loops over lanes.
class ContactTiming {
 public:
  explicit ContactTiming(const Evaluation& e)
      : h_{e.h},
        half_{0.5 * e.h},
        old_ahead_{e.stage == Stage::first ? -0.5 * e.last_h : 0.5 * e.h},
        new_ahead_{e.stage == Stage::first ? 0.0 : 1.0},
        of_before_{e.stage == Stage::first  ? 0.0
                   : e.stage == Stage::last ? 2.0 / e.h
                                            : 1.0 / e.h},
        of_after_{e.stage == Stage::last    ? 0.0
                  : e.stage == Stage::first ? 2.0 / e.h
                                            : 1.0 / e.h},
        judges_{e.stage == Stage::last ? 0.0 : 1.0},
        begins_{e.stage == Stage::first ? 1.0 : 0.0},
        looks_ahead_{e.stage == Stage::last ? 0.0 : 0.5},
        // A neck acts beyond the surfaces, and begins and ends when the law says so.
        whole_{e.reach > 0.0 ? 1.0 : 0.0} {}

  /// Of a contact that closes with `approach` [m/s].
  [[nodiscard]] Acting of(Earlier earlier, double overlap, double approach) const {
    const double way = h_ * std::abs(approach), closed = std::max(overlap, 0.0);
    const double time = closed < way ? h_ * (closed / way) : h_;  // to cover the overlap, at most a step
    // A step begins where the one before has just asked: nothing is new but what was there from the start.
    const double since = begins_ != 0.0 ? half_ : approach > 0.0 ? time : h_;
    const double leaving = approach < 0.0 && closed < 2.0 * way ? 1.0 : 0.0;
    const double before = earlier.is_new != 0.0 ? since : (1.0 - earlier.leaving) * half_;
    const double after = leaving != 0.0 ? time : half_;
    const double part = of_before_ * before + of_after_ * after;
    const double later = looks_ahead_ * (after - half_) - 0.5 * (before - half_);  // middle of that time, from now
    return {earlier.is_new != 0.0 ? new_ahead_ * since : old_ahead_, whole_ + (1.0 - whole_) * part,
            judges_ != 0.0 ? leaving : (1.0 - earlier.is_new) * earlier.leaving, (1.0 - whole_) * later * approach};
  }

 private:
  double h_, half_, old_ahead_, new_ahead_, of_before_, of_after_, judges_, begins_, looks_ahead_, whole_;
};

/// Part of the step that the impulse of an evaluation's force belongs to [s].
inline double kick_time(const Evaluation& e) { return e.stage == Stage::middle ? e.h : 0.5 * e.h; }

}  // namespace scree::dem
