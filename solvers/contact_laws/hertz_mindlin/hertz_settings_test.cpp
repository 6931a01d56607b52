// What the law says of itself, refuses, and asks of the step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hertz_world.hpp"

namespace scree {
namespace {

using test::FakeSceneServices;
using test::HertzWorld;

std::string refusal(const std::string& toml, const std::vector<Material>& materials,
                    const ContactScale* scale = nullptr) {
  FakeSceneServices services;
  for (const Material& material : materials) services.materials().add(material);
  HertzMindlin law{options_from_text(toml, HertzMindlin::parameters())};
  try {
    law.setup(services);
    if (scale != nullptr) (void)law.stable_step(*scale);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing is refused";
}

const Material kSteel = test::elastic("steel", 210e9, 0.3, 7850, {.restitution = 0.7});
const Material kUnknown = test::elastic("clay", 0.0, 0.3, 1800, {});

TEST(hertz_settings, a_material_without_a_modulus_is_refused_by_name_unless_it_is_rigid) {
  EXPECT_NE(
      refusal("", {kSteel, kUnknown}).find("material 'clay', whose young_modulus is not known; set [material.clay]"),
      std::string::npos);
  EXPECT_EQ(refusal("rigid = [\"clay\"]", {kSteel, kUnknown}), "nothing is refused");
}

TEST(hertz_settings, a_rigid_material_with_a_modulus_or_without_a_name_is_refused) {
  EXPECT_NE(refusal("rigid = [\"steel\"]", {kSteel}).find("'steel', which has a young_modulus"), std::string::npos);
  EXPECT_NE(refusal("rigid = [\"stone\"]", {kSteel}).find("no material 'stone'"), std::string::npos);
}

TEST(hertz_settings, springs_and_dashpots_of_materials_and_pairs_are_refused_as_they_would_do_nothing) {
  const Material spring = test::elastic("spring", 1e7, 0.3, 1000, {.restitution = 0.7, .compliance = 1e-5});
  const Material dashpot = test::elastic("dashpot", 1e7, 0.3, 1000, {.restitution = 0.7, .damping = 0.5});
  EXPECT_NE(refusal("", {kSteel, spring}).find("material 'spring' has a compliance, which would be without effect"),
            std::string::npos);
  EXPECT_NE(refusal("", {kSteel, dashpot}).find("material 'dashpot' has a damping"), std::string::npos);
  FakeSceneServices services;
  services.materials().add(kSteel);
  services.materials().add(test::elastic("clay", 1e6, 0.3, 1800, {}));
  services.materials().set_pair(0, 1, {.friction = 0.5, .compliance = 1e-6});
  HertzMindlin law{options_from_text("", HertzMindlin::parameters())};
  try {
    law.setup(services);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("the pair of 'steel' and 'clay' has a compliance"), std::string::npos);
  }
}

TEST(hertz_settings, rigid_bodies_that_may_touch_each_other_are_refused) {
  const ContactScale scale{.material_a = 0, .material_b = 0, .mass = 1.0, .radius = 1e-3, .speed = 1.0};
  EXPECT_NE(refusal("rigid = [\"clay\"]", {kUnknown}, &scale).find("'clay' and 'clay' of bodies that may touch"),
            std::string::npos);
}

// E / (2 (1 - nu^2)) = 115.4 GPa, E / (4 (2 - nu)(1 + nu)) = 23.76 GPa.
TEST(hertz_settings, the_log_has_the_moduli_of_each_pair) {
  FakeSceneServices services;
  services.materials().add(kSteel);
  HertzMindlin law{options_from_text("end_of_contact = \"gap\"", HertzMindlin::parameters())};
  law.setup(services);
  ASSERT_EQ(services.log_lines().size(), 1U);
  EXPECT_EQ(
      services.log_lines()[0],
      "steel on steel: effective modulus 1.154e+11 Pa, shear 2.376e+10 Pa, restitution 0.7 (damping ratio 0.1128)");
}

// Rayleigh's time of a slow ball; the time of impact of a fast one.
TEST(hertz_settings, the_stable_step_is_a_fifth_of_rayleighs_time_or_a_twentieth_of_an_impact) {
  HertzWorld world{"", kSteel};
  const double r = 1e-3, m = world.mass(r), shear = 210e9 / 2.6;
  const double rayleigh = std::numbers::pi * r * std::sqrt(7850.0 / shear) / (0.163 * 0.3 + 0.877);
  EXPECT_NEAR(world.law->stable_step({0, 1, m, r, 1e-6}), 0.2 * rayleigh, 1e-9 * rayleigh);
  const double e = 210e9 / 0.91, v = 100.0, x = std::pow(15.0 * m * v * v / (16.0 * e * std::sqrt(r)), 0.4);
  HertzWorld elastic{"", test::elastic("steel", 210e9, 0.3, 7850, {.restitution = 1.0})};
  EXPECT_NEAR(elastic.law->stable_step({0, 1, m, r, v}), 2.943 * x / v / 20.0, 0.01 * x / v);
  EXPECT_LT(world.law->stable_step({0, 1, m, r, v}), 2.943 * x / v / 20.0);  // damping asks for less
  // Two equal balls: the effective radius is half of a ball's, whose mass says that it is no smaller than 0.79 of its own.
  EXPECT_NEAR(world.law->stable_step({0, 0, 0.5 * m, 0.5 * r, 1e-6}), 0.2 * rayleigh * std::cbrt(0.5), 1e-9 * rayleigh);
}

TEST(hertz_settings, the_stable_step_resolves_impacts_of_any_damping) {
  for (const double e : {1.0, 0.7, 0.3, 0.05}) {
    HertzWorld world{"", test::elastic("plastic", 1e8, 0.3, 1200, {.friction = 0.5, .restitution = e})};
    for (const double speed : {0.1, 10.0}) {
      test::DrivenBall ball = world.touching(1e-3, {0.2 * speed, 0, -speed});
      ball.position.z += 1e-8;
      test::ContactDrive drive = world.on_wall(ball);
      const double before = drive.kinetic_energy();
      ASSERT_TRUE(drive.run(world.law->stable_step({0, 1, ball.mass, ball.radius, speed}), 10000));
      EXPECT_NEAR(drive.ball.velocity.z / speed, e, 0.03) << e << " " << speed;
      EXPECT_LT(drive.kinetic_energy(), 1.01 * before);
    }
  }
}

}  // namespace
}  // namespace scree
