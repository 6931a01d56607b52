// Bodies as the passes of gradient methods see them, four at a time.
//
// Bodies are seen through the slots of ContactPartition: a run of contacts has velocities and sums of its own, so that runs
// share nothing. Inside a run lane k takes the contacts of its k-th quarter: neighbours in memory rarely share a body then,
// and none has to wait for the sum of the one before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scree/math/lanes.hpp"
#include "scree/math/twist.hpp"

namespace scree::packed {

using Pair = double __attribute__((vector_size(16)));
using Offsets = std::array<std::uint32_t, 4>;  ///< of slots, in bytes: a product less than an index

/// A body as a run of contacts sees it.
struct alignas(32) Slot {
  Twist sum;       ///< of the impulses that the run puts on it [N s]
  Twist velocity;  ///< [m/s, rad/s]
};

/// Slots that offsets reach.
inline constexpr std::size_t kMostSlots = (std::size_t{1} << 32) / sizeof(Slot);
inline std::uint32_t offset_of(std::uint32_t slot) { return slot * static_cast<std::uint32_t>(sizeof(Slot)); }

inline const char* bytes_of(const Slot* slots, std::uint32_t offset) {
  return reinterpret_cast<const char*>(slots) + offset;
}

/// Velocities, or impulses and their moments, side by side.
struct Twists {
  Lanes3 linear, angular;
};

/// Four bodies: inverse masses [1/kg] and inverse inertias [1/(kg m2)].
struct alignas(32) BodyGroup {
  Lanes mass, xx, xy, xz, yy, yz, zz;
};

/// Two neighbouring numbers of four twists, side by side.
inline void gather_pair(const std::array<const char*, 4>& twist, std::size_t pair, Lanes& first, Lanes& second) {
  const auto join = [pair](const char* low, const char* high) {
    Pair a, b;
    std::memcpy(&a, low + pair * sizeof a, sizeof a);
    std::memcpy(&b, high + pair * sizeof b, sizeof b);
    return Lanes{__builtin_shufflevector(a, b, 0, 1, 2, 3)};
  };
  const Lanes even = join(twist[0], twist[2]), odd = join(twist[1], twist[3]);
  first = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  second = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}

/// The velocities of four slots.
inline Twists gather(const Slot* slots, const Offsets& offset) {
  std::array<const char*, 4> twist;
  for (std::size_t k = 0; k < 4; ++k) twist[k] = bytes_of(slots, offset[k]) + offsetof(Slot, velocity);
  Twists out;
  gather_pair(twist, 0, out.linear.x, out.linear.y);
  gather_pair(twist, 1, out.linear.z, out.angular.x);
  gather_pair(twist, 2, out.angular.y, out.angular.z);
  return out;
}

/// A twist in two registers.
struct Split {
  Lanes head;
  Pair tail;
  static Split load(const Twist& from) {
    Split out;
    std::memcpy(&out.head, &from, sizeof out.head);
    std::memcpy(&out.tail, reinterpret_cast<const char*>(&from) + sizeof out.head, sizeof out.tail);
    return out;
  }
  void store(Twist& to) const {
    char* const bytes = reinterpret_cast<char*>(&to);
    std::memcpy(bytes, &head, sizeof head);
    std::memcpy(bytes + sizeof head, &tail, sizeof tail);
  }
};

/// Side by side to one after the other.
inline std::array<Split, 4> rows_of(const Twists& t) {
  Lanes a = t.linear.x, b = t.linear.y, c = t.linear.z, d = t.angular.x;
  transpose(a, b, c, d);
  const Lanes even = __builtin_shufflevector(t.angular.y, t.angular.z, 0, 4, 2, 6);
  const Lanes odd = __builtin_shufflevector(t.angular.y, t.angular.z, 1, 5, 3, 7);
  return {{{a, __builtin_shufflevector(even, even, 0, 1)},
           {b, __builtin_shufflevector(odd, odd, 0, 1)},
           {c, __builtin_shufflevector(even, even, 2, 3)},
           {d, __builtin_shufflevector(odd, odd, 2, 3)}}};
}

/// Adds to the sums of four slots, which may be the same.
inline void add(const Twists& impulse, const Offsets& offset, Slot* slots) {
  const std::array<Split, 4> rows = rows_of(impulse);
  for (std::size_t k = 0; k < 4; ++k) {
    Twist& sum = reinterpret_cast<Slot*>(reinterpret_cast<char*>(slots) + offset[k])->sum;
    const Split old = Split::load(sum);
    Split{old.head + rows[k].head, old.tail + rows[k].tail}.store(sum);
  }
}

/// M^-1 p.
inline Twists times(const BodyGroup& inverse, const Twists& p) {
  const Lanes3& w = p.angular;
  return {
      inverse.mass * p.linear,
      {inverse.xx * w.x + inverse.xy * w.y + inverse.xz * w.z, inverse.xy * w.x + inverse.yy * w.y + inverse.yz * w.z,
       inverse.xz * w.x + inverse.yz * w.y + inverse.zz * w.z}};
}

inline Lanes dot(const Twists& a, const Twists& b) { return dot(a.linear, b.linear) + dot(a.angular, b.angular); }
inline Twists operator+(const Twists& a, const Twists& b) { return {a.linear + b.linear, a.angular + b.angular}; }
inline Twists operator-(const Twists& a, const Twists& b) { return {a.linear - b.linear, a.angular - b.angular}; }
inline Twists operator*(const Lanes& s, const Twists& a) { return {s * a.linear, s * a.angular}; }

/// The sums of four bodies, body k's slots being first[k] .. first[k + 1] - 1, in their order; the slots are left with none.
inline Twists take_sums(Slot* slots, const std::uint32_t* first) {
  std::array<Split, 4> sum;
  for (std::size_t k = 0; k < 4; ++k) {
    sum[k] = {Lanes{}, Pair{}};
    for (std::uint32_t s = first[k]; s < first[k + 1]; ++s) {
      const Split one = Split::load(slots[s].sum);
      sum[k].head += one.head;
      sum[k].tail += one.tail;
      Split{Lanes{}, Pair{}}.store(slots[s].sum);
    }
  }
  transpose(sum[0].head, sum[1].head, sum[2].head, sum[3].head);
  const Lanes even = __builtin_shufflevector(sum[0].tail, sum[2].tail, 0, 1, 2, 3);
  const Lanes odd = __builtin_shufflevector(sum[1].tail, sum[3].tail, 0, 1, 2, 3);
  return {
      {sum[0].head, sum[1].head, sum[2].head},
      {sum[3].head, __builtin_shufflevector(even, odd, 0, 4, 2, 6), __builtin_shufflevector(even, odd, 1, 5, 3, 7)}};
}

/// Gives the velocities of four bodies to their slots.
inline void spread(const Twists& velocity, const std::uint32_t* first, Slot* slots) {
  const std::array<Split, 4> rows = rows_of(velocity);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::uint32_t s = first[k]; s < first[k + 1]; ++s) rows[k].store(slots[s].velocity);
  }
}

}  // namespace scree::packed
