// The part of CollisionPipeline that chooses among pairs of spheres: four at a time.
#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#include "scree/collision/collision_pipeline.hpp"
#include "scree/collision/swept_spheres.hpp"

namespace scree {
namespace {

/// Pairs side by side.
constexpr std::size_t kSide = 4;
/// Pairs that are looked at before those are written that can meet.
constexpr std::size_t kBatch = 128;
/// Pairs ahead of the present one whose second ball is fetched into the cache.
constexpr std::size_t kPrefetch = 16;
constexpr unsigned kAll = (1u << kSide) - 1u;

/// What decides for four pairs.
struct Four {
  std::array<double, kSide> least;  // radius of the smaller one [m]
  unsigned touching = 0;            // a bit a pair, set for two spheres that overlap by more than rounding
};

#ifdef __AVX2__

Four look_at(const BoundingBall* ball, const CandidatePair* pair) {
  static_assert(sizeof(BoundingBall) == 32 && offsetof(BoundingBall, radius) == 24);
  const auto load = [&](ColliderIndex i) { return _mm256_loadu_pd(&ball[i].centre.x); };
  // Difference of centres and sum of radii, and the smaller radius at the end of the other one.
  struct Row {
    __m256d way, least;
  };
  const auto row = [&](const CandidatePair& p) {
    const __m256d a = load(p.a), b = load(p.b);
    return Row{_mm256_blend_pd(_mm256_sub_pd(b, a), _mm256_add_pd(a, b), 0b1000), _mm256_min_pd(a, b)};
  };
  const Row r0 = row(pair[0]), r1 = row(pair[1]), r2 = row(pair[2]), r3 = row(pair[3]);
  const auto low = [](__m256d l, __m256d r) { return _mm256_permute2f128_pd(l, r, 0x20); };
  const auto high = [](__m256d l, __m256d r) { return _mm256_permute2f128_pd(l, r, 0x31); };
  const __m256d even_01 = _mm256_unpacklo_pd(r0.way, r1.way), odd_01 = _mm256_unpackhi_pd(r0.way, r1.way);
  const __m256d even_23 = _mm256_unpacklo_pd(r2.way, r3.way), odd_23 = _mm256_unpackhi_pd(r2.way, r3.way);
  const __m256d x = low(even_01, even_23), y = low(odd_01, odd_23), z = high(even_01, even_23);
  const __m256d radii = high(odd_01, odd_23);
  Four four;
  _mm256_storeu_pd(four.least.data(),
                   high(_mm256_unpackhi_pd(r0.least, r1.least), _mm256_unpackhi_pd(r2.least, r3.least)));
  const auto square = [](__m256d v) { return _mm256_mul_pd(v, v); };
  const __m256d distance2 = _mm256_add_pd(_mm256_add_pd(square(x), square(y)), square(z));
  const __m256d limit2 = square(_mm256_mul_pd(_mm256_set1_pd(kTouching), radii));
  const __m256d finite = _mm256_cmp_pd(limit2, _mm256_set1_pd(std::numeric_limits<double>::infinity()), _CMP_LT_OQ);
  four.touching =
      static_cast<unsigned>(_mm256_movemask_pd(_mm256_and_pd(finite, _mm256_cmp_pd(distance2, limit2, _CMP_LE_OQ))));
  return four;
}

/// Writes four pairs.
void put(const CandidatePair* pair, const std::array<double, kSide>& reach, ColliderPair* out) {
  static_assert(sizeof(CandidatePair) == 8 && sizeof(ColliderPair) == 16 && offsetof(ColliderPair, reach) == 8);
  const __m256d names = _mm256_castsi256_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pair)));
  const __m256d reaches = _mm256_loadu_pd(reach.data());
  const __m256d even = _mm256_unpacklo_pd(names, reaches), odd = _mm256_unpackhi_pd(names, reaches);
  auto* const place = reinterpret_cast<double*>(out);
  _mm256_storeu_pd(place, _mm256_permute2f128_pd(even, odd, 0x20));
  _mm256_storeu_pd(place + 4, _mm256_permute2f128_pd(even, odd, 0x31));
}

#else

