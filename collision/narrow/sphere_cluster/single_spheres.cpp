#include "single_spheres.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scree::sphere_cluster {
namespace {

/// Contacts that are handed over at a time; until then they lie in the nearest cache.
constexpr std::size_t kBatch = 64;
/// Pairs side by side.
constexpr std::size_t kSide = 4;

/// Of a contact, all but numbers.
void name(const ColliderView& colliders, const ColliderPair& pair, Contact& contact) {
  contact.a = colliders.body[pair.a];
  contact.b = colliders.body[pair.b];
  contact.primitive_a = colliders.ordinal[pair.a];
  contact.primitive_b = colliders.ordinal[pair.b];
  contact.feature = 0;
}

#ifdef __AVX2__

/// Four numbers of each of four things, column by column.
struct Columns {
  __m256d x, y, z, w;
};

/// Rows and columns exchanged.
Columns transposed(__m256d a, __m256d b, __m256d c, __m256d d) {
  const __m256d low_ab = _mm256_unpacklo_pd(a, b), high_ab = _mm256_unpackhi_pd(a, b);
  const __m256d low_cd = _mm256_unpacklo_pd(c, d), high_cd = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(low_ab, low_cd, 0x20), _mm256_permute2f128_pd(high_ab, high_cd, 0x20),
          _mm256_permute2f128_pd(low_ab, low_cd, 0x31), _mm256_permute2f128_pd(high_ab, high_cd, 0x31)};
}

__m256d square(__m256d x) { return _mm256_mul_pd(x, x); }

/// Four pairs of spheres.
struct Four {
  Columns a;    // centre and radius of the first ones [m]
  Columns way;  // from them to the others, and the sum of radii [m]
  __m256d distance2, distance;

  Four(const BoundingBall* ball, const ColliderPair* pair) {
    static_assert(sizeof(BoundingBall) == 32 && offsetof(BoundingBall, radius) == 24);
    const auto load = [&](ColliderIndex i) { return _mm256_loadu_pd(&ball[i].centre.x); };
    const auto between = [&](__m256d from, ColliderIndex i) {
      const __m256d to = load(i);
      return _mm256_blend_pd(_mm256_sub_pd(to, from), _mm256_add_pd(from, to), 0b1000);
    };
    const __m256d a0 = load(pair[0].a), a1 = load(pair[1].a), a2 = load(pair[2].a), a3 = load(pair[3].a);
    a = transposed(a0, a1, a2, a3);
    way = transposed(between(a0, pair[0].b), between(a1, pair[1].b), between(a2, pair[2].b), between(a3, pair[3].b));
    distance2 = _mm256_add_pd(_mm256_add_pd(square(way.x), square(way.y)), square(way.z));
    distance = _mm256_sqrt_pd(distance2);
  }
};

/// The reaches of four pairs [m].
__m256d reaches(const ColliderPair* pair) {
  static_assert(sizeof(ColliderPair) == 16 && offsetof(ColliderPair, reach) == 8);
  const __m256d two = _mm256_loadu_pd(reinterpret_cast<const double*>(pair));
  const __m256d more = _mm256_loadu_pd(reinterpret_cast<const double*>(pair + 2));
  return _mm256_permute4x64_pd(_mm256_unpackhi_pd(two, more), 0b11011000);
}

/// Writes the contacts of the first `used` of four pairs to `place`, which has room for four, and returns how many there are.
std::size_t write(const ColliderView& colliders, const Four& four, const ColliderPair* pair, std::size_t used,
                  Contact* place) {
  const __m256d d = four.distance, gap = _mm256_sub_pd(d, four.way.w);
  const __m256d far = _mm256_add_pd(four.a.w, _mm256_mul_pd(_mm256_set1_pd(0.5), gap));
  const __m256d inverse = _mm256_div_pd(_mm256_set1_pd(1.0), d);
  // Down when the centres are too near each other to give a direction.
  const __m256d apart = _mm256_cmp_pd(d, _mm256_set1_pd(1e-300), _CMP_GT_OQ);
  const __m256d nx = _mm256_and_pd(apart, _mm256_mul_pd(four.way.x, inverse));
  const __m256d ny = _mm256_and_pd(apart, _mm256_mul_pd(four.way.y, inverse));
  const __m256d nz = _mm256_blendv_pd(_mm256_set1_pd(-1.0), _mm256_mul_pd(four.way.z, inverse), apart);
  const auto along = [&](__m256d from, __m256d n) { return _mm256_add_pd(from, _mm256_mul_pd(far, n)); };
  const Columns point = transposed(along(four.a.x, nx), along(four.a.y, ny), along(four.a.z, nz), nx);
  const Columns rest = transposed(nx, ny, nz, gap);
  const __m256d beyond = _mm256_cmp_pd(four.distance2, square(_mm256_add_pd(four.way.w, reaches(pair))), _CMP_GE_OQ);
  const unsigned within = ~static_cast<unsigned>(_mm256_movemask_pd(beyond)) & ((1u << used) - 1u);
  // All are written, over those that do not count: a branch here would often be guessed wrong.
  std::size_t count = 0;
  const auto put = [&](std::size_t k, __m256d of_point, __m256d of_rest) {
    static_assert(offsetof(Contact, normal) == offsetof(Contact, point) + 24 &&
                  offsetof(Contact, gap) == offsetof(Contact, normal) + 24);
    Contact& contact = place[count];
    name(colliders, pair[k], contact);
    auto* const bytes = reinterpret_cast<std::byte*>(&contact);
    _mm256_storeu_pd(reinterpret_cast<double*>(bytes + offsetof(Contact, point)), of_point);
    _mm256_storeu_pd(reinterpret_cast<double*>(bytes + offsetof(Contact, normal)), of_rest);
    count += within >> k & 1u;
  };
  put(0, point.x, rest.x);
  put(1, point.y, rest.y);
  put(2, point.z, rest.z);
  put(3, point.w, rest.w);
  return count;
}

