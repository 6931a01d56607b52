// BallContacts: contacts of bodies that are one sphere each, from the neighbour list to forces.
//
// Pairs lie in the order of space, cut into chunks of bodies. A chunk adds up the forces on its own bodies and, apart, those on
// bodies of other chunks ("ghosts"), which are added in a fixed order afterwards: any number of threads gives the same bits.
// What a contact keeps lies beside its pair, so that a sub-step looks nothing up.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact_records.hpp"
#include "contact_tally.hpp"
#include "evaluation.hpp"
#include "scree/collision/collider.hpp"
#include "slots.hpp"

namespace scree {
class StateReader;
class StateWriter;
}  // namespace scree

namespace scree::dem {

class BallContacts {
 public:
  /// What contacts keep: the doubles of the law and, with `rolls`, moments.
  void set_layout(std::size_t history, bool rolls);
  /// A new list. Contacts that were in the old one keep their history. Both lists are of bodies in the numbering of `slots`.
  void set_neighbours(const Slots& slots, std::span<const BodyPair> neighbours);
  /// Bodies were added or removed: `index` holds the new index of each old body, or kGone.
  void renumber(std::span<const BodyIndex> index);
  static constexpr BodyIndex kGone = ~BodyIndex{0};

  /// Forgets the impulses of the last outer step.
  void begin_step();
  /// Overwrites slots.wrench with the forces of all contacts. Writes their histories.
  ContactTally evaluate(Slots& slots, const Evaluation& evaluation, const Executor& executor);

  /// Appends the contacts that touched in this outer step, in order of bodies.
  void report(const Slots& slots, ContactRecords& out) const;

  [[nodiscard]] std::size_t history_size() const { return history_; }
  [[nodiscard]] bool rolls() const { return rolls_; }
  /// Bytes of list and histories.
  [[nodiscard]] std::size_t memory() const;
  [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }

  void save(StateWriter& out, std::span<const BodyId> ids) const;
  /// `ids` of the bodies that the contacts are between.
  void load(const StateReader& in, std::span<const BodyId> ids);

 private:
  static constexpr std::uint32_t kInside = ~std::uint32_t{0};
  /// Bodies a < b as the scene numbers them.
  struct Pair {
    Slot a = 0, b = 0;
    std::uint32_t ghost = kInside;  ///< which ghost of the chunk, where one of the two lies in another chunk
  };
  struct Incoming {
    Slot slot = 0;
    std::uint32_t ghost = 0;
  };
  static constexpr unsigned kTouching = 1;  // flags: at the last evaluation,
  static constexpr unsigned kTouched = 2;   // at some time in this outer step,
  static constexpr unsigned kLeaving = 4;   // and Acting::leaving
  struct Work;

  void order_pairs(const Slots& slots);
  void find_ghosts(std::size_t bodies);
  void carry_over(std::span<const BodyPair> from, std::span<const std::uint32_t> place, std::span<const double> records,
                  std::span<const std::uint8_t> flags, std::span<const Vec3> before);
  ContactTally evaluate_chunk(Slots& slots, const Evaluation& evaluation, std::size_t chunk);
  void let_go(std::size_t pair);
  std::size_t look_at(const Slots& slots, const Evaluation& evaluation, std::size_t first, std::size_t last, Work& work,
                      std::array<std::uint32_t, ContactBatch::kMost>& gone) const;
  void measure(const Slots& slots, const Evaluation& evaluation, Work& work) const;
  void gather(const Slots& slots, const Evaluation& evaluation, Work& work) const;
  static void combine(const Evaluation& evaluation, Work& work);
  void note(const Evaluation& evaluation, Work& work);
  void scatter(Slots& slots, const Evaluation& evaluation, std::size_t chunk, Work& work);

  std::size_t history_ = 0, stride_ = 3;
  bool rolls_ = false;
  std::vector<BodyPair> neighbours_;  // as given, sorted
  std::vector<std::uint32_t> place_;  // of each in what follows
  std::vector<Pair> pairs_;           // by chunk, then by slots
  std::vector<std::uint32_t> chunk_begin_;
  std::vector<double> records_;  // stride_ doubles a pair: history, impulse, moment
  std::vector<std::uint8_t> flags_;
  std::vector<Vec3> before_;    // relative velocity when the outer step began, or the surfaces met [m/s], world
  std::vector<Wrench> ghosts_;  // of all chunks
  std::vector<std::uint32_t> ghost_begin_;
  std::vector<Incoming> incoming_;  // by chunk of the slot
  std::vector<std::uint32_t> incoming_begin_;
  std::vector<ContactTally> tally_;
};

}  // namespace scree::dem
