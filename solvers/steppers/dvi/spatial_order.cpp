#include "spatial_order.hpp"

#include <algorithm>
#include <array>

#include "scree/base/release.hpp"
#include "scree/math/aabb.hpp"
#include "scree/math/morton.hpp"

namespace scree::dvi {

namespace {

constexpr std::uint32_t kTouched = kNotInProblem - 1;
constexpr int kBitsPerAxis = 10;

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
    c.code = static_cast<std::uint32_t>(morton_code(
        static_cast<std::uint64_t>(cell.x), static_cast<std::uint64_t>(cell.y), static_cast<std::uint64_t>(cell.z)));
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
