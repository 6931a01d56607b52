// Contact laws: the suite of the interface.
#include "conformance/contact_law_conformance.hpp"
#include "conformance/subject.hpp"

namespace scree::test {
namespace {

std::vector<ContactLawCase> cases() {
  std::vector<ContactLawCase> list;
  for (const Subject& subject : living_subjects(ContactLaw::kKind)) {
    list.push_back({subject.entry.name, [subject] {
                      return std::unique_ptr<ContactLaw>{static_cast<ContactLaw*>(subject.make().release())};
                    }});
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ContactLawConformance);
INSTANTIATE_TEST_SUITE_P(entry, ContactLawConformance, testing::ValuesIn(cases()), contact_law_case_name);

}  // namespace
}  // namespace scree::test
