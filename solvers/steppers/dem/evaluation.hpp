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

/// How far ahead the springs of a contact are to be carried, and how much of what the kick assumes it acts.
struct Acting {
  double ahead = 0.0;    ///< ContactBatch::ahead [s]
  double part = 1.0;     ///< [1]
  bool leaving = false;  ///< the force stands for all of the time until the next evaluation
};

/// What the evaluation before says of a contact.
struct Earlier {
  bool is_new = true;    ///< it was not there
  bool leaving = false;  ///< Acting::leaving
};

/// A force of an evaluation stands for half a step on either side of it where the contact lasts so long; for the whole time
/// since the surfaces met where the contact is new; and, where they may part before the evaluation after the next, for all of
/// the time until they part or that next one, which then does not look back. Without this, a dashpot, whose force jumps when
/// surfaces meet, is right to first order in the step only. Without branches, for loops over lanes.
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
        last_{e.stage == Stage::last},
        // A neck acts beyond the surfaces, and begins and ends when the law says so.
        whole_{e.reach > 0.0} {}

  /// Of a contact that closes with `approach` [m/s].
  [[nodiscard]] Acting of(Earlier earlier, double overlap, double approach) const {
    const double way = h_ * std::abs(approach), closed = std::max(overlap, 0.0);
    const double time = closed < way ? h_ * (closed / way) : h_;  // to cover the overlap, at most a step
    const double since = approach > 0.0 ? time : h_;
    const bool leaving = approach < 0.0 && closed < 2.0 * way;
    const double before = earlier.is_new ? since : earlier.leaving ? 0.0 : half_;
    const double after = leaving ? time : half_;
    return {earlier.is_new ? new_ahead_ * since : old_ahead_, whole_ ? 1.0 : of_before_ * before + of_after_ * after,
            leaving && !last_};
  }

 private:
  double h_, half_, old_ahead_, new_ahead_, of_before_, of_after_;
  bool last_, whole_;
};

/// Part of the step that the impulse of an evaluation's force belongs to [s].
inline double kick_time(const Evaluation& e) { return e.stage == Stage::middle ? e.h : 0.5 * e.h; }

}  // namespace scree::dem
