// AlignedVector: numbers whose place in memory does not show in results.
//
// Vectorised kernels treat numbers before the first aligned address otherwise than those behind it, and round otherwise.
// With every buffer on a cache line, the same problem gives the same bits wherever its memory lies.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace scree::direct {

/// Allocates whole cache lines.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kAlignment); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace scree::direct
