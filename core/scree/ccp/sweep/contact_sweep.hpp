// ContactSweep: the contacts and bodies of a problem, laid out for sweeps that go contact by contact.
//
// Contacts lie in groups of four, one a vector lane (grouping.hpp); groups in chunks, which go in the order of the contacts, or
// by colours, several threads at a time (colouring.hpp). What a sweep does with a group is the solver's: it takes the layout
// that the problem asks for (layout.hpp), loops over the groups of a chunk and calls update(), or something of its own.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/ccp/sweep/colouring.hpp"
#include "scree/ccp/sweep/grouping.hpp"
#include "scree/ccp/sweep/hub_copies.hpp"
#include "scree/ccp/sweep/layout.hpp"
#include "scree/ccp/sweep/local_step.hpp"
#include "scree/ccp/twist.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {

/// Keeps its memory between problems. The order of updates is a matter of the settings, never of the threads.
class ContactSweep {
 public:
  struct Settings {
    bool coloured = false;     ///< chunks by colours, for several threads; else one chunk, in the order of the contacts
    bool scalar_step = false;  ///< one step for the three rows of a contact
    double relaxation = 1.0;   ///< omega [1]
  };

  void bind(const CcpProblem& problem, const Settings& settings);

  /// Sets all impulses (3 m) [N s].
  void set_impulses(std::span<const double> gamma);
  void impulses(std::span<double> gamma) const;
  /// Sets the velocities that the impulses cause, one Twist per body [m/s, rad/s].
  void set_velocities(std::span<const Twist> w);
  void velocities(std::span<Twist> w) const;

  /// All bodies have an inverse inertia that is a multiple of the identity.
  [[nodiscard]] bool isotropic() const { return inertias_.empty(); }
  /// Groups of four contacts.
  [[nodiscard]] std::size_t groups() const { return grouping_.groups.size(); }
  /// First or second bodies of the lanes of group k; immovable ones, those of empty lanes and copies of hubs are past the problem's
  /// last.
  [[nodiscard]] const std::array<std::uint32_t, 4>& bodies_of(std::size_t k, bool first) const {
    return first ? groups_[k].a : groups_[k].b;
  }
  /// Calls visit(layout) with a sweep::Layout.
  template <class Visit>
  void with_layout(const Visit& visit) {
    const bool compliant = !compliance_.empty();
    if (isotropic()) {
      compliant ? visit(layout<true, true>()) : visit(layout<true, false>());
    } else {
      compliant ? visit(layout<false, true>()) : visit(layout<false, false>());
    }
  }
  /// Those of the problem, one more a chunk, which stands for nothing, and copies of hubs, which count in a sweep only.
  [[nodiscard]] std::span<sweep::Body> bodies() { return bodies_; }

  [[nodiscard]] std::size_t chunks() const { return grouping_.first.size() - 1; }
  /// Calls visit(chunk, first group, one past the last group) chunk by chunk in the order of a sweep, or `backward` in the
  /// opposite one (the visitor then goes backwards through its groups). Chunks of one colour may run at the same time.
  template <class Visit>
  void for_chunks(bool backward, const Executor* executor, const Visit& visit) {
    for (std::size_t p = 0; p < phases(); ++p) {
      const std::size_t phase = backward ? phases() - 1 - p : p;
      copies_.spread(phase, bodies_);
      go_through(phase, backward, executor,
                 [&](std::size_t chunk) { visit(chunk, grouping_.first[chunk], grouping_.first[chunk + 1]); });
      copies_.collect(phase, bodies_);
    }
  }

 private:
  /// Chunks that may run at the same time: a colour, or, last of all, those that go one after the other.
  [[nodiscard]] std::size_t phases() const {
    if (!coloured_) return std::min<std::size_t>(1, chunks());
    return colours() + (colouring_.first().back() < colouring_.chunks().size() ? 1 : 0);
  }
  [[nodiscard]] std::size_t colours() const { return colouring_.first().size() - 1; }
  [[nodiscard]] std::size_t first_of_phase(std::size_t phase) const {
    return phase <= colours() ? colouring_.first()[phase] : colouring_.chunks().size();
  }
  template <class Visit>
  void go_through(std::size_t phase, bool backward, const Executor* executor, const Visit& one) const {
    if (!coloured_) return one(0);
    const std::size_t begin = first_of_phase(phase), end = first_of_phase(phase + 1), count = end - begin;
    const auto several = [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) one(colouring_.chunks()[begin + k]);
    };
    if (phase == colours()) {
      for (std::size_t k = 0; k < count; ++k) one(colouring_.chunks()[backward ? end - 1 - k : begin + k]);
    } else if (count == 1 || executor == nullptr || executor->threads() == 1) {
      several(0, count);
    } else {
      executor->for_chunks(count, 1, std::cref(several));
    }
  }
  void choose_bodies(const CcpProblem& problem);
  void bind_bodies(const CcpProblem& problem);
  void bind_groups(const CcpProblem& problem, const Settings& settings);
  /// Fills lane `lane` of group `at` with contact i and its step.
  void put_contact(const CcpProblem& problem, std::size_t at, int lane, std::size_t i, const sweep::LocalStep& step);
  template <bool isotropic, bool compliant>
  sweep::Layout<isotropic, compliant> layout() {
    return {groups_.data(), compliance_.data(), bodies_.data(), inertias_.data()};
  }

  bool coloured_ = false;
  sweep::Sequence sequence_;
  sweep::Grouping grouping_;
  sweep::Colouring colouring_;
  sweep::HubCopies copies_;
  std::vector<sweep::Body> bodies_;
  std::vector<sweep::Inertia> inertias_;
  std::vector<sweep::Group> groups_;
  std::vector<Lanes3> compliance_;
};

}  // namespace scree
