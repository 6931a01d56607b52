// The list of BallContacts: its pairs in the order of space, and what contacts keep when it changes. Each row, of one body and
// those above it that are near, is worked on by itself.
#include <algorithm>
#include <utility>

#include "ball_contacts.hpp"
#include "scree/base/release.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kChunk = Verlet::kChunk;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

bool comes_before(const BodyPair& l, const BodyPair& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }

/// Of pairs that are sorted: where those of each body that comes first in them begin.
void find_rows(std::span<const BodyPair> pairs, std::size_t bodies, const Executor& executor,
               std::vector<std::uint32_t>& begin) {
  begin.resize(bodies + 1);
  const auto fill = [&](std::size_t first, std::size_t last, std::size_t value) {
    for (std::size_t k = first; k < last; ++k) begin[k] = static_cast<std::uint32_t>(value);
  };
  executor.for_chunks(pairs.size(), kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const std::size_t from = p == 0 ? 0 : std::size_t{pairs[p - 1].a} + 1;
      fill(from, std::size_t{pairs[p].a} + 1, p);
    }
  });
  fill(pairs.empty() ? 0 : std::size_t{pairs.back().a} + 1, bodies + 1, pairs.size());
}

/// Makes a sum of what came before out of each of the counts, which begin with a zero.
void add_up(std::vector<std::uint32_t>& counts) {
  for (std::size_t k = 1; k < counts.size(); ++k) counts[k] += counts[k - 1];
}

}  // namespace

void BallContacts::set_layout(std::size_t history, bool rolls) {
  history_ = history;
  rolls_ = rolls;
  springs_ = history / 4 + 1;
  stride_ = springs_ + (rolls ? 2 : 1);
}

void BallContacts::set_neighbours(const Slots& slots, std::span<const BodyPair> neighbours, const Executor& executor) {
  std::swap(list_, old_);
  merge(slots, neighbours, executor);
  resize_kept(list_.pairs.size(), list_.place, list_.flags, list_.before);
  resize_kept(stride_ * list_.pairs.size(), list_.records);
  order_pairs(slots, executor);
  order_flat_pairs(slots);
  carry_over(slots, executor);
  find_ghosts(slots, executor);
  find_incoming(slots.size(), executor);
}

/// The new neighbours, and pairs that touched in this step and flew apart since: they are still to be reported.
void BallContacts::merge(const Slots& slots, std::span<const BodyPair> neighbours, const Executor& executor) {
  const std::size_t n = slots.size();
  find_rows(neighbours, n, executor, given_begin_);
  find_rows(old_.pairs, n, executor, old_.begin);
  // Calls take(pair) for those of a row, in order.
  const auto walk = [&](std::size_t body, const auto& take) {
    std::size_t p = given_begin_[body];
    const std::size_t end = given_begin_[body + 1];
    for (std::size_t old = old_.begin[body]; old < old_.begin[body + 1]; ++old) {
      const BodyPair& pair = old_.pairs[old];
      while (p < end && neighbours[p].b < pair.b) take(neighbours[p++]);
      if (p < end && neighbours[p].b == pair.b) continue;
      if (old_.flags[old_.place[old]] != 0 && is_simple(slots, pair)) take(pair);
    }
    while (p < end) take(neighbours[p++]);
  };
  list_.begin.assign(n + 1, 0);
  executor.for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t body = first; body < last; ++body) walk(body, [&](const BodyPair&) { ++list_.begin[body + 1]; });
  });
  add_up(list_.begin);
  resize_kept(list_.begin.back(), list_.pairs);
  executor.for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    std::size_t at = list_.begin[first];
    for (std::size_t body = first; body < last; ++body)
      walk(body, [&](const BodyPair& pair) { list_.pairs[at++] = pair; });
  });
}

/// Two balls, or a ball and a flat. A flat may have begun to move.
bool BallContacts::is_simple(const Slots& slots, const BodyPair& pair) {
  const Slot a = slots.slot_of[pair.a], b = slots.slot_of[pair.b];
  const bool ball_a = slots.is_ball(a), ball_b = slots.is_ball(b);
  return (ball_a && ball_b) || (ball_a && slots.flat_of(b) < slots.flats.size()) ||
         (ball_b && slots.flat_of(a) < slots.flats.size());
}

