// Force fields that a scene without bodies and electric fields can set up: the suite of the interface.
#include "conformance/force_field_conformance.hpp"
#include "conformance/subject.hpp"

namespace scree::test {
namespace {

std::unique_ptr<ForceField> set_up_field(const Subject& subject, FakeSceneServices& services) {
  std::unique_ptr<ForceField> field{static_cast<ForceField*>(subject.make().release())};
  field->setup(services);
  return field;
}

// The columns that the field reads and does not write: charges of 0.1 nC, one for everything else.
std::vector<std::pair<std::string, double>> columns_read(const Subject& subject) {
  FakeSceneServices services;
  const std::unique_ptr<ForceField> field = set_up_field(subject, services);
  std::vector<std::pair<std::string, double>> columns;
  for (AttributeId id = 0; id < services.attributes().count(); ++id) {
    const AttributeInfo& info = services.attributes().info(id);
    if (!services.provides(info.name)) columns.emplace_back(info.name, info.unit == "C" ? 1e-10 : 1.0);
  }
  return columns;
}

std::vector<ForceFieldCase> cases() {
  std::vector<ForceFieldCase> list;
  for (const Subject& subject : living_subjects(ForceField::kKind)) {
    list.push_back({subject.entry.name,
                    [subject](FakeSceneServices& services) { return set_up_field(subject, services); },
                    columns_read(subject)});
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ForceFieldConformance);
INSTANTIATE_TEST_SUITE_P(entry, ForceFieldConformance, testing::ValuesIn(cases()), force_field_case_name);

}  // namespace
}  // namespace scree::test
