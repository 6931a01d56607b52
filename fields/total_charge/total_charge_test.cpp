#include "total_charge.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

TEST(total_charge, is_the_sum_of_its_terms_each_time) {
  test::FakeSceneServices services;
  TotalCharge total{options_from_text("", TotalCharge::parameters())};
  total.setup(services);
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {}, 1e-3, 1000.0);
  bodies.add_sphere(2, {}, 1e-3, 1000.0);
  Attributes& attributes = services.attributes();
  attributes.column(attributes.id("charge_induced"))[0] = 0.5;
  attributes.column(attributes.id("charge_corona"))[0] = -2.0;
  attributes.column(attributes.id("charge_corona"))[1] = 0.25;
  for (int step = 0; step < 2; ++step) {
    total.advance(bodies.view(), {}, attributes, 0.0, 1e-3);
    // Sums of powers of two: exact.
    EXPECT_EQ(attributes.column(attributes.id("charge"))[0], -1.5);
    EXPECT_EQ(attributes.column(attributes.id("charge"))[1], 0.25);
  }
}

TEST(total_charge, is_the_one_writer_of_charge_and_adds_no_force) {
  test::FakeSceneServices services;
  TotalCharge total{options_from_text("terms = ['charge_corona']", TotalCharge::parameters())};
  total.setup(services);
  EXPECT_TRUE(services.provides("charge"));
  EXPECT_FALSE(services.provides("charge_corona"));
  EXPECT_FALSE(services.attributes().has("charge_induced"));
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {}, 1e-3, 1000.0);
  total.add_forces(bodies.view(), 0.0, bodies.wrenches());
  EXPECT_EQ(bodies.force[0], Vec3{});
}

TEST(total_charge, charge_cannot_be_a_term_of_itself) {
  EXPECT_THROW(TotalCharge{options_from_text("terms = ['charge']", TotalCharge::parameters())}, Error);
}

}  // namespace
}  // namespace scree
