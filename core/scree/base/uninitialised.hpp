// UninitialisedVector: a vector whose new items hold nothing until they are written.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace scree {

/// Leaves items of trivial types as the memory was; a buffer that is written whole is not filled with zeros first.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {                             // NOLINT(readability-identifier-naming): as std::allocator has it
    using other = UninitialisedAllocator<U>;  // NOLINT(readability-identifier-naming)
  };
  template <class U>
  void construct(U* /*place*/) noexcept {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// For buffers of a step: resize() gives room, and whoever resizes writes all of it.
template <class T>
using UninitialisedVector = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace scree
