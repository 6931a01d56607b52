// The force of image_force, and what the scene must hold for it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "image_force_fixture.hpp"

namespace scree {
namespace {

using test::ImageForceScene;
using test::kImageForce;
using test::kPauthenier;
using test::kPi;

TEST(image_force, pulls_towards_the_axis_with_equation_12) {
  ImageForceScene scene;
  const std::size_t i = scene.add_grain(60.0, 0.0, 0.05);
  scene.charge(i) = kPauthenier;
  const Vec3 force = scene.force(i);
  // 6.1227844e-6 N; rounding of a dozen factors.
  EXPECT_NEAR(force.x, -kImageForce * std::cos(kPi / 3.0), 1e-14 * kImageForce);
  EXPECT_NEAR(force.y, -kImageForce * std::sin(kPi / 3.0), 1e-14 * kImageForce);
  EXPECT_EQ(force.z, 0.0);
  scene.charge(i) = -kPauthenier;
  EXPECT_EQ(scene.force(i), force);
}

TEST(image_force, acts_within_one_radius_of_the_roll_by_default) {
  ImageForceScene scene;
  const std::size_t within = scene.add_grain(60.0, 0.99 * test::kGrainRadius);
  const std::size_t beyond = scene.add_grain(60.0, 1.01 * test::kGrainRadius);
  scene.charge(within) = kPauthenier;
  scene.charge(beyond) = kPauthenier;
  EXPECT_NEAR(norm(scene.force(within)), kImageForce, 1e-14 * kImageForce);
  EXPECT_EQ(scene.force(beyond), Vec3{});
}

TEST(image_force, reach_can_be_set) {
  ImageForceScene scene{"reach = '5 mm'\n"};
  const std::size_t within = scene.add_grain(60.0, 4.9e-3);
  const std::size_t beyond = scene.add_grain(60.0, 5.1e-3);
  scene.charge(within) = kPauthenier;
  scene.charge(beyond) = kPauthenier;
  EXPECT_NEAR(norm(scene.force(within)), kImageForce, 1e-14 * kImageForce);
  EXPECT_EQ(scene.force(beyond), Vec3{});
}

TEST(image_force, ends_with_the_roll) {
  ImageForceScene scene;
  const std::size_t on = scene.add_grain(60.0, 0.0, 0.149);
  const std::size_t off = scene.add_grain(60.0, 0.0, -0.151);
  scene.charge(on) = kPauthenier;
  scene.charge(off) = kPauthenier;
  EXPECT_NEAR(norm(scene.force(on)), kImageForce, 1e-14 * kImageForce);
  EXPECT_EQ(scene.force(off), Vec3{});
}

TEST(image_force, mixed_grain_feels_its_non_metal_fraction_of_the_force) {
  ImageForceScene scene;
  const std::size_t mixed = scene.add_grain(90.0);
  const std::size_t metal = scene.add_grain(90.0);
  scene.column("metal_fraction")[mixed] = 0.3;
  scene.column("metal_fraction")[metal] = 1.0;
  scene.step();
  scene.charge(metal) = kPauthenier;  // a source may say so; there is no non-metal part to hold it
  EXPECT_NEAR(scene.force(mixed).y, -0.7 * kImageForce, 1e-14 * kImageForce);
  EXPECT_EQ(scene.force(metal), Vec3{});
}

TEST(image_force, holds_a_carried_grain_until_the_published_angles) {
  struct Row {
    double rpm, field, degrees;
  };
  // A grain carried rigidly leaves where w^2 (R + r) = g sin(phi) + F/m, phi from the horizontal. Fields of
  // 9.386057595 |U|; angles to three digits after the point.
  const Row rows[] = {
      {44.8, 0.0, 21.175}, {44.8, test::kStrength, 11.754}, {60.0, 0.0, 40.384}, {60.0, test::kStrength, 29.367}};
  for (const Row& row : rows) {
    ImageForceScene scene;
    scene.electric.value = {0.0, row.field, 0.0};
    const std::size_t i = scene.add_grain(90.0);
    scene.step();
    const double hold = norm(scene.force(i)) / scene.bodies.mass[i];
    const double w = row.rpm * 2.0 * kPi / 60.0;
    const double sine = (w * w * (test::kRollRadius + test::kGrainRadius) - hold) / 9.81;
    EXPECT_NEAR(std::asin(sine) * 180.0 / kPi, row.degrees, 6e-4) << row.rpm << " rpm";
  }
}

TEST(image_force, roll_is_found_where_the_scene_put_it) {
  test::FakeSceneServices services;
  ShapeData cylinder;
  cylinder.name = "drum";
  cylinder.primitives.emplace_back();
  cylinder.primitives[0].primitive.kind = ShapeKind::cylinder;
  cylinder.primitives[0].primitive.size = {0.2, 0.4, 0.0};
  cylinder.primitives[0].primitive.local.position = {0.0, 0.0, 0.5};
  services.shapes().add(cylinder);
  // Turned so that the body's z points along the world's -x.
  const Quat turn = rotation_between({0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0});
  services.add_body("roll", {.id = 1, .pose = {{1.0, 2.0, 3.0}, turn}, .shape = "drum"});
  const Roll roll = find_roll(services, "roll");
  EXPECT_EQ(roll.radius, 0.2);
  EXPECT_EQ(roll.half_length, 0.4);
  // One quaternion product: a few roundings.
  EXPECT_NEAR(norm(roll.centre - Vec3{0.5, 2.0, 3.0}), 0.0, 1e-15);
  EXPECT_NEAR(norm(roll.axis - Vec3{1.0, 0.0, 0.0}), 0.0, 1e-15);
}

TEST(image_force, a_roll_without_a_cylinder_is_refused_by_name) {
  test::FakeSceneServices services;
  ShapeData ball;
  ball.name = "ball";
  ball.primitives.emplace_back();
  services.shapes().add(ball);
  services.add_body("thing", {.id = 1, .pose = {}, .shape = "ball"});
  try {
    const Roll roll = find_roll(services, "thing");
    FAIL() << roll.radius;
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("'thing'"), std::string::npos) << error.what();
  }
}

TEST(image_force, writes_charge_corona_alone) {
  ImageForceScene scene;
  EXPECT_TRUE(scene.services.provides("charge_corona"));
  EXPECT_FALSE(scene.services.provides("charge"));
  EXPECT_FALSE(scene.services.provides("charge_induced"));
}

}  // namespace
}  // namespace scree