/// Pairs of balls by the slot of a, then by that of b. Those with flats get no place yet.
void BallContacts::order_pairs(const Slots& slots, const Executor& executor) {
  const std::size_t n = slots.size();
  chunk_begin_.assign(Executor::chunk_count(n, kChunk) + 1, 0);
  executor.for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    std::uint32_t count = 0;
    for (std::size_t slot = first; slot < last; ++slot) {
      if (!slots.is_ball(static_cast<Slot>(slot))) continue;
      const BodyIndex body = slots.body[slot];
      for (std::size_t p = list_.begin[body]; p < list_.begin[body + 1]; ++p)
        count += slots.is_ball(slots.slot_of[list_.pairs[p].b]) ? 1 : 0;
    }
    chunk_begin_[first / kChunk + 1] = count;
  });
  add_up(chunk_begin_);
  resize_kept(chunk_begin_.back(), pairs_);
  executor.for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    std::uint32_t at = chunk_begin_[first / kChunk];
    std::vector<std::pair<Slot, std::uint32_t>> row;  // slot of b, and which of the list
    for (std::size_t slot = first; slot < last; ++slot) {
      const BodyIndex body = slots.body[slot];
      const bool ball = slots.is_ball(static_cast<Slot>(slot));
      row.clear();
      for (std::uint32_t p = list_.begin[body]; p < list_.begin[body + 1]; ++p) {
        const Slot other = slots.slot_of[list_.pairs[p].b];
        list_.place[p] = kNone;
        if (ball && slots.is_ball(other)) row.emplace_back(other, p);
      }
      std::ranges::sort(row);
      for (const auto& [other, p] : row) {
        pairs_[at] = {static_cast<Slot>(slot), other, other};
        list_.place[p] = at++;
      }
    }
  });
}

/// Those that have no place yet.
void BallContacts::order_flat_pairs(const Slots& slots) {
  std::vector<std::pair<FlatPair, std::uint32_t>> found;
  for (std::uint32_t p = 0; p < list_.pairs.size(); ++p) {
    if (list_.place[p] != kNone) continue;
    const Slot a = slots.slot_of[list_.pairs[p].a], b = slots.slot_of[list_.pairs[p].b];
    const bool ball_is_b = slots.is_ball(b);
    const Slot flat = ball_is_b ? a : b;
    found.push_back({{ball_is_b ? b : a, static_cast<std::uint32_t>(slots.flat_of(flat)), flat, ball_is_b}, p});
  }
  std::ranges::sort(found, {}, [](const auto& of) { return std::pair{of.first.ball, of.first.flat}; });
  flat_pairs_.clear();
  flat_begin_.assign(1, 0);
  for (const auto& [pair, p] : found) {
    const auto at = static_cast<std::uint32_t>(flat_pairs_.size());
    while (pair.ball >= flat_begin_.size() * kChunk) flat_begin_.push_back(at);
    list_.place[p] = static_cast<std::uint32_t>(pairs_.size()) + at;
    flat_pairs_.push_back(pair);
  }
  flat_begin_.resize(chunk_begin_.size(), static_cast<std::uint32_t>(flat_pairs_.size()));
}

/// What contacts of the old list keep goes to those of the new one; new pairs keep nothing yet.
void BallContacts::carry_over(const Slots& slots, const Executor& executor) {
  const auto record_of = [&](List& list, std::uint32_t place) { return list.records.data() + stride_ * place; };
  executor.for_chunks(slots.size(), kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t slot = first; slot < last; ++slot) {
      const BodyIndex body = slots.body[slot];
      std::size_t old = old_.begin[body];
      const std::size_t end = old_.begin[body + 1];
      for (std::size_t p = list_.begin[body]; p < list_.begin[body + 1]; ++p) {
        while (old < end && comes_before(old_.pairs[old], list_.pairs[p])) ++old;
        const std::uint32_t is = list_.place[p];
        if (old < end && old_.pairs[old] == list_.pairs[p] && old_.flags[old_.place[old]] != 0) {
          const std::uint32_t was = old_.place[old];
          std::copy_n(record_of(old_, was), stride_, record_of(list_, is));
          list_.flags[is] = old_.flags[was];
          list_.before[is] = old_.before[was];
        } else {
          std::fill_n(record_of(list_, is), stride_, Lanes{});
          list_.flags[is] = 0;
          list_.before[is] = Vec3{};
        }
      }
    }
  });
}

