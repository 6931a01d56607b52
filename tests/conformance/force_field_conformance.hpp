// What every ForceField owes: the conformance suite of the interface, which scree-conformance instantiates for the fields
// of a plugin. A field's test instantiates it for variants, with ways to make the field, set up, and to fill the columns
// that it reads:
//
//     INSTANTIATE_TEST_SUITE_P(gravity, ForceFieldConformance, testing::Values(ForceFieldCase{"default",
//         [](FakeSceneServices& services) { return set_up<Gravity>("", services); }}), force_field_case_name);
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scree/config/validate.hpp"
#include "scree/interfaces/force_field.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree::test {

/// One way to make a force field.
struct ForceFieldCase {
  std::string name;
  std::function<std::unique_ptr<ForceField>(FakeSceneServices&)> make;  ///< with setup() called
  /// Columns and the values that their bodies get, times a number between 0 and 1.
  std::vector<std::pair<std::string, double>> columns = {};
  Vec3 middle = {};  ///< of the cloud of bodies [m], world
};

inline std::string force_field_case_name(const testing::TestParamInfo<ForceFieldCase>& info) { return info.param.name; }

/// A field from the text of its scene section.
template <class Field>
std::unique_ptr<ForceField> set_up(const std::string& toml, FakeSceneServices& services) {
  auto field = std::make_unique<Field>(options_from_text(toml, Field::parameters()));
  field->setup(services);
  return field;
}

class ForceFieldConformance : public testing::TestWithParam<ForceFieldCase> {
 protected:
  /// A field in a scene of its own, with a cloud of `grains` grains of 1 to 2 mm about the middle, and two immovable bodies.
  struct Scene {
    explicit Scene(int threads, BodyId grains = 3000) : services{threads}, field{GetParam().make(services)} {
      bodies.add_immovable(100, GetParam().middle, Motion::fixed);
      bodies.add_immovable(101, GetParam().middle, Motion::kinematic);
      for (BodyId i = 0; i < grains; ++i) {
        const double s = static_cast<double>(i + 1);
        bodies.add_sphere(1000 + i, GetParam().middle + 5e-3 * Vec3{std::sin(s), std::sin(2.0 * s), std::cos(3.0 * s)},
                          1e-3 * (1.5 + 0.5 * std::sin(5.0 * s)), 2500.0,
                          {std::sin(7.0 * s), std::cos(s), std::sin(11.0 * s)});
      }
      Attributes& attributes = services.attributes();
      for (const auto& [name, scale] : GetParam().columns) {
        std::span<double> column = attributes.column(attributes.id(name));
        for (std::size_t i = 0; i < column.size(); ++i)
          column[i] = scale * std::abs(std::sin(13.0 * static_cast<double>(i)));
      }
    }
    void evaluate() { field->add_forces(bodies.view(), 0.25, bodies.wrenches()); }

    FakeSceneServices services;
    std::unique_ptr<ForceField> field;
    TestBodies bodies{services.attributes()};
  };
};

TEST_P(ForceFieldConformance, adds_to_what_other_fields_left) {
  Scene scene{1, 100};
  scene.evaluate();
  const std::vector<Vec3> alone = scene.bodies.force;
  const WrenchView out = scene.bodies.wrenches();
  const Vec3 before{1e-5, -2e-5, 3e-5};
  for (Vec3& force : scene.bodies.force) force = before;
  scene.field->add_forces(scene.bodies.view(), 0.25, out);
  // A field may add its terms one by one: a few roundings of the larger of both.
  for (std::size_t i = 2; i < alone.size(); ++i)
    EXPECT_LE(norm(scene.bodies.force[i] - before - alone[i]), 1e-14 * (norm(before) + norm(alone[i])));
}

// Bodies 0 and 1 are immovable, with an infinite mass: what a field says of them is ignored, but must not reach the others.
TEST_P(ForceFieldConformance, immovable_bodies_do_not_spoil_the_others) {
  Scene scene{1, 1};
  scene.evaluate();
  for (std::size_t i = 2; i < scene.bodies.force.size(); ++i)
    EXPECT_TRUE(is_finite(scene.bodies.force[i]) && is_finite(scene.bodies.torque[i]));
}

TEST_P(ForceFieldConformance, gives_the_same_bits_for_any_number_of_threads_and_again) {
  Scene one{1};
  Scene two{2};
  for (int step = 0; step < 2; ++step) {
    one.evaluate();
    two.evaluate();
    EXPECT_TRUE(one.bodies.force == two.bodies.force && one.bodies.torque == two.bodies.torque);
    one.field->advance(one.bodies.view(), {}, one.services.attributes(), 0.25, 1e-3);
    two.field->advance(two.bodies.view(), {}, two.services.attributes(), 0.25, 1e-3);
    for (AttributeId column = 0; column < one.services.attributes().count(); ++column) {
      const auto a = one.services.attributes().column(column);
      const auto b = two.services.attributes().column(column);
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << one.services.attributes().info(column).name;
    }
  }
}

TEST_P(ForceFieldConformance, force_is_minus_the_gradient_of_the_energy_where_there_is_one) {
  Scene scene{1, 5};
  if (!scene.field->is_conservative()) return;  // nothing is claimed, nothing to check
  scene.evaluate();
  constexpr double kDelta = 1e-6;
  for (std::size_t i = 2; i < scene.bodies.id.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 kept = scene.bodies.position[i];
      scene.bodies.position[i][axis] = kept[axis] + kDelta;
      const double above = scene.field->potential_energy(scene.bodies.view(), 0.25);
      scene.bodies.position[i][axis] = kept[axis] - kDelta;
      const double below = scene.field->potential_energy(scene.bodies.view(), 0.25);
      scene.bodies.position[i] = kept;
      // Rounding of U, eps |U| / delta, and (delta / 1 mm)^2 of the force from its curvature.
      const double tolerance = 4e-10 * std::abs(above) + 1e-6 * norm(scene.bodies.force[i]);
      EXPECT_NEAR(scene.bodies.force[i][axis], -(above - below) / (2.0 * kDelta), tolerance);
    }
  }
}

TEST_P(ForceFieldConformance, copes_with_a_scene_without_bodies) {
  FakeSceneServices services;
  const std::unique_ptr<ForceField> field = GetParam().make(services);
  TestBodies none{services.attributes()};
  field->add_forces(none.view(), 0.0, none.wrenches());
  field->advance(none.view(), {}, services.attributes(), 0.0, 1e-3);
  EXPECT_TRUE(none.force.empty());
}

}  // namespace scree::test
