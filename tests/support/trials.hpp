// How often a test draws: a quick number in each run of the tests, ten thousand in the long ones.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

namespace scree::test {

/// `quick`, or the environment variable SCREE_TRIALS where that asks for more (the tests with the label `full`).
[[nodiscard]] inline int trials(int quick) {
  const char* wanted = std::getenv("SCREE_TRIALS");
  return wanted == nullptr ? quick : std::max(quick, std::stoi(wanted));
}

}  // namespace scree::test
