// The suite of the interface for what options make of the law; scree-conformance has it for the law as it is by default.
#include "conformance/contact_law_conformance.hpp"
#include "linear_spring_dashpot.hpp"
#include "scree/config/validate.hpp"

namespace scree::test {
namespace {

ContactLawCase variant(const std::string& name, const std::string& toml) {
  return {name, [toml] {
            return std::make_unique<LinearSpringDashpot>(options_from_text(toml, LinearSpringDashpot::parameters()));
          }};
}

INSTANTIATE_TEST_SUITE_P(
    linear, ContactLawConformance,
    testing::Values(variant("stiff_until_the_gap", "stiffness = 1e5\nend_of_contact = \"gap\""),
                    variant("rolling_and_spinning", "rolling = \"elastic_plastic\"\nspinning = \"elastic_plastic\""),
                    variant("constant_rolling",
                            "rolling = \"constant_directional\"\nspinning = \"constant_directional\""),
                    variant("sced", "cohesion = \"sced\""), variant("dmt", "cohesion = \"dmt\"")),
    contact_law_case_name);

}  // namespace
}  // namespace scree::test
