// Balls: the balls of sorted boxes, side by side, so that one ball is compared with eight others at a time.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "rows.hpp"
#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"

namespace scree::grid {

/// Coordinates are brought below this [m], in order: the square of what is absurdly far remains a number.
inline constexpr double kFarthest = 1e17;
/// A coordinate in single precision.
inline float rounded(double x) { return static_cast<float>(std::clamp(x, -kFarthest, kFarthest)); }

/// In single precision, about the grid's origin [m]; grown by more than its rounding.
struct Ball {
  float x = 0.0f, y = 0.0f, z = 0.0f, r = 0.0f;

  Ball() = default;
  Ball(const Vec3& centre, double radius)
      : x{rounded(centre.x)},
        y{rounded(centre.y)},
        z{rounded(centre.z)},
        r{grown(radius, std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z))} {}

  /// The radius of a ball whose coordinates add up to `far`.
  static float grown(double radius, double far) {
    // Rounding of coordinates, of their differences and of the squares: below 8 units in the last place, 6e-8 each.
    constexpr double kGrowth = 5e-7;
    return static_cast<float>(std::min(radius * (1.0 + kGrowth) + kGrowth * far + 1e-30, 1e18));
  }
};

/// A list of balls.
class Balls {
 public:
  static constexpr std::size_t kLanes = 8;

  void resize(std::size_t n) {
    stride_ = n + kLanes;  // a load may read beyond the last one
    all_.resize(4 * stride_);
  }
  void set(std::size_t i, const Ball& ball) {
    all_[i] = ball.x;
    all_[stride_ + i] = ball.y;
    all_[2 * stride_ + i] = ball.z;
    all_[3 * stride_ + i] = ball.r;
  }
  [[nodiscard]] Ball operator[](std::size_t i) const {
    Ball ball;
    ball.x = x_of(i), ball.y = y_of(i), ball.z = z_of(i), ball.r = r_of(i);
    return ball;
  }
  void release() { UninitialisedVector<float>{}.swap(all_); }

  /// Writes the pairs of i with those of first..last-1 that it meets to `near`, which has room for kLanes more than that, and
  /// returns how many. What is not a number meets all.
  std::size_t meeting(std::uint32_t i, std::uint32_t first, std::uint32_t last, CandidatePair* near) const;
  /// Those of short rows that ball i meets, as Rows::items has them. What is not a number meets all.
  [[nodiscard]] std::uint64_t meeting_short(std::uint32_t i, const Rows& rows) const;

 private:
  [[nodiscard]] const float& x_of(std::size_t i) const { return all_[i]; }
  [[nodiscard]] const float& y_of(std::size_t i) const { return all_[stride_ + i]; }
  [[nodiscard]] const float& z_of(std::size_t i) const { return all_[2 * stride_ + i]; }
  [[nodiscard]] const float& r_of(std::size_t i) const { return all_[3 * stride_ + i]; }

  UninitialisedVector<float> all_;  // all x, then y, z and r: one block
  std::size_t stride_ = 0;
};

#ifdef __AVX2__

/// For each set of lanes, the lanes in order, at the front.
alignas(32) inline constexpr auto kFrontLanes = [] {
  std::array<std::array<std::uint32_t, 8>, 256> table{};
  for (std::uint32_t set = 0; set < 256; ++set) {
    std::uint32_t count = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      if ((set >> lane & 1u) != 0) table[set][count++] = lane;
    }
  }
  return table;
}();

inline __m256 sum_of_squares(__m256 x, __m256 y, __m256 z) {
#ifdef __FMA__
  return _mm256_fmadd_ps(z, z, _mm256_fmadd_ps(y, y, _mm256_mul_ps(x, x)));
#else
  return _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
#endif
}

