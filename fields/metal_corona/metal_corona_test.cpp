#include "metal_corona.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scree/config/validate.hpp"
#include "support/fake_electric_field.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAirPermittivity = 8.85941e-12;  // [F/m]
constexpr double kRadius = 1.2e-3;                // [m]
constexpr double kStrength = 2e5;                 // [V/m]

/// Charge of a conducting sphere of kRadius on a plane, in a field of kStrength (eq. 11) [C].
const double kCharge = 2.0 / 3.0 * std::pow(kPi, 3) * kAirPermittivity * kRadius * kRadius * kStrength;

Contact contact_between(BodyIndex a, BodyIndex b, const Vec3& normal) {
  Contact contact;
  contact.a = a;
  contact.b = b;
  contact.normal = normal;
  return contact;
}

/// A grounded roll (index 0), an ordinary wall (index 1) and metal grains in a uniform field.
struct Scene {
  explicit Scene(const Vec3& e, const std::string& more = "", int threads = 1)
      : electric{e},
        services{threads},
        field{options_from_text("electric_field = 'gap'\ngrounded = ['roll']\n" + more, MetalCorona::parameters())},
        bodies{services.attributes()} {
    services.add_electric_field("gap", electric);
    services.add_body("roll", {.id = 10, .pose = {}, .shape = "roll"});
    field.setup(services);
    bodies.add_immovable(10, {0.0, -0.16, 0.0});
    bodies.add_immovable(11, {0.0, 1.0, 0.0});
  }
  std::size_t add_grain(double metal_fraction, double radius = kRadius) {
    const std::size_t i = bodies.add_sphere(20 + bodies.id.size(), {0.0, radius, 0.0}, radius, 8400.0);
    column("metal_fraction")[i] = metal_fraction;
    return i;
  }
  std::span<double> column(const char* name) { return services.attributes().column(services.attributes().id(name)); }
  double& charge(std::size_t i) { return column("charge_induced")[i]; }
  void touch(BodyIndex a, BodyIndex b, const Vec3& normal, double impulse) {
    contact.push_back(contact_between(a, b, normal));
    impulses.push_back({impulse, 0.0, 0.0});
  }
  void step() {
    const std::vector<Vec3> still(contact.size());
    field.advance(bodies.view(), {contact, impulses, still, still}, services.attributes(), 0.0, 1e-3);
    contact.clear();
    impulses.clear();
  }

  test::FakeElectricField electric;
  test::FakeSceneServices services;
  MetalCorona field;
  test::TestBodies bodies;
  std::vector<Contact> contact;
  std::vector<Vec3> impulses;
};

TEST(metal_corona, contact_with_a_grounded_body_gives_the_charge_of_equation_11) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  // Same factors in another order: a few roundings. 5.27e-11 C.
  EXPECT_NEAR(scene.charge(i), kCharge, 1e-14 * kCharge);
}

TEST(metal_corona, charge_has_the_size_of_the_whole_field_and_the_sign_along_the_normal) {
  const double full = std::sqrt(2.0) * kCharge;
  Scene scene{{kStrength, -kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  // The roll is body a, the normal points from it into the grain, against the field's y: negative.
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  EXPECT_NEAR(scene.charge(i), -full, 1e-14 * full);
  // Touched from the right: the field points into the grain.
  scene.touch(0, static_cast<BodyIndex>(i), {1.0, 0.0, 0.0}, 1e-6);
  scene.step();
  EXPECT_NEAR(scene.charge(i), full, 1e-14 * full);
}

TEST(metal_corona, normal_counts_from_the_grounded_body_also_when_it_is_body_b) {
  // A grain with a smaller id than the roll's stands first in the contact, and the normal points into the roll.
  test::FakeElectricField electric{{0.0, kStrength, 0.0}};
  test::FakeSceneServices services;
  services.add_electric_field("gap", electric);
  services.add_body("roll", {.id = 10, .pose = {}, .shape = "roll"});
  MetalCorona field{options_from_text("electric_field = 'gap'\ngrounded = ['roll']", MetalCorona::parameters())};
  field.setup(services);
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {0.0, 0.0, 0.0}, kRadius, 8400.0);
  bodies.add_immovable(10, {0.0, -0.16, 0.0});
  Attributes& attributes = services.attributes();
  attributes.column(attributes.id("metal_fraction"))[0] = 1.0;
  const Contact contact = contact_between(0, 1, {0.0, -1.0, 0.0});
  const Vec3 impulse{1e-6, 0.0, 0.0};
  const Vec3 still;
  field.advance(bodies.view(), {{&contact, 1}, {&impulse, 1}, {&still, 1}, {&still, 1}}, attributes, 0.0, 1e-3);
  EXPECT_NEAR(attributes.column(attributes.id("charge_induced"))[0], kCharge, 1e-14 * kCharge);
}

TEST(metal_corona, charge_stays_in_flight_while_the_field_changes) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  const double held = scene.charge(i);
  scene.electric.value = {0.0, -3.0 * kStrength, 0.0};
  for (int k = 0; k < 3; ++k) scene.step();
  EXPECT_EQ(scene.charge(i), held);
}

