// The suite of the interface for what options make of the law; scree-conformance has it for the law as it is by default.
#include "conformance/contact_law_conformance.hpp"
#include "hertz_mindlin.hpp"
#include "scree/config/validate.hpp"

namespace scree::test {
namespace {

ContactLawCase variant(const std::string& name, const std::string& toml) {
  return {name, [toml] { return std::make_unique<HertzMindlin>(options_from_text(toml, HertzMindlin::parameters())); }};
}

INSTANTIATE_TEST_SUITE_P(hertz, ContactLawConformance,
                         testing::Values(variant("until_the_gap", "end_of_contact = \"gap\""),
                                         variant("jkr", "cohesion = \"jkr\""), variant("dmt", "cohesion = \"dmt\""),
                                         variant("jkr_rolling_spinning",
                                                 "cohesion = \"jkr\"\nrolling = \"elastic_plastic\"\n"
                                                 "spinning = \"elastic_plastic\"")),
                         contact_law_case_name);

}  // namespace
}  // namespace scree::test
