// Contacts as the narrow phase finds them and as fields and observers see them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/math/vec3.hpp"
#include "scree/model/body.hpp"

namespace scree {

/// One contact point. a < b as indices into the BodyView of the same call,
/// hence also by id.
struct Contact {
  BodyIndex a = 0;
  BodyIndex b = 0;
  std::uint32_t primitive_a = 0;  ///< index into the primitives of a's shape
  std::uint32_t primitive_b = 0;
  std::uint64_t feature = 0;  ///< tells the contacts of one pair of primitives
                              ///< apart; stable while the features touch
  Vec3 point;                 ///< midway between the two surfaces [m], world
  Vec3 normal;                ///< unit, from a to b [1], world
  double gap = 0.0;           ///< distance of the surfaces along the normal [m]; negative
                              ///< when they overlap
};

/// Contacts of a batch of pairs, appended by a narrow phase.
using ContactBuffer = std::vector<Contact>;

/// What contacts did to a body over a step, where a scheme sums it up itself: in many short steps a body turns, and the sum of
/// the impulses at its last pose is not the sum of their moments.
struct ContactLoad {
  BodyIndex body = 0;
  Vec3 impulse;          ///< [N s], world
  Vec3 angular_impulse;  ///< about the centre of mass, wherever that was [N m s], world
  double work = 0.0;     ///< on the body [J]
};

/// The contacts of the last step, spans of equal length (or empty where it says so).
struct ContactView {
  std::span<const Contact> contact;
  std::span<const Vec3> impulse;               ///< on b, in the contact frame: normal,
                                               ///< tangent 1, tangent 2 [N s]
  std::span<const Vec3> velocity_before;       ///< of b's surface relative to a's, contact frame,
                                               ///< before the solve [m/s]
  std::span<const Vec3> velocity_after;        ///< the same after the solve [m/s]
  std::span<const Vec3> angular_impulse = {};  ///< what resists rolling: on b, about the point, in the contact frame:
                                               ///< spin, rolling 1, rolling 2 [N m s]; empty where nothing does
  double age = 0.0;  ///< points, normals and gaps are those of the bodies so long before the end of the step [s]: the
                     ///< whole step for schemes that find contacts at its beginning, else 0
  std::span<const double> work = {};  ///< that contacts took out of their bodies: lost, or kept in springs [J]; empty
                                      ///< where -impulse (before + after) / 2 is it
  std::span<const ContactLoad> loads = {};  ///< by body; empty, or without a body, where its contacts tell as much

  [[nodiscard]] std::size_t size() const { return contact.size(); }
};

}  // namespace scree