TEST(metal_corona, charge_follows_the_field_down_and_to_zero_while_the_grain_touches) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  for (const double part : {1.0, 0.25, 0.0}) {
    scene.electric.value = {0.0, part * kStrength, 0.0};
    scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
    scene.step();
    EXPECT_NEAR(scene.charge(i), part * kCharge, 1e-14 * kCharge);
  }
}

TEST(metal_corona, near_contacts_without_impulse_and_ungrounded_bodies_do_not_charge) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  const std::size_t k = scene.add_grain(1.0);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 0.0);
  scene.touch(1, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.touch(static_cast<BodyIndex>(i), static_cast<BodyIndex>(k), {0.0, 1.0, 0.0}, 1e-6);
  scene.touch(0, 1, {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  for (std::size_t body = 0; body < scene.bodies.id.size(); ++body) EXPECT_EQ(scene.charge(body), 0.0);
}

// Cohesion holds a grain on the electrode: it touches, and its normal is where it was.
TEST(metal_corona, a_contact_that_pulls_touches_too) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, -1e-6);
  scene.step();
  EXPECT_NEAR(scene.charge(i), kCharge, 1e-14 * kCharge);
}

TEST(metal_corona, several_contacts_count_as_their_joint_push) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, -1.0, 0.0}, 1e-6);
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 3e-6);
  scene.step();
  EXPECT_NEAR(scene.charge(i), kCharge, 1e-14 * kCharge);
}

TEST(metal_corona, force_is_0_832_times_charge_times_field) {
  Scene scene{{3e4, -2e4, 1e4}};
  const std::size_t i = scene.add_grain(1.0);
  scene.charge(i) = -4e-11;
  scene.field.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  const Vec3 expected = 0.832 * -4e-11 * Vec3{3e4, -2e4, 1e4};
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(scene.bodies.force[i][axis], expected[axis], 1e-15 * std::abs(expected[axis]));
  EXPECT_EQ(scene.bodies.force[0], Vec3{});
}

TEST(metal_corona, default_factor_is_that_of_a_sphere_on_a_plane) {
  // (zeta(3) + 1/6) / zeta(2), printed as 0.832.
  const double exact = (1.2020569031595942 + 1.0 / 6.0) / (kPi * kPi / 6.0);
  EXPECT_NEAR(exact, 0.832, 5e-4);
  Scene scene{{1e5, 0.0, 0.0}, "force_factor = 0.5"};
  const std::size_t i = scene.add_grain(1.0);
  scene.charge(i) = 1e-11;
  scene.field.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  EXPECT_DOUBLE_EQ(scene.bodies.force[i].x, 0.5e-6);
}

TEST(metal_corona, mixed_grain_has_its_metal_fraction_of_charge_and_force) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t metal = scene.add_grain(1.0);
  const std::size_t mixed = scene.add_grain(0.3);
  const std::size_t plastic = scene.add_grain(0.0);
  for (const std::size_t i : {metal, mixed, plastic}) scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  scene.field.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  EXPECT_NEAR(scene.charge(mixed), 0.3 * kCharge, 1e-14 * kCharge);
  EXPECT_NEAR(scene.bodies.force[mixed].y, 0.3 * scene.bodies.force[metal].y, 1e-14 * scene.bodies.force[metal].y);
  EXPECT_GT(scene.bodies.force[metal].y, 0.0);
  EXPECT_EQ(scene.charge(plastic), 0.0);
  EXPECT_EQ(scene.bodies.force[plastic], Vec3{});
}

TEST(metal_corona, every_body_of_many_batches_and_threads_gets_its_own_force) {
  Scene scene{{0.0, 1e5, 0.0}, "", 2};
  for (int k = 0; k < 5000; ++k) scene.add_grain(1.0);
  // Every third grain is uncharged: batches are filled unevenly.
  for (std::size_t i = 2; i < scene.bodies.id.size(); ++i)
    scene.charge(i) = i % 3 == 0 ? 0.0 : 1e-13 * static_cast<double>(i);
  scene.field.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  for (std::size_t i = 2; i < scene.bodies.id.size(); ++i)
    EXPECT_DOUBLE_EQ(scene.bodies.force[i].y, 0.832 * scene.charge(i) * 1e5) << i;
}

TEST(metal_corona, writes_charge_induced_alone_and_insists_on_metal_fraction) {
  Scene scene{{}};
  EXPECT_TRUE(scene.services.provides("charge_induced"));
  EXPECT_FALSE(scene.services.provides("charge"));
  EXPECT_TRUE(scene.services.requires_column("metal_fraction"));
}

TEST(metal_corona, a_grounded_body_that_was_removed_charges_nothing) {
  Scene scene{{0.0, kStrength, 0.0}};
  const std::size_t i = scene.add_grain(1.0);
  scene.bodies.id[0] = 9;  // the roll had 10
  scene.touch(0, static_cast<BodyIndex>(i), {0.0, 1.0, 0.0}, 1e-6);
  scene.step();
  EXPECT_EQ(scene.charge(i), 0.0);
}

}  // namespace
}  // namespace scree
