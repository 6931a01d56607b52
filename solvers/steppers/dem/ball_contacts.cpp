#include "ball_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "ball_work.hpp"
#include "scree/parallel/executor.hpp"
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace scree::dem {
namespace {

constexpr std::size_t kChunk = Verlet::kChunk;
constexpr std::size_t kPrefetch = 12;              // pairs ahead
constexpr std::size_t kLine = 64 / sizeof(Lanes);  // of the cache

/// Bit k: a[k] < b[k].
unsigned less(const Lanes& a, const Lanes& b) {
  const auto which = a < b;
#ifdef __AVX__
  Lanes bits;
  std::memcpy(&bits, &which, sizeof bits);
  return static_cast<unsigned>(_mm256_movemask_pd(bits));
#else
  unsigned out = 0;
  for (unsigned k = 0; k < 4; ++k) out |= which[k] != 0 ? 1u << k : 0u;
  return out;
#endif
}

}  // namespace

/// Of the pairs first .. last - 1, finds those that touch and those that do no longer. Whether a pair touches cannot be foreseen:
/// it is written down in any case, and counted when it does.
void BallContacts::look_at(const Slots& slots, double reach, std::size_t first, std::size_t last, BallWork& w) const {
  w.first = 0;
  const Place* const place = slots.place.data();
  const Moving* const moving = slots.moving.data();
  const Pair* const pairs = pairs_.data();
  const std::uint8_t* const flags = list_.flags.data();
  const Lanes* const records = list_.records.data();
  std::size_t hits = 0, parted = 0;
  for (std::size_t group = first; group < last; group += 4) {
    const std::size_t most = std::min<std::size_t>(4, last - group), soon = group + kPrefetch;
    for (std::size_t j = soon; j < std::min(soon + 4, pairs_.size()); ++j) {
      __builtin_prefetch(&place[pairs[j].b]);
      __builtin_prefetch(&moving[pairs[j].b]);
    }
    // What contacts keep is read next, and lies far apart where few of the pairs touch.
    for (std::size_t at = stride_ * group; at < stride_ * (group + most); at += kLine)
      __builtin_prefetch(records + at, 1);
    std::array<Lanes, 4> apart;
    for (std::size_t j = 0; j < 4; ++j) {
      const Pair& pair = pairs[group + (most == 4 ? j : j % most)];
      apart[j] = four_of(place[pair.b]) + kAway * four_of(place[pair.a]);
    }
    Lanes x = apart[0], y = apart[1], z = apart[2], radii = apart[3];
    transpose(x, y, z, radii);
    radii += reach;
    const unsigned touching = less(x * x + y * y + z * z, radii * radii);
    for (std::size_t j = 0; j < most; ++j) {
      const unsigned touch = touching >> j & 1;
      w.apart[hits] = apart[j];
      w.hit[hits] = w.gone[parted] = static_cast<std::uint32_t>(group + j);
      hits += touch;
      parted += (1 - touch) & (flags[group + j] & kTouching);
    }
  }
  w.batch.count = hits;
  w.parted = parted;
  fill_lanes(w);
}

ContactTally BallContacts::evaluate_chunk(Slots& slots, const Evaluation& e, std::size_t chunk) {
  const auto clear = [&](std::size_t first, std::size_t last) {
    std::fill(slots.wrench.begin() + static_cast<std::ptrdiff_t>(first),
              slots.wrench.begin() + static_cast<std::ptrdiff_t>(last), Wrench{});
  };
  clear(chunk * kChunk, std::min((chunk + 1) * kChunk, slots.size()));
  clear(slots.size() + ghost_begin_[chunk], slots.size() + ghost_begin_[chunk + 1]);
  BallWork w;
  w.batch.lead = 0.5 * e.h;
  w.batch.materials = {};
  // Looks at the pairs `begin` .. `end` - 1 of one kind, and lets those that touch act.
  const auto go_over = [&](std::size_t begin, std::size_t end, const auto& look, const auto& find_state,
                           const auto& add) {
    for (std::size_t k = begin; k < end; k += kPairsAtOnce) {
      look(k, std::min(k + kPairsAtOnce, end));
      let_go(w);
      if (w.batch.count == 0) continue;
      find_state();
      recall(w);
      apply_law(e, w);
      add();
      keep(e, w);
    }
  };
  go_over(
      chunk_begin_[chunk], chunk_begin_[chunk + 1],
      [&](std::size_t first, std::size_t last) { look_at(slots, e.reach, first, last, w); },
      [&] { measure(slots, e, w), gather(slots, e, w); }, [&] { scatter(slots, w); });
  go_over(
      flat_begin_[chunk], flat_begin_[chunk + 1],
      [&](std::size_t first, std::size_t last) { look_at_flats(slots, e.reach, first, last, w); },
      [&] { measure_flats(slots, e, w), gather_flats(slots, e, w); }, [&] { scatter_flats(slots, e, w); });
  for (std::size_t k = 0; k < 4; ++k) w.tally.greatest_overlap = std::max(w.tally.greatest_overlap, w.greatest[k]);
  return w.tally;
}

ContactTally BallContacts::evaluate(Slots& slots, const Evaluation& e, const Executor& executor) {
  const std::size_t chunks = Executor::chunk_count(slots.size(), kChunk);
  tally_.assign(chunks, ContactTally{});
  slots.wrench.resize(slots.size() + ghost_begin_.back());
  executor.for_chunks(chunks, 1,
                      [&](std::size_t chunk, std::size_t) { tally_[chunk] = evaluate_chunk(slots, e, chunk); });
  executor.for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t) {
    for (std::size_t k = incoming_begin_[chunk]; k < incoming_begin_[chunk + 1]; ++k) {
      slots.wrench[incoming_[k].slot] += slots.wrench[incoming_[k].ghost];
    }
  });
  ContactTally sum;
  for (const ContactTally& tally : tally_) sum += tally;
  return sum;
}

}  // namespace scree::dem
