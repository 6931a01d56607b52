// Counts what a test program allocates: add count_allocations.cpp to its sources.
#pragma once

namespace scree::test {

/// Calls of operator new since the program began.
[[nodiscard]] long allocations();

}  // namespace scree::test
