// The list of BallContacts: in the order of space, with its ghosts; and what contacts keep when it changes.
#include <algorithm>
#include <iterator>
#include <utility>

#include "ball_contacts.hpp"
#include "scree/state/state_io.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kChunk = Verlet::kChunk;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

bool comes_before(const BodyPair& l, const BodyPair& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }

}  // namespace

void BallContacts::set_layout(std::size_t history, bool rolls) {
  history_ = history;
  rolls_ = rolls;
  springs_ = history / 4 + 1;
  stride_ = springs_ + (rolls ? 2 : 1);
}

void BallContacts::set_neighbours(const Slots& slots, std::span<const BodyPair> neighbours) {
  // Pairs that touched in this step and flew apart since are still to be reported.
  std::vector<BodyPair> touched;
  for (std::size_t p = 0; p < neighbours_.size(); ++p) {
    if (flags_[place_[p]] != 0) touched.push_back(neighbours_[p]);
  }
  std::vector<BodyPair> all;
  all.reserve(neighbours.size() + touched.size() / 8);
  std::ranges::set_union(neighbours, touched, std::back_inserter(all), comes_before);
  const auto is_simple = [&](const BodyPair& pair) {
    const Slot a = slots.slot_of[pair.a], b = slots.slot_of[pair.b];
    const bool ball_a = slots.is_ball(a), ball_b = slots.is_ball(b);
    return (ball_a && ball_b) || (ball_a && slots.flat_of(b) < slots.flats.size()) ||
           (ball_b && slots.flat_of(a) < slots.flats.size());
  };
  std::erase_if(all, [&](const BodyPair& pair) { return !is_simple(pair); });  // a flat that has begun to move
  const std::vector<BodyPair> old_neighbours = std::exchange(neighbours_, std::move(all));
  const std::vector<std::uint32_t> old_place = std::exchange(place_, {});
  const std::vector<Lanes> old_records = std::exchange(records_, {});
  const std::vector<std::uint8_t> old_flags = std::exchange(flags_, {});
  const std::vector<Vec3> old_before = std::exchange(before_, {});
  order_pairs(slots);
  find_ghosts(slots.size());
  records_.assign(stride_ * neighbours_.size(), Lanes{});
  flags_.assign(neighbours_.size(), 0);
  before_.assign(neighbours_.size(), Vec3{});
  carry_over(old_neighbours, old_place, old_records, old_flags, old_before);
}

/// Pairs of balls by the lower slot, then by the higher one; behind them those with flats.
void BallContacts::order_pairs(const Slots& slots) {
  const std::size_t n = slots.size(), m = neighbours_.size();
  const auto ends = [&](std::uint32_t p) {
    return std::minmax({slots.slot_of[neighbours_[p].a], slots.slot_of[neighbours_[p].b]});
  };
  std::vector<std::uint32_t> begin(n + 1, 0), with_flats;
  for (std::uint32_t p = 0; p < m; ++p) {
    const auto [low, high] = ends(p);
    if (slots.is_ball(low) && slots.is_ball(high)) {
      ++begin[low + 1];
    } else {
      with_flats.push_back(p);
    }
  }
  for (std::size_t k = 0; k < n; ++k) begin[k + 1] += begin[k];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1), at(m - with_flats.size());
  for (std::uint32_t p = 0, q = 0; p < m; ++p) {
    if (q < with_flats.size() && with_flats[q] == p) {
      ++q;
    } else {
      at[next[ends(p).first]++] = p;
    }
  }
  pairs_.resize(at.size());
  place_.resize(m);
  for (std::size_t slot = 0; slot < n; ++slot) {
    std::sort(at.begin() + begin[slot], at.begin() + begin[slot + 1],
              [&](std::uint32_t l, std::uint32_t r) { return ends(l).second < ends(r).second; });
    for (std::uint32_t k = begin[slot]; k < begin[slot + 1]; ++k) {
      const BodyPair& pair = neighbours_[at[k]];
      const Slot a = slots.slot_of[pair.a], b = slots.slot_of[pair.b];
      pairs_[k] = {a, b, a, b};
      place_[at[k]] = k;
    }
  }
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  chunk_begin_.resize(chunks + 1);
  for (std::size_t c = 0; c <= chunks; ++c) chunk_begin_[c] = begin[std::min(c * kChunk, n)];
  order_flat_pairs(slots, with_flats);
}

/// `numbers` of such pairs among neighbours_.
void BallContacts::order_flat_pairs(const Slots& slots, std::vector<std::uint32_t>& numbers) {
  const auto make = [&](std::uint32_t p) {
    const Slot a = slots.slot_of[neighbours_[p].a], b = slots.slot_of[neighbours_[p].b];
    const bool ball_is_b = slots.is_ball(b);
    const Slot flat = ball_is_b ? a : b;
    return FlatPair{ball_is_b ? b : a, static_cast<std::uint32_t>(slots.flat_of(flat)), flat, ball_is_b};
  };
  std::ranges::sort(numbers, {}, [&](std::uint32_t p) {
    const FlatPair pair = make(p);
    return std::pair{pair.ball, pair.flat};
  });
  flat_pairs_.clear();
  flat_begin_.assign(1, 0);
  for (const std::uint32_t p : numbers) {
    const auto at = static_cast<std::uint32_t>(flat_pairs_.size());
    const FlatPair pair = make(p);
    while (pair.ball >= flat_begin_.size() * kChunk) flat_begin_.push_back(at);
    place_[p] = static_cast<std::uint32_t>(pairs_.size()) + at;
    flat_pairs_.push_back(pair);
  }
  flat_begin_.resize(chunk_begin_.size(), static_cast<std::uint32_t>(flat_pairs_.size()));
}

