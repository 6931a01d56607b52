// BallContacts: contacts of balls, with each other and with flats, from the neighbour list to forces.
//
// Pairs lie in the order of space, cut into chunks of bodies. A chunk adds up the forces on its own bodies and, apart, those on
// bodies of other chunks ("ghosts"), which are added in a fixed order afterwards: any number of threads gives the same bits.
// What a contact keeps lies beside its pair, so that a sub-step looks nothing up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact_records.hpp"
#include "contact_tally.hpp"
#include "evaluation.hpp"
#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"
#include "scree/math/lanes.hpp"
#include "slots.hpp"

namespace scree {
class StateReader;
class StateWriter;
}  // namespace scree

namespace scree::dem {

struct BallWork;

class BallContacts {
 public:
  /// What contacts keep: the doubles of the law and, with `rolls`, moments.
  void set_layout(std::size_t history, bool rolls);
  /// A new list. Contacts that were in the old one keep their history. Both lists are of bodies in the numbering of `slots`.
  void set_neighbours(const Slots& slots, std::span<const BodyPair> neighbours, const Executor& executor);
  /// Bodies were added or removed: `index` holds the new index of each old body, or kGone.
  void renumber(std::span<const BodyIndex> index);
  static constexpr BodyIndex kGone = ~BodyIndex{0};

  /// Forgets the impulses of the last outer step.
  void begin_step(const Executor& executor);
  /// Overwrites slots.wrench with the forces of all contacts. Writes their histories.
  ContactTally evaluate(Slots& slots, const Evaluation& evaluation, const Executor& executor);

  /// Writes the contacts that were held in this outer step, in order of bodies.
  void report(const Slots& slots, const Executor& executor, ContactRecords& out) const;

  [[nodiscard]] std::size_t history_size() const { return history_; }
  [[nodiscard]] bool rolls() const { return rolls_; }
  [[nodiscard]] std::size_t pairs() const { return list_.pairs.size(); }
  /// Bytes of list and histories: of now, and of the list before, whose memory the next one takes.
  [[nodiscard]] std::size_t memory() const;

  void save(StateWriter& out, std::span<const BodyId> ids) const;
  /// `ids` of the bodies that the contacts are between.
  void load(const StateReader& in, std::span<const BodyId> ids);

 private:
  /// Two balls, a the one that the scene counts first, and where in slots.wrench the chunk of a adds up the forces on b.
  struct Pair {
    Slot a = 0, b = 0;
    std::uint32_t to_b = 0;
  };
  /// A ball and a flat.
  struct FlatPair {
    Slot ball = 0;
    std::uint32_t flat = 0;  ///< of Slots::flats
    std::uint32_t to_flat = 0;
    bool ball_is_b = false;
  };
  /// To be added to a slot's own sum.
  struct Incoming {
    Slot slot = 0;
    std::uint32_t ghost = 0;  ///< in slots.wrench
  };
  /// Pairs, and what their contacts keep.
  struct List {
    UninitialisedVector<BodyPair> pairs;       ///< sorted
    UninitialisedVector<std::uint32_t> place;  ///< of each: its number in pairs_, or behind those in flat_pairs_
    std::vector<std::uint32_t> begin;          ///< by body, and one more: of the pairs that it comes first in
    // By place:
    /// stride_ times four doubles: springs_ times four of history, of which the very last is the work of this outer step [J];
    /// the impulse [N s]; where the law resists rolling, the moment [N m s]. Their fourths are zero.
    UninitialisedVector<Lanes> records;
    UninitialisedVector<std::uint8_t> flags;
    /// Relative velocity when the outer step began, or the surfaces met [m/s], world.
    UninitialisedVector<Vec3> before;
  };
  static constexpr unsigned kTouching = 1;  // flags: within reach at the last evaluation,
  static constexpr unsigned kTouched = 2;   // touched, or pulled, at some time in this outer step,
  static constexpr unsigned kLeaving = 4;   // and Acting::leaving

  // The list.
  void merge(const Slots& slots, std::span<const BodyPair> neighbours, const Executor& executor);
  [[nodiscard]] static bool is_simple(const Slots& slots, const BodyPair& pair);
  void order_pairs(const Slots& slots, const Executor& executor);
  void order_flat_pairs(const Slots& slots);
  void carry_over(const Slots& slots, const Executor& executor);
  void find_ghosts(const Slots& slots, const Executor& executor);
  void find_incoming(std::size_t bodies, const Executor& executor);
  void report_one(const Slots& slots, std::size_t neighbour, std::size_t to, ContactRecords& out) const;

  // Pairs that touch, and those that do no longer.
  ContactTally evaluate_chunk(Slots& slots, const Evaluation& evaluation, std::size_t chunk);
  void look_at(const Slots& slots, double reach, std::size_t first, std::size_t last, BallWork& work) const;
  void look_at_flats(const Slots& slots, double reach, std::size_t first, std::size_t last, BallWork& work) const;
  void let_go(const BallWork& work);

  // Contacts of a batch, step by step: of two balls,
  void measure(const Slots& slots, const Evaluation& evaluation, BallWork& work) const;
  void gather(const Slots& slots, const Evaluation& evaluation, BallWork& work) const;
  void scatter(Slots& slots, const BallWork& work) const;
  template <bool kRolls>
  void scatter(Slots& slots, const BallWork& work) const;
  // of balls and flats,
  void measure_flats(const Slots& slots, const Evaluation& evaluation, BallWork& work) const;
  void gather_flats(const Slots& slots, const Evaluation& evaluation, BallWork& work) const;
  void scatter_flats(Slots& slots, const Evaluation& evaluation, BallWork& work) const;
  // and of both.
  void recall(BallWork& work) const;
  void apply_law(const Evaluation& evaluation, BallWork& work) const;
  void keep(const Evaluation& evaluation, BallWork& work);
  void write_records(double time, const BallWork& work);

  std::size_t history_ = 0, springs_ = 1, stride_ = 2;
  bool rolls_ = false;
  List list_, old_;                         // of now; and its memory for the next one
  std::vector<std::uint32_t> given_begin_;  // as List::begin, of the neighbours given
  UninitialisedVector<Pair> pairs_;         // by slot of a, then of b: by chunk
  std::vector<FlatPair> flat_pairs_;        // by ball, then by flat
  std::vector<std::uint32_t> chunk_begin_, flat_begin_;
  std::vector<std::vector<Slot>> ghosts_;  // by chunk: the bodies of other chunks that it acts on, in order
  std::vector<std::uint32_t> ghost_begin_;
  UninitialisedVector<Incoming> incoming_;  // by chunk of the slot
  std::vector<std::uint32_t> incoming_begin_;
  std::vector<ContactTally> tally_;
};

}  // namespace scree::dem
