// The charge of non-metal grains: raised by the corona, held, lost under a brush or by age.
#include <gtest/gtest.h>

#include <cmath>

#include "image_force_fixture.hpp"

namespace scree {
namespace {

using test::ImageForceScene;
using test::kPauthenier;
using test::kStrength;

// The charge is a product of the same factors in another order: a few roundings.
const double kRounding = 1e-14 * kPauthenier;

TEST(image_force, charging_zone_raises_the_charge_to_pauthenier_s_limit) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(90.0);
  scene.step();
  // 5.2216987518e-11 C, negative: ions of the corona drift against the field, which leaves the roll here.
  EXPECT_NEAR(scene.charge(i), -kPauthenier, kRounding);
}

TEST(image_force, charge_is_positive_where_the_field_enters_the_roll) {
  ImageForceScene scene;
  scene.electric.value = {0.0, -kStrength, 0.0};
  const std::size_t i = scene.add_grain(90.0);
  scene.step();
  EXPECT_NEAR(scene.charge(i), kPauthenier, kRounding);
}

TEST(image_force, permittivity_of_the_grain_enters_the_limit) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(90.0);
  EXPECT_EQ(scene.column("relative_permittivity")[i], 2.5);  // the default
  scene.column("relative_permittivity")[i] = 8.0;
  scene.step();
  // er/(er + 2): 0.8 in place of 2.5/4.5.
  EXPECT_NEAR(scene.charge(i), -kPauthenier * 0.8 / (2.5 / 4.5), kRounding);
}

TEST(image_force, outside_of_the_charging_zone_nothing_is_charged) {
  ImageForceScene scene;
  const std::size_t beside = scene.add_grain(30.0);
  const std::size_t above = scene.add_grain(90.0, 0.02);
  scene.step();
  EXPECT_EQ(scene.charge(beside), 0.0);
  EXPECT_EQ(scene.charge(above), 0.0);
}

TEST(image_force, charge_is_never_lowered_by_a_weaker_field) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(90.0);
  scene.step();
  const double held = scene.charge(i);
  scene.electric.value = {0.0, 0.5 * kStrength, 0.0};
  scene.step();
  EXPECT_EQ(scene.charge(i), held);
  // Weaker and of the other sign: still not lowered.
  scene.electric.value = {0.0, -0.5 * kStrength, 0.0};
  scene.step();
  EXPECT_EQ(scene.charge(i), held);
  scene.electric.value = {0.0, 2.0 * kStrength, 0.0};
  scene.step();
  EXPECT_NEAR(scene.charge(i), -2.0 * kPauthenier, 2.0 * kRounding);
}

TEST(image_force, charge_is_kept_after_the_zone_in_any_field) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(90.0);
  scene.step();
  const double held = scene.charge(i);
  scene.bodies.position[i] = {0.3, -0.2, 0.0};
  scene.electric.value = {1e7, 1e7, 0.0};
  scene.step();
  EXPECT_EQ(scene.charge(i), held);
}

TEST(image_force, brush_takes_the_charge_even_inside_the_charging_zone) {
  ImageForceScene scene{"discharge_zone = [{type = 'box', lower = [-1, 0, -1], upper = [0.0, 1, 1]}]\n"};
  const std::size_t brushed = scene.add_grain(120.0);
  const std::size_t spared = scene.add_grain(80.0);
  scene.charge(brushed) = -1e-10;
  scene.charge(spared) = -1e-10;
  scene.step();
  EXPECT_EQ(scene.charge(brushed), 0.0);
  EXPECT_EQ(scene.charge(spared), -1e-10);
}

TEST(image_force, grain_loses_its_charge_by_age_of_contact_outside_of_the_charging_zone) {
  ImageForceScene scene{"discharge_contact_age = '2.5 ms'\n"};
  const std::size_t i = scene.add_grain(0.0);
  const std::size_t in_zone = scene.add_grain(90.0);
  scene.charge(i) = -1e-11;
  for (int k = 0; k < 2; ++k) {
    scene.step(i);
    EXPECT_EQ(scene.charge(i), -1e-11) << "after " << k + 1 << " ms";
  }
  scene.step(i);
  EXPECT_EQ(scene.charge(i), 0.0) << "after 3 ms";
  for (int k = 0; k < 5; ++k) scene.step(in_zone);
  EXPECT_NEAR(scene.charge(in_zone), -kPauthenier, kRounding);
}

TEST(image_force, a_break_of_contact_starts_its_age_again) {
  ImageForceScene scene{"discharge_contact_age = '2.5 ms'\n"};
  const std::size_t i = scene.add_grain(0.0);
  scene.charge(i) = -1e-11;
  scene.step(i);
  scene.step(i);
  scene.step(i, 0.0);  // near, but not pressed
  EXPECT_EQ(scene.column("roll_contact_age")[i], 0.0);
  scene.step(i);
  scene.step(i);
  EXPECT_EQ(scene.charge(i), -1e-11);
}

TEST(image_force, a_contact_that_pulls_is_not_broken) {
  ImageForceScene scene{"discharge_contact_age = '2.5 ms'\n"};
  const std::size_t i = scene.add_grain(0.0);
  scene.charge(i) = -1e-11;
  for (const double impulse : {1e-6, -1e-6, 1e-6}) scene.step(i, impulse);
  EXPECT_EQ(scene.charge(i), 0.0) << "after 3 ms";
}

TEST(image_force, without_a_contact_age_charge_stays_on_the_roll_for_good) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(0.0);
  scene.charge(i) = -1e-11;
  for (int k = 0; k < 100; ++k) scene.step(i);
  EXPECT_EQ(scene.charge(i), -1e-11);
  EXPECT_FALSE(scene.services.attributes().has("roll_contact_age"));
}

TEST(image_force, metal_is_not_charged_by_the_corona_and_mixed_grains_in_part) {
  ImageForceScene scene;
  const std::size_t metal = scene.add_grain(90.0);
  const std::size_t mixed = scene.add_grain(90.0);
  scene.column("metal_fraction")[metal] = 1.0;
  scene.column("metal_fraction")[mixed] = 0.3;
  scene.step();
  EXPECT_EQ(scene.charge(metal), 0.0);
  EXPECT_NEAR(scene.charge(mixed), -0.7 * kPauthenier, kRounding);
}

TEST(image_force, every_body_of_many_batches_and_threads_gets_its_own_charge) {
  ImageForceScene scene{"", 2};
  for (int k = 0; k < 5000; ++k) scene.add_grain(k % 3 == 0 ? 20.0 : 90.0, 0.0, 0.0, 1e-3 + 1e-7 * k);
  scene.step();
  for (std::size_t i = 1; i < scene.bodies.id.size(); ++i) {
    const double scale = scene.bodies.radius[i] / test::kGrainRadius;
    const double expected = (i - 1) % 3 == 0 ? 0.0 : -kPauthenier * scale * scale;
    ASSERT_NEAR(scene.charge(i), expected, 10.0 * kRounding) << i;
  }
}

}  // namespace
}  // namespace scree