inline std::size_t Balls::meeting(std::uint32_t i, std::uint32_t first, std::uint32_t last, CandidatePair* near) const {
  const float *const xs = all_.data(), *const ys = xs + stride_, *const zs = ys + stride_, *const rs = zs + stride_;
  const __m256 x = _mm256_set1_ps(x_of(i)), y = _mm256_set1_ps(y_of(i)), z = _mm256_set1_ps(z_of(i));
  const __m256 r = _mm256_set1_ps(r_of(i));
  const __m256i one = _mm256_set1_epi32(static_cast<int>(i));
  std::size_t count = 0;
  std::uint32_t k = first;
  // Most ranges fit into one round; it is done in any case, so that nothing has to be guessed.
  do {
    const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(xs + k), x), dy = _mm256_sub_ps(_mm256_loadu_ps(ys + k), y);
    const __m256 dz = _mm256_sub_ps(_mm256_loadu_ps(zs + k), z), radii = _mm256_add_ps(_mm256_loadu_ps(rs + k), r);
    const int hits =
        _mm256_movemask_ps(_mm256_cmp_ps(sum_of_squares(dx, dy, dz), _mm256_mul_ps(radii, radii), _CMP_NGT_UQ));
    const std::uint32_t left = std::min(last > k ? last - k : 0u, 8u);
    const std::uint32_t meet = static_cast<std::uint32_t>(hits) & ((1u << left) - 1u);
    const __m256i front = _mm256_load_si256(reinterpret_cast<const __m256i*>(kFrontLanes[meet].data()));
    const __m256i other = _mm256_add_epi32(front, _mm256_set1_epi32(static_cast<int>(k)));
    // Pairs (one, other): lanes 0 1 4 5, then 2 3 6 7.
    const __m256i low = _mm256_unpacklo_epi32(one, other), high = _mm256_unpackhi_epi32(one, other);
    auto* const out = reinterpret_cast<__m256i*>(near + count);
    _mm256_storeu_si256(out, _mm256_permute2x128_si256(low, high, 0x20));
    _mm256_storeu_si256(out + 1, _mm256_permute2x128_si256(low, high, 0x31));
    count += static_cast<std::size_t>(std::popcount(meet));
    k += kLanes;
  } while (k < last);
  return count;
}

inline std::uint64_t Balls::meeting_short(std::uint32_t i, const Rows& rows) const {
  const float *const xs = all_.data(), *const ys = xs + stride_, *const zs = ys + stride_, *const rs = zs + stride_;
  const __m256 x = _mm256_set1_ps(x_of(i)), y = _mm256_set1_ps(y_of(i)), z = _mm256_set1_ps(z_of(i));
  const __m256 r = _mm256_set1_ps(r_of(i));
  const auto meets = [&](std::size_t row) {
    const std::uint32_t k = rows.first[row];
    const __m256 dx = _mm256_sub_ps(x, _mm256_loadu_ps(xs + k)), dy = _mm256_sub_ps(y, _mm256_loadu_ps(ys + k));
    const __m256 dz = _mm256_sub_ps(z, _mm256_loadu_ps(zs + k)), radii = _mm256_add_ps(r, _mm256_loadu_ps(rs + k));
    const int hits =
        _mm256_movemask_ps(_mm256_cmp_ps(sum_of_squares(dx, dy, dz), _mm256_mul_ps(radii, radii), _CMP_NGT_UQ));
    return std::uint64_t{static_cast<std::uint32_t>(hits)} << (8 * row);
  };
  std::uint64_t meet = 0;
  for (std::size_t row = 0; row < Rows::kRows; ++row) meet |= meets(row);
  for (std::size_t row = Rows::kRows; row < rows.count; ++row) meet |= meets(row);
  return meet & rows.items;
}

#else

inline std::size_t Balls::meeting(std::uint32_t i, std::uint32_t first, std::uint32_t last, CandidatePair* near) const {
  std::size_t count = 0;
  for (std::uint32_t k = first; k < last; ++k) {
    const float dx = x_of(k) - x_of(i), dy = y_of(k) - y_of(i), dz = z_of(k) - z_of(i), radii = r_of(k) + r_of(i);
    near[count] = {i, k};  // overwritten by the next one unless it counts
    count += static_cast<std::size_t>(!(dx * dx + dy * dy + dz * dz > radii * radii));
  }
  return count;
}

inline std::uint64_t Balls::meeting_short(std::uint32_t i, const Rows& rows) const {
  std::uint64_t meet = 0;
  for (std::uint64_t left = rows.items; left != 0; left &= left - 1) {
    const std::uint32_t k = rows.item(static_cast<unsigned>(std::countr_zero(left)));
    const float dx = x_of(k) - x_of(i), dy = y_of(k) - y_of(i), dz = z_of(k) - z_of(i), radii = r_of(k) + r_of(i);
    if (!(dx * dx + dy * dy + dz * dz > radii * radii)) meet |= left & (0 - left);
  }
  return meet;
}

#endif

}  // namespace scree::grid
