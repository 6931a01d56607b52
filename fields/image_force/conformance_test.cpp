#include "conformance/force_field_conformance.hpp"

#include "image_force_fixture.hpp"

namespace scree::test {
namespace {

/// Grains on top of a roll, half of them in the charging zone.
std::unique_ptr<ForceField> on_the_roll(FakeSceneServices& services) {
  static const SeparatorField separator;
  ShapeData cylinder;
  cylinder.name = "drum";
  cylinder.primitives.emplace_back();
  cylinder.primitives[0].primitive.kind = ShapeKind::cylinder;
  cylinder.primitives[0].primitive.size = {kRollRadius, 0.15, 0.0};
  services.shapes().add(cylinder);
  services.add_electric_field("gap", separator);
  services.add_body("roll", {.id = 100, .pose = {}, .shape = "drum"});
  return set_up<ImageForce>(
      "electric_field = 'gap'\nroll = 'roll'\n"
      "charging_zone = {type = 'sector', from = '0 deg', to = '90 deg'}\ndischarge_contact_age = 1.0",
      services);
}

INSTANTIATE_TEST_SUITE_P(image_force, ForceFieldConformance,
                         testing::Values(ForceFieldCase{
                             "on_the_roll",
                             [](FakeSceneServices& services) { return on_the_roll(services); },
                             {{"charge_corona", -1e-11}, {"metal_fraction", 1.0}},
                             {0.0, 0.162, 0.0}}),
                         force_field_case_name);

}  // namespace
}  // namespace scree::test
