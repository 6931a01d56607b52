// BallWork: contacts of balls on their way through the law, side by side.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "contact_tally.hpp"
#include "four.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/math/lanes.hpp"

namespace scree::dem {

/// Pairs that are looked at together: those that touch make a batch. More would push each other out of the nearest cache.
inline constexpr std::size_t kPairsAtOnce = 64;
static_assert(kPairsAtOnce <= ContactBatch::kMost && kPairsAtOnce % 4 == 0);

/// Of the fours of a and b, b - a and, of what comes last, the sum: four(b) + kAway * four(a).
inline constexpr Lanes kAway{-1.0, -1.0, -1.0, 1.0};

struct BallWork {
  using Lane = ContactBatch::Lane;

  // Of the pairs looked at.
  std::array<std::uint32_t, kPairsAtOnce + 4> hit;  ///< those that touch; the last stands for the lanes behind it, too
  std::array<Lanes, kPairsAtOnce + 4> apart;  ///< from centre to centre of each, or x of a ball, and what it overlaps
  std::array<std::uint32_t, kPairsAtOnce + 4> gone;  ///< those that do no longer
  std::size_t parted = 0;                            ///< how many

  // Of the contacts.
  ContactBatch batch;
  std::size_t first = 0;  ///< number of the first pair of this kind in flags, records and velocities before
  alignas(64) Lane radius_a, radius_b, arm_a, arm_b, inverse_mass, is_new, leaving, acting;
  alignas(64) Lane overlap;    ///< now; that of the batch is its mean over the time that the force stands for [m]
  alignas(64) Lane work;       ///< that the contact has taken out of its bodies in this outer step [J]
  ContactBatch::Lanes3 rim;    ///< sum of arm times angular velocity [m/s]
  ContactBatch::Lanes3 lever;  ///< normal x force [N]
  ContactTally tally;
  Lanes greatest{};  ///< overlap, by lane [m]
};

inline Lanes lanes_at(const ContactBatch::Lane& lane, std::size_t k) {
  Lanes out;
  std::memcpy(&out, lane.data() + k, sizeof out);
  return out;
}
inline void set_lanes_at(const Lanes& values, ContactBatch::Lane& lane, std::size_t k) {
  std::memcpy(lane.data() + k, &values, sizeof values);
}

/// Writes rows to the lanes k .. k + 3 of a vector, by their first three columns; returns the fourth column.
inline Lanes set_columns(Lanes a, Lanes b, Lanes c, Lanes d, std::size_t k, ContactBatch::Lanes3& out) {
  transpose(a, b, c, d);
  set_lanes_at(a, out.x, k), set_lanes_at(b, out.y, k), set_lanes_at(c, out.z, k);
  return d;
}
/// The vectors of the lanes k .. k + 3, each with a zero behind.
inline std::array<Lanes, 4> rows(const ContactBatch::Lanes3& in, std::size_t k) {
  std::array<Lanes, 4> out{lanes_at(in.x, k), lanes_at(in.y, k), lanes_at(in.z, k), Lanes{}};
  transpose(out[0], out[1], out[2], out[3]);
  return out;
}
/// Lanes that loops over four at a time reach.
inline std::size_t padded(std::size_t count) { return (count + 3) / 4 * 4; }
/// Such loops run over the end: the last contact stands there once more.
inline void fill_lanes(BallWork& w) {
  const std::size_t count = w.batch.count;
  for (std::size_t k = count; k < padded(count); ++k) w.hit[k] = w.hit[count - 1], w.apart[k] = w.apart[count - 1];
}

}  // namespace scree::dem
