// BodyMemory: what an observer remembers of each dynamic body from look to look.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/model/body.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

/// One Value per dynamic body, in order of id. A Value becomes numbers for checkpoints: it has `kNumbers`,
/// `std::array<double, kNumbers> numbers() const` and `static Value of(std::span<const double>)`.
template <class Value>
class BodyMemory {
 public:
  struct Entry {
    BodyId id = 0;
    Value value;
  };

  /// Calls `seen(index, value, is_new)` for every dynamic body, with a default Value for a new one, and `gone(id, value)`
  /// for each that was there the last time. Both in order of id.
  template <class Seen, class Gone>
  void walk(const BodyView& bodies, Seen&& seen, Gone&& gone) {
    next_.clear();
    auto known = entries_.begin();  // both lists ascend by id: one walk meets every body
    for (BodyIndex i = 0; i < bodies.size(); ++i) {
      if (bodies.motion[i] != Motion::dynamic) continue;
      for (; known != entries_.end() && known->id < bodies.id[i]; ++known) gone(known->id, known->value);
      const bool is_known = known != entries_.end() && known->id == bodies.id[i];
      next_.push_back(is_known ? std::move(*known++) : Entry{bodies.id[i], Value{}});
      seen(i, next_.back().value, !is_known);
    }
    for (; known != entries_.end(); ++known) gone(known->id, known->value);
    entries_.swap(next_);
  }
  template <class Seen>
  void walk(const BodyView& bodies, Seen&& seen) {
    walk(bodies, std::forward<Seen>(seen), [](BodyId, const Value&) {});
  }

  /// In order of id: entry k belongs to the k-th dynamic body of the last walk.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

  void save(StateWriter& out) const {
    std::vector<std::uint64_t> id;
    std::vector<double> numbers;
    for (const Entry& entry : entries_) {
      id.push_back(entry.id);
      const std::array<double, Value::kNumbers> of_value = entry.value.numbers();
      numbers.insert(numbers.end(), of_value.begin(), of_value.end());
    }
    out.write("id", id);
    out.write("numbers", numbers);
  }
  /// @throws Error (io) when the checkpoint is damaged.
  void load(const StateReader& in) {
    const std::vector<std::uint64_t> id = in.integers("id");
    const std::vector<double> numbers = in.doubles("numbers");
    if (numbers.size() != id.size() * Value::kNumbers) {
      throw Error{ErrorKind::io,
                  "what an observer remembers of the bodies is damaged in the checkpoint: lengths differ."};
    }
    entries_.clear();
    for (std::size_t k = 0; k < id.size(); ++k) {
      entries_.push_back({id[k], Value::of(std::span{numbers}.subspan(k * Value::kNumbers, Value::kNumbers))});
    }
  }

 private:
  std::vector<Entry> entries_;
  std::vector<Entry> next_;  // workspace
};

}  // namespace scree
