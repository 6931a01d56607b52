// Broad phases: the suite of the interface.
#include "conformance/broad_phase_conformance.hpp"
#include "conformance/subject.hpp"

namespace scree::test {
namespace {

std::vector<BroadPhaseCase> cases() {
  std::vector<BroadPhaseCase> list;
  for (const Subject& subject : living_subjects(BroadPhase::kKind)) {
    list.push_back({subject.entry.name, [subject] {
                      return std::unique_ptr<BroadPhase>{static_cast<BroadPhase*>(subject.make().release())};
                    }});
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BroadPhaseConformance);
INSTANTIATE_TEST_SUITE_P(entry, BroadPhaseConformance, testing::ValuesIn(cases()), broad_phase_case_name);

}  // namespace
}  // namespace scree::test