/// Gives each chunk a place for every body of another chunk that it acts on.
void BallContacts::find_ghosts(std::size_t bodies) {
  const std::size_t chunks = chunk_begin_.size() - 1;
  std::vector<std::uint32_t> ghost_of(bodies, kNone);
  std::vector<Incoming> all;  // slots by ghost
  std::vector<Slot> touched;
  ghost_begin_.assign(1, 0);
  for (std::size_t c = 0; c < chunks; ++c) {
    const auto first = static_cast<Slot>(c * kChunk);
    touched.clear();
    const auto place_of = [&](Slot slot) {
      if (slot - first < kChunk) return slot;
      if (ghost_of[slot] == kNone) {
        ghost_of[slot] = static_cast<std::uint32_t>(touched.size());
        touched.push_back(slot);
      }
      return static_cast<Slot>(bodies + ghost_begin_.back() + ghost_of[slot]);
    };
    for (std::size_t k = chunk_begin_[c]; k < chunk_begin_[c + 1]; ++k) {
      pairs_[k].to_a = place_of(pairs_[k].a);
      pairs_[k].to_b = place_of(pairs_[k].b);
    }
    for (std::size_t k = flat_begin_[c]; k < flat_begin_[c + 1]; ++k) {
      flat_pairs_[k].to_flat = place_of(flat_pairs_[k].to_flat);
    }
    for (const Slot slot : touched) {
      all.push_back({slot, ghost_begin_.back() + ghost_of[slot]});
      ghost_of[slot] = kNone;
    }
    ghost_begin_.push_back(ghost_begin_.back() + static_cast<std::uint32_t>(touched.size()));
  }
  std::ranges::sort(all, [](const Incoming& l, const Incoming& r) {
    return std::pair{l.slot, l.ghost} < std::pair{r.slot, r.ghost};
  });
  incoming_ = std::move(all);
  incoming_begin_.assign(chunks + 1, static_cast<std::uint32_t>(incoming_.size()));
  std::uint32_t k = 0;
  for (std::size_t c = 0; c < chunks; ++c) {
    incoming_begin_[c] = k;
    while (k < incoming_.size() && incoming_[k].slot < (c + 1) * kChunk) ++k;
  }
}

/// Both lists are sorted: one walk finds what they share.
void BallContacts::carry_over(std::span<const BodyPair> from, std::span<const std::uint32_t> place,
                              std::span<const Lanes> records, std::span<const std::uint8_t> flags,
                              std::span<const Vec3> before) {
  std::size_t p = 0;
  for (std::size_t old = 0; old < from.size(); ++old) {
    const std::uint32_t was = place[old];
    if (flags[was] == 0) continue;
    while (p < neighbours_.size() && comes_before(neighbours_[p], from[old])) ++p;
    if (p == neighbours_.size()) return;
    if (neighbours_[p] != from[old]) continue;
    const std::uint32_t is = place_[p];
    std::copy_n(records.begin() + static_cast<std::ptrdiff_t>(stride_ * was), stride_,
                records_.begin() + static_cast<std::ptrdiff_t>(stride_ * is));
    flags_[is] = flags[was];
    before_[is] = before[was];
  }
}

void BallContacts::renumber(std::span<const BodyIndex> index) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < neighbours_.size(); ++p) {
    const BodyPair pair{index[neighbours_[p].a], index[neighbours_[p].b]};
    if (pair.a == kGone || pair.b == kGone) continue;
    neighbours_[kept] = pair;
    place_[kept++] = place_[p];
  }
  neighbours_.resize(kept);
  place_.resize(kept);
}

void BallContacts::save(StateWriter& out, std::span<const BodyId> ids) const {
  std::vector<std::uint64_t> bodies;
  std::vector<std::uint64_t> leaving;
  std::vector<double> history;
  for (std::size_t p = 0; p < neighbours_.size(); ++p) {
    const std::uint32_t at = place_[p];
    if ((flags_[at] & kTouching) == 0) continue;
    leaving.push_back((flags_[at] & kLeaving) != 0 ? 1 : 0);
    bodies.push_back(ids[neighbours_[p].a]);
    bodies.push_back(ids[neighbours_[p].b]);
    for (std::size_t j = 0; j < history_; ++j) history.push_back(records_[stride_ * at + j / 4][j % 4]);
  }
  out.write("ball_bodies", bodies);
  out.write("ball_leaving", leaving);
  out.write("ball_history", history);
}

void BallContacts::load(const StateReader& in, std::span<const BodyId> ids) {
  const std::vector<std::uint64_t> bodies = in.integers("ball_bodies");
  const std::vector<std::uint64_t> leaving = in.integers("ball_leaving");
  const std::vector<double> history = in.doubles("ball_history");
  const std::size_t m = bodies.size() / 2;
  const auto index = [&](BodyId id) { return static_cast<BodyIndex>(std::ranges::lower_bound(ids, id) - ids.begin()); };
  neighbours_.resize(m), place_.resize(m);
  records_.assign(stride_ * m, Lanes{});
  flags_.assign(m, kTouching);
  before_.assign(m, Vec3{});
  for (std::size_t p = 0; p < m; ++p) {
    neighbours_[p] = {index(bodies[2 * p]), index(bodies[2 * p + 1])};
    place_[p] = static_cast<std::uint32_t>(p);
    if (leaving[p] != 0) flags_[p] |= kLeaving;
    for (std::size_t j = 0; j < history_; ++j) records_[stride_ * p + j / 4][j % 4] = history[history_ * p + j];
  }
}

}  // namespace scree::dem
