// Every entry: what it says about itself and its settings.
#include <gtest/gtest.h>

#include "conformance/subject.hpp"
#include "scree/config/parameter_text.hpp"
#include "scree/config/units.hpp"
#include "scree/config/validate.hpp"

namespace scree::test {
namespace {

class Description : public testing::TestWithParam<Subject> {};

/// Calls `check(parameter, its full name)` for settings, their members, and those of alternatives.
template <class Check>
void for_each(const std::vector<Parameter>& parameters, const std::string& prefix, const Check& check) {
  for (const Parameter& parameter : parameters) {
    const std::string name = prefix + parameter.name;
    check(parameter, name);
    for_each(parameter.members, name + ".", check);
    for (const Variant& alternative : parameter.alternatives)
      for_each(alternative.members, name + "." + alternative.type + ".", check);
  }
}

TEST_P(Description, helps) {
  EXPECT_FALSE(GetParam().entry.help.empty());
  for_each(GetParam().entry.parameters, "", [](const Parameter& parameter, const std::string& name) {
    EXPECT_FALSE(parameter.name.empty());
    EXPECT_FALSE(parameter.help.empty()) << name;
    for (const Variant& alternative : parameter.alternatives)
      EXPECT_FALSE(alternative.help.empty()) << name << "." << alternative.type;
  });
}

TEST_P(Description, gives_units_that_can_be_read) {
  for_each(GetParam().entry.parameters, "", [](const Parameter& parameter, const std::string& name) {
    EXPECT_TRUE(parameter.unit == kAnyUnit || is_unit(parameter.unit)) << name << ": " << parameter.unit;
  });
}

// Law: whoever writes a default into the scene gets what the silent scene gets.
TEST_P(Description, has_defaults_that_a_scene_could_write) {
  for_each(GetParam().entry.parameters, "", [](const Parameter& parameter, const std::string& name) {
    const std::string value = toml_text(parameter.default_value);
    if (value.empty()) return;
    EXPECT_NO_THROW((void)options_from_text(parameter.name + " = " + value, {parameter})) << name << " = " << value;
  });
  EXPECT_NO_THROW((void)default_options(GetParam().entry.parameters));
}

INSTANTIATE_TEST_SUITE_P(entry, Description, testing::ValuesIn(subjects()), subject_case_name);

}  // namespace
}  // namespace scree::test