/// Gives each chunk a place for every body of another chunk that it acts on.
void BallContacts::find_ghosts(const Slots& slots, const Executor& executor) {
  const std::size_t chunks = chunk_begin_.size() - 1;
  ghosts_.resize(chunks);
  ghost_begin_.assign(chunks + 1, 0);
  const auto is_own = [](std::size_t chunk, Slot slot) { return slot / kChunk == chunk; };
  executor.for_chunks(chunks, 1, [&](std::size_t c, std::size_t) {
    std::vector<Slot>& ghosts = ghosts_[c];
    ghosts.clear();
    const auto note = [&](Slot slot) {
      if (!is_own(c, slot)) ghosts.push_back(slot);
    };
    for (std::size_t k = chunk_begin_[c]; k < chunk_begin_[c + 1]; ++k) note(pairs_[k].b);
    for (std::size_t k = flat_begin_[c]; k < flat_begin_[c + 1]; ++k) note(flat_pairs_[k].to_flat);
    std::ranges::sort(ghosts);
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    ghost_begin_[c + 1] = static_cast<std::uint32_t>(ghosts.size());
  });
  add_up(ghost_begin_);
  executor.for_chunks(chunks, 1, [&](std::size_t c, std::size_t) {
    const auto place_of = [&](Slot slot) {
      if (is_own(c, slot)) return slot;
      const auto which = std::ranges::lower_bound(ghosts_[c], slot) - ghosts_[c].begin();
      return static_cast<Slot>(slots.size() + ghost_begin_[c] + static_cast<std::size_t>(which));
    };
    for (std::size_t k = chunk_begin_[c]; k < chunk_begin_[c + 1]; ++k) pairs_[k].to_b = place_of(pairs_[k].b);
    for (std::size_t k = flat_begin_[c]; k < flat_begin_[c + 1]; ++k) {
      flat_pairs_[k].to_flat = place_of(flat_pairs_[k].to_flat);
    }
  });
}

/// What each chunk gets from the ghosts of others: chunk by chunk, in order of slots.
void BallContacts::find_incoming(std::size_t bodies, const Executor& executor) {
  const std::size_t chunks = ghosts_.size();
  // Calls take(slot, ghost) for the ghosts of bodies of a chunk.
  const auto walk = [&](std::size_t chunk, const auto& take) {
    const auto first = static_cast<Slot>(chunk * kChunk), last = static_cast<Slot>(first + kChunk);
    for (std::size_t from = 0; from < chunks; ++from) {
      const std::vector<Slot>& ghosts = ghosts_[from];
      for (auto at = std::ranges::lower_bound(ghosts, first); at != ghosts.end() && *at < last; ++at)
        take(*at,
             static_cast<std::uint32_t>(bodies + ghost_begin_[from]) + static_cast<std::uint32_t>(at - ghosts.begin()));
    }
  };
  incoming_begin_.assign(chunks + 1, 0);
  executor.for_chunks(
      chunks, 1, [&](std::size_t c, std::size_t) { walk(c, [&](Slot, std::uint32_t) { ++incoming_begin_[c + 1]; }); });
  add_up(incoming_begin_);
  resize_kept(incoming_begin_.back(), incoming_);
  executor.for_chunks(chunks, 1, [&](std::size_t c, std::size_t) {
    std::size_t at = incoming_begin_[c];
    walk(c, [&](Slot slot, std::uint32_t ghost) { incoming_[at++] = {slot, ghost}; });
  });
}

}  // namespace scree::dem
