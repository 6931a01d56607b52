// Narrow phases: the suite of the interface.
#include <algorithm>
#include <cmath>

#include "conformance/narrow_phase_conformance.hpp"
#include "conformance/subject.hpp"

namespace scree::test {
namespace {

std::vector<NarrowPhaseCase> cases() {
  std::vector<NarrowPhaseCase> list;
  for (const Subject& subject : living_subjects(NarrowPhase::kKind)) {
    const auto make = [subject] {
      return std::unique_ptr<NarrowPhase>{static_cast<NarrowPhase*>(subject.make().release())};
    };
    const auto phase = make();
    const auto supports = [&](ShapeKind a, ShapeKind b) {
      EXPECT_EQ(phase->supports(a, b), phase->supports(b, a)) << to_string(a) << " and " << to_string(b);
      return phase->supports(a, b);
    };
    for (NarrowPhaseCase& made : narrow_phase_cases(subject.entry.name, make, supports))
      list.push_back(std::move(made));
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(NarrowPhaseConformance);
INSTANTIATE_TEST_SUITE_P(entry, NarrowPhaseConformance, testing::ValuesIn(cases()), narrow_phase_case_name);

std::vector<NarrowPhaseCase> hollow_cases() {
  std::vector<NarrowPhaseCase> list;
  for (const Subject& subject : living_subjects(NarrowPhase::kKind)) {
    const auto make = [subject] {
      return std::unique_ptr<NarrowPhase>{static_cast<NarrowPhase*>(subject.make().release())};
    };
    for (std::size_t k = 0; k < kShapeKindCount; ++k) {
      const auto kind = static_cast<ShapeKind>(k);
      // A plane is outside of the drum, which it meets like a solid one.
      if (kind == ShapeKind::plane || !make()->supports_hollow(kind)) continue;
      list.push_back({.name = subject.entry.name, .make = make, .a = ShapeKind::cylinder, .b = kind});
    }
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(HollowDrumConformance);
INSTANTIATE_TEST_SUITE_P(entry, HollowDrumConformance, testing::ValuesIn(hollow_cases()), narrow_phase_case_name);

}  // namespace
}  // namespace scree::test
