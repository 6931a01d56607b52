// BoxRegister: follows boxes by their key from step to step, for broad phases that keep a structure of their own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "scree/interfaces/broad_phase.hpp"

namespace scree {

/// What a phase holds for each box, in order of key. `Handle` is the phase's own: a proxy, a pointer, an index.
template <class Handle>
class BoxRegister {
 public:
  /// Brings the register to this step's boxes: remove(handle) for keys that are gone, add(i) -> Handle for new ones, and
  /// move(handle, i) for the others, i being the index of the box now. A box that became movable, or ceased to be, is
  /// removed and added.
  template <class Add, class Move, class Remove>
  void update(const BoxView& boxes, const Add& add, const Move& move, const Remove& remove) {
    sort_by_key(boxes);
    merged_.clear();
    auto old = entries_.begin();
    const auto drop = [&] { remove((old++)->handle); };
    for (const std::uint32_t i : order_) {
      const bool movable = boxes.movable[i] != 0;
      while (old != entries_.end() && old->key < boxes.key[i]) drop();
      const bool known = old != entries_.end() && old->key == boxes.key[i];
      if (known && old->movable == movable) {
        move(old->handle, i);
        merged_.push_back(std::move(*old++));
        continue;
      }
      if (known) drop();
      merged_.push_back({boxes.key[i], movable, add(i)});
    }
    while (old != entries_.end()) drop();
    entries_.swap(merged_);
  }

  /// remove(handle) for all.
  template <class Remove>
  void clear(const Remove& remove) {
    for (Entry& entry : entries_) remove(entry.handle);
    entries_.clear();
  }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint64_t key;
    bool movable;
    Handle handle;
  };

  void sort_by_key(const BoxView& boxes) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0u);
    if (std::is_sorted(boxes.key.begin(), boxes.key.end())) return;
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t l, std::uint32_t r) { return boxes.key[l] < boxes.key[r]; });
  }

  std::vector<std::uint32_t> order_;  // boxes by key
  std::vector<Entry> entries_;
  std::vector<Entry> merged_;
};

}  // namespace scree
