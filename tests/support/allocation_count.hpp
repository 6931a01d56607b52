// How often memory was asked for: to show that a loop works without allocation. Programs that use it link
// scree_test_allocations, which replaces the global operator new by one that counts.
#pragma once

#include <cstdint>

namespace scree::test {

/// Calls of operator new by all threads since the program started.
[[nodiscard]] std::uint64_t allocation_count();

}  // namespace scree::test
