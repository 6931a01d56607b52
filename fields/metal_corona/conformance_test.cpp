#include "conformance/force_field_conformance.hpp"

#include "metal_corona.hpp"
#include "support/fake_electric_field.hpp"

namespace scree::test {
namespace {

/// The published separator's field, the same for all tests.
std::unique_ptr<ForceField> in_the_separator(FakeSceneServices& services) {
  static const SeparatorField separator;
  services.add_electric_field("gap", separator);
  services.add_body("roll", {.id = 100, .pose = {}, .shape = "roll"});
  return set_up<MetalCorona>("electric_field = 'gap'\ngrounded = ['roll']", services);
}

INSTANTIATE_TEST_SUITE_P(metal_corona, ForceFieldConformance,
                         testing::Values(ForceFieldCase{
                             "in_the_separator",
                             [](FakeSceneServices& services) { return in_the_separator(services); },
                             {{"charge_induced", 1e-10}, {"metal_fraction", 1.0}},
                             {0.18, 0.1, 0.0}}),
                         force_field_case_name);

}  // namespace
}  // namespace scree::test