Four look_at(const BoundingBall* ball, const CandidatePair* pair) {
  Four four;
  for (std::size_t k = 0; k < kSide; ++k) {
    const BoundingBall &a = ball[pair[k].a], &b = ball[pair[k].b];
    four.least[k] = std::min(a.radius, b.radius);
    const double limit = kTouching * (a.radius + b.radius), limit2 = limit * limit;
    const bool touch = squared_norm(b.centre - a.centre) <= limit2 && limit2 < std::numeric_limits<double>::infinity();
    four.touching |= static_cast<unsigned>(touch) << k;
  }
  return four;
}

void put(const CandidatePair* pair, const std::array<double, kSide>& reach, ColliderPair* out) {
  for (std::size_t k = 0; k < kSide; ++k) out[k] = {pair[k].a, pair[k].b, reach[k]};
}

#endif

/// Of those four pairs, which lie in `out` and may be kept, keeps those that `kept` has, a bit a pair; returns their end.
ColliderPair* close_up(ColliderPair* out, unsigned kept) {
  ColliderPair* end = out;
  for (std::size_t k = 0; k < kSide; ++k) {
    *end = out[k];
    end += kept >> k & 1u;
  }
  return end;
}

}  // namespace

/// Of spheres that touch already the contact is wanted whatever their velocities, which are not read: they get the reach of
/// spheres at rest.
ColliderPair* CollisionPipeline::keep_spheres(std::span<const CandidatePair> batch, ColliderPair* out) const {
  const ColliderView view = colliders_.view();
  const Vec3* const velocity = colliders_.velocity().data();
  const bool all_movable = colliders_.all_spheres_movable();
  // Writes four pairs and returns the end of those that are kept.
  const auto keep_four = [&](const CandidatePair* pair, const Four& four, unsigned kept, ColliderPair* place) {
    std::array<double, kSide> reach;
    for (std::size_t k = 0; k < kSide; ++k) reach[k] = rule_.slack * four.least[k] + rule_.skin;
    put(pair, reach, place);
    for (unsigned apart = ~four.touching & kAll; apart != 0; apart &= apart - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(apart));
      const ColliderMotion a = colliders_.motion(pair[k].a), b = colliders_.motion(pair[k].b);
      place[k].reach = reach_of_spheres(a, b, rule_);
      if (!swept_spheres_meet(a, b, place[k].reach, rule_)) kept &= ~(1u << k);
    }
    for (std::size_t k = 0; k < kSide && !all_movable; ++k) {
      if (view.movable[pair[k].a] == 0 && view.movable[pair[k].b] == 0) kept &= ~(1u << k);
    }
    return kept == kAll ? place + kSide : close_up(place, kept);
  };
  std::array<Four, kBatch / kSide> fours;
  std::size_t first = 0;
  while (first + kSide <= batch.size()) {
    const std::size_t groups = std::min(kBatch, batch.size() - first) / kSide;
    for (std::size_t g = 0; g < groups; ++g) {
      const CandidatePair* const pair = &batch[first + kSide * g];
      if (first + kSide * g + kPrefetch + kSide <= batch.size()) {
        for (std::size_t k = 0; k < kSide; ++k) __builtin_prefetch(&view.ball[pair[kPrefetch + k].b]);
      }
      fours[g] = look_at(view.ball.data(), pair);
      for (unsigned apart = ~fours[g].touching & kAll; apart != 0; apart &= apart - 1) {
        __builtin_prefetch(&velocity[pair[std::countr_zero(apart)].a]);
        __builtin_prefetch(&velocity[pair[std::countr_zero(apart)].b]);
      }
    }
    for (std::size_t g = 0; g < groups; ++g) out = keep_four(&batch[first + kSide * g], fours[g], kAll, out);
    first += kSide * groups;
  }
  const std::size_t rest = batch.size() - first;
  if (rest == 0) return out;
  std::array<CandidatePair, kSide> last;
  last.fill(batch.back());
  std::copy(batch.end() - static_cast<std::ptrdiff_t>(rest), batch.end(), last.begin());
  std::array<ColliderPair, kSide> kept;
  const Four four = look_at(view.ball.data(), last.data());
  return std::copy(kept.data(), keep_four(last.data(), four, (1u << rest) - 1u, kept.data()), out);
}

}  // namespace scree
