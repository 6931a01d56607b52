// What the conformance suite of narrow phases works with: pairs of kinds of a phase, and the verdict on a pose.
//
// In each of some hundred poses (SCREE_TRIALS asks for more) the deepest contact has the true gap to 1e-3 of the smaller
// solid and a normal within one degree of the true one, or one that shows the same gap; nothing is missed within reach or
// reported beyond it; all is finite, of unit length and in place.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "conformance/narrow_phase_solids.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree::test {

/// A phase and two kinds that it supports.
struct NarrowPhaseCase {
  std::string name;
  std::function<std::unique_ptr<NarrowPhase>()> make;
  ShapeKind a = ShapeKind::sphere, b = ShapeKind::sphere;
  int poses = 48;  ///< in each run of the tests
};

inline std::ostream& operator<<(std::ostream& out, const NarrowPhaseCase& c) {
  return out << c.name << " on " << to_string(c.a) << " and " << to_string(c.b);
}
inline std::string narrow_phase_case_name(const testing::TestParamInfo<NarrowPhaseCase>& info) {
  return info.param.name + "_" + to_string(info.param.a) + "_" + to_string(info.param.b);
}

/// All cases of a phase. @param supports which pairs to take; both orders of a pair are one case, the order changes by pose.
[[nodiscard]] inline std::vector<NarrowPhaseCase> narrow_phase_cases(
    const std::string& name, const std::function<std::unique_ptr<NarrowPhase>()>& make,
    const std::function<bool(ShapeKind, ShapeKind)>& supports) {
  std::vector<NarrowPhaseCase> cases;
  for (std::size_t a = 0; a < kShapeKindCount; ++a) {
    for (std::size_t b = a; b < kShapeKindCount; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      if (supports(kind_a, kind_b)) cases.push_back({.name = name, .make = make, .a = kind_a, .b = kind_b});
    }
  }
  return cases;
}

/// True for a pose in which a phase is known to fail, and which is kept until it does not. At most five a phase.
[[nodiscard]] bool is_declared_exception(const NarrowPhaseCase& phase, int trial);

/// What is wrong with the contacts of a phase at a pose; empty when nothing is.
[[nodiscard]] std::string fault_of(NarrowPhase& phase, const NarrowPhasePose& pose);

}  // namespace scree::test
