#include "spatial_order.hpp"

#include <algorithm>
#include <array>

#include "scree/base/release.hpp"
#include "scree/math/aabb.hpp"

namespace scree::dvi {

namespace {

constexpr std::uint32_t kTouched = kNotInProblem - 1;
constexpr int kBitsPerAxis = 10;

// Spreads the lower 10 bits so that two zeros stand between any two of them.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000FFu;
  x = (x | (x << 8)) & 0x0300F00Fu;
  x = (x | (x << 4)) & 0x030C30C3u;
  return (x | (x << 2)) & 0x09249249u;
}

}  // namespace

void SpatialOrder::build(const BodyView& bodies, std::span<const Contact> contacts, std::span<const BodyIndex> joined) {
  number_.assign(bodies.size(), kNotInProblem);
  for (const BodyIndex i : joined) number_[i] = kTouched;
  for (const Contact& c : contacts) {
    number_[c.a] = kTouched;
    number_[c.b] = kTouched;
  }
  make_room(bodies.size(), coded_, scratch_);
  encode(bodies);
  sort_by_code();
  bodies_.clear();
  bodies_.reserve(coded_.size());
  for (const Coded& c : coded_) bodies_.push_back(c.body);
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (number_[i] == kTouched && bodies.motion[i] != Motion::dynamic) bodies_.push_back(i);
  }
  for (std::uint32_t k = 0; k < bodies_.size(); ++k) number_[bodies_[k]] = k;
  if (bodies.size() >= kManyRecords) release(coded_, scratch_);
}

void SpatialOrder::encode(const BodyView& bodies) {
  coded_.clear();
  Aabb box = Aabb::empty();
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (number_[i] != kTouched || bodies.motion[i] != Motion::dynamic) continue;
    coded_.push_back({0, i});
    if (is_finite(bodies.position[i])) box = merged(box, bodies.position[i]);
  }
  const Vec3 size = box.upper - box.lower;
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0.0) || !std::isfinite(longest)) return;  // one place, or nothing finite: order by index
  constexpr std::uint32_t kLast = (1u << kBitsPerAxis) - 1;
  const double scale = static_cast<double>(kLast) / longest;
  for (Coded& c : coded_) {
    const Vec3 cell = scale * (bodies.position[c.body] - box.lower);
    if (!is_finite(cell)) continue;
    c.code = spread(static_cast<std::uint32_t>(cell.x)) | (spread(static_cast<std::uint32_t>(cell.y)) << 1) |
             (spread(static_cast<std::uint32_t>(cell.z)) << 2);
  }
}

// Radix sort, stable, so that bodies of one cell stay in order of index.
void SpatialOrder::sort_by_code() {
  scratch_.resize(coded_.size());
  for (int shift = 0; shift < 3 * kBitsPerAxis; shift += kBitsPerAxis) {
    std::array<std::uint32_t, (1u << kBitsPerAxis) + 1> first{};
    const auto digit = [shift](const Coded& c) { return (c.code >> shift) & ((1u << kBitsPerAxis) - 1); };
    for (const Coded& c : coded_) ++first[digit(c) + 1];
    for (std::size_t d = 1; d < first.size(); ++d) first[d] += first[d - 1];
    for (const Coded& c : coded_) scratch_[first[digit(c)]++] = c;
    coded_.swap(scratch_);
  }
}

}  // namespace scree::dvi
