// ShapeContacts: contacts that a narrow phase finds, of everything but two balls.
//
// They are known by the ids of the bodies, the primitives and the feature, and keep their history from sub-step to sub-step by
// that name. On a mesh a grain passes from feature to feature: a new contact takes over the history of one that ended between
// the same two primitives in the same sub-step, so that a spring is not lost at every edge.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact_records.hpp"
#include "contact_tally.hpp"
#include "evaluation.hpp"
#include "scree/ccp/contact_memory.hpp"
#include "scree/collision/contact.hpp"
#include "slots.hpp"

namespace scree::dem {

class ShapeContacts {
 public:
  /// Forgets the impulses of the last outer step, and contacts that are over. `bodies` are those of this step.
  void begin_step(const BodyView& bodies);
  /// Adds the forces of `found` (sorted, of the bodies' present poses) to slots.wrench.
  ContactTally evaluate(Slots& slots, const BodyView& bodies, std::span<const Contact> found,
                        const Evaluation& evaluation, const Executor& executor);
  /// Appends the contacts that touched in this outer step, in order.
  void report(const Slots& slots, const BodyView& bodies, bool rolls, ContactRecords& out) const;

  /// Points that share the mass of a pair of bodies, as far as the stable step is concerned: the most that a pair has had at once;
  /// where bodies are no balls twice as many, and at least 8.
  [[nodiscard]] std::size_t most_points() const { return most_points_; }
  void set_most_points(std::size_t points) { most_points_ = points; }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  void save(StateWriter& out, std::size_t history) const;
  void load(const StateReader& in, std::size_t history);

 private:
  /// A contact that touched in this outer step.
  struct Entry {
    ContactKey key;
    Contact contact;        ///< as last found
    bool touching = false;  ///< at the last evaluation
    bool is_new = true;     ///< it was not there at the evaluation before
    bool leaving = false;   ///< Acting::leaving
    std::array<double, ContactBatch::kMostHistory> history{};
    Vec3 impulse;       ///< [N s], world
    Vec3 moment;        ///< [N m s], world
    double work = 0.0;  ///< taken out of the bodies [J]
    Vec3 before;        ///< relative velocity when the step began, or the surfaces met [m/s], world
  };
  /// Surface points of a contact relative to the centres of the bodies [m], world.
  struct Arms {
    Vec3 a, b;
  };
  struct Work;

  bool is_as_before(const BodyView& bodies, std::span<const Contact> found);
  void match(const BodyView& bodies, std::span<const Contact> found);
  void inherit(std::size_t first, std::size_t last);
  void share_mass(const Slots& slots);
  static Vec3 belt_slip(const BodyView& bodies, const Contact& contact, const Arms& arms);
  static Arms arms(const Slots& slots, const Contact& contact, bool at_contact_point);
  static Vec3 surface_velocity(const Slots& slots, const BodyView& bodies, const Contact& contact, const Arms& arms);
  void gather(const Slots& slots, const BodyView& bodies, const Evaluation& evaluation, Work& work) const;
  void scatter(const Evaluation& evaluation, Work& work);

  std::vector<Entry> entries_, merged_;  // by key
  std::size_t most_points_ = 1;
  std::vector<double> share_;          // of the pair's mass, by active contact [1]
  std::vector<std::uint32_t> active_;  // entries that touch now
  std::vector<Wrench> on_a_, on_b_;    // by active contact
  std::vector<ContactTally> tally_;
};

}  // namespace scree::dem