#else

/// Four pairs of spheres.
struct Four {
  std::array<Vec3, kSide> way;
  std::array<double, kSide> distance2, distance;

  Four(const BoundingBall* ball, const ColliderPair* pair) {
    for (std::size_t k = 0; k < kSide; ++k) {
      way[k] = ball[pair[k].b].centre - ball[pair[k].a].centre;
      distance2[k] = squared_norm(way[k]);
      distance[k] = std::sqrt(distance2[k]);
    }
  }
};

std::size_t write(const ColliderView& colliders, const Four& four, const ColliderPair* pair, std::size_t used,
                  Contact* place) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < used; ++k) {
    const BoundingBall& a = colliders.ball[pair[k].a];
    const double radii = a.radius + colliders.ball[pair[k].b].radius, limit = radii + pair[k].reach;
    if (four.distance2[k] >= limit * limit) continue;
    const double d = four.distance[k], inverse = 1.0 / d, gap = d - radii;
    // Down when the centres are too near each other to give a direction.
    const Vec3 normal = d > 1e-300 ? inverse * four.way[k] : Vec3{0, 0, -1};
    Contact& contact = place[count++];
    name(colliders, pair[k], contact);
    contact.point = a.centre + (a.radius + 0.5 * gap) * normal;
    contact.normal = normal;
    contact.gap = gap;
  }
  return count;
}

#endif

/// Fetches what comes soon: the names of the second colliders, whose balls were read when pairs were chosen, and
/// the lines where the contacts go.
void fetch(const ColliderView& colliders, const ColliderPair* pair, const Contact* target) {
  for (std::size_t k = 0; k < kSide; ++k) {
    __builtin_prefetch(&colliders.body[pair[k].b]);
    __builtin_prefetch(&colliders.ordinal[pair[k].b]);
  }
  constexpr std::size_t kLine = 64;
  const auto* const bytes = reinterpret_cast<const std::byte*>(target);
  for (std::size_t at = 0; at < kSide * sizeof(Contact); at += kLine) __builtin_prefetch(bytes + at, 1);
}

}  // namespace

void collide_spheres(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) {
  constexpr std::size_t kAhead = 16;
  const BoundingBall* const ball = colliders.ball.data();
  // Memory alone: contacts begin to live when they are written.
  alignas(32) std::array<std::byte, (kBatch + kSide) * sizeof(Contact)> room;
  auto* const batch = reinterpret_cast<Contact*>(room.data());
  std::size_t filled = 0;
  const auto flush = [&] {
    out.insert(out.end(), batch, batch + filled);
    filled = 0;
  };
  const std::size_t rest = pairs.size() % kSide, whole = pairs.size() - rest;
  if (whole > 0) {
    // Roots take long: those of the next four are begun before the present four are written.
    Four four{ball, pairs.data()};
    for (std::size_t first = 0; first < whole; first += kSide) {
      if (first + kAhead + kSide <= whole) {
        fetch(colliders, &pairs[first + kAhead], out.data() + out.size() + filled);
      }
      const Four next{ball, &pairs[first + kSide < whole ? first + kSide : first]};
      filled += write(colliders, four, &pairs[first], kSide, batch + filled);
      four = next;
      if (filled >= kBatch) flush();
    }
  }
  if (rest > 0) {
    std::array<ColliderPair, kSide> last;
    last.fill(pairs.back());
    std::copy(pairs.end() - static_cast<std::ptrdiff_t>(rest), pairs.end(), last.begin());
    filled += write(colliders, Four{ball, last.data()}, last.data(), rest, batch + filled);
  }
  flush();
}

}  // namespace scree::sphere_cluster
