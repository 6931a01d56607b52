#include "scree/collision/pair_sorter.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>

#include "scree/base/release.hpp"

namespace scree {
namespace {

/// Pairs that in_order() hands over at a time.
constexpr std::size_t kBatch = 512;
/// Up to here pairs are sorted without a branch.
constexpr std::size_t kFew = 4;
/// Up to here a sort by insertion is faster than std::sort.
constexpr std::ptrdiff_t kSome = 24;

void sort_some(ColliderIndex* first, ColliderIndex* last) {
  if (last - first > kSome) return std::sort(first, last);
  for (ColliderIndex* i = first + 1; i < last; ++i) {
    const ColliderIndex moving = *i;
    ColliderIndex* hole = i;
    for (; hole > first && moving < hole[-1]; --hole) *hole = hole[-1];
    *hole = moving;
  }
}

/// Writes the pairs of a with up to kFew others, sorted, to `out`, which has room for kFew.
#ifdef __AVX2__
void write_few(ColliderIndex a, const ColliderIndex* other, std::size_t count, CandidatePair* out) {
  const __m128i lanes = _mm_set_epi32(3, 2, 1, 0);
  const __m128i used = _mm_cmpgt_epi32(_mm_set1_epi32(static_cast<int>(count)), lanes);
  __m128i v = _mm_maskload_epi32(reinterpret_cast<const int*>(other), used);
  v = _mm_or_si128(v, _mm_xor_si128(used, _mm_set1_epi32(-1)));  // unused lanes go to the end
  // A sorting network: neighbours, then outer and inner two, then neighbours.
  const auto exchange = [](__m128i mine, __m128i theirs, auto upper) {
    return _mm_blend_epi32(_mm_min_epu32(mine, theirs), _mm_max_epu32(mine, theirs), upper());
  };
  v = exchange(v, _mm_shuffle_epi32(v, _MM_SHUFFLE(2, 3, 0, 1)), [] { return 0b1010; });
  v = exchange(v, _mm_shuffle_epi32(v, _MM_SHUFFLE(0, 1, 2, 3)), [] { return 0b1100; });
  v = exchange(v, _mm_shuffle_epi32(v, _MM_SHUFFLE(2, 3, 0, 1)), [] { return 0b1010; });
  const __m128i first = _mm_set1_epi32(static_cast<int>(a));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_unpacklo_epi32(first, v));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out + 2), _mm_unpackhi_epi32(first, v));
}
#else
void write_few(ColliderIndex a, const ColliderIndex* other, std::size_t count, CandidatePair* out) {
  std::array<ColliderIndex, kFew> v;
  std::copy_n(other, count, v.begin());
  sort_some(v.data(), v.data() + count);
  for (std::size_t k = 0; k < count; ++k) out[k] = {a, v[k]};
}
#endif

}  // namespace

void PairSorter::sort(std::span<const CandidatePair> candidates, std::size_t colliders) {
  // Counts land one place late, so that after the scatter first_[a] is where the pairs of a begin.
  first_.assign(colliders + 2, 0);
  for (const CandidatePair& pair : candidates) ++first_[std::size_t{std::min(pair.a, pair.b)} + 2];
  for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
  resize_kept(candidates.size(), other_);
  for (const CandidatePair& pair : candidates) {
    other_[first_[std::size_t{std::min(pair.a, pair.b)} + 1]++] = std::max(pair.a, pair.b);
  }
}

void PairSorter::in_order(std::size_t first, std::size_t last,
                          const std::function<void(std::span<const CandidatePair>)>& take) {
  std::array<CandidatePair, kBatch + kFew> batch;
  std::size_t filled = 0;
  const auto flush = [&] {
    take(std::span{batch}.first(filled));
    filled = 0;
  };
  for (std::size_t i = first; i < last; ++i) {
    const auto a = static_cast<ColliderIndex>(i);
    ColliderIndex* const other = other_.data() + first_[i];
    const std::size_t count = first_[i + 1] - first_[i];
    if (count <= kFew) {
      write_few(a, other, count, &batch[filled]);
      filled += count;
    } else {
      sort_some(other, other + count);
      for (std::size_t k = 0; k < count; ++k) {
        batch[filled++] = {a, other[k]};
        if (filled >= kBatch) flush();
      }
    }
    if (filled >= kBatch) flush();
  }
  if (filled > 0) flush();
}

void PairSorter::release_buffers() { release(first_, other_); }

}  // namespace scree
