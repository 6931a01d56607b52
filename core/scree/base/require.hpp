// SCREE_REQUIRE checks a precondition once per batch call and throws; SCREE_ASSERT checks inside loops in debug builds.
#pragma once

#include <cassert>
#include <stdexcept>

/// Throws std::logic_error when a caller broke a contract; for checks that run once per batch.
#define SCREE_REQUIRE(condition, sentence)              \
  do {                                                  \
    if (!(condition)) throw std::logic_error{sentence}; \
  } while (false)

/// Debug-only check for the insides of loops.
#define SCREE_ASSERT(condition) assert(condition)
