// What dem tells of contacts and bodies: the work that contacts take, the loads on bodies; and planes that it measures itself.
#include <gtest/gtest.h>

#include <cmath>

#include "dem_world.hpp"

namespace scree {
namespace {

using test::DemWorld;

void set_law(DemWorld& world, double rolling) {
  world.law.friction = 0.4;
  world.law.damping = 1.0;
  world.law.rolling = rolling;
  world.host.gravity = {0, 0, -9.81};
}

/// Rounding of other formulas for the same numbers, of 1e-16, grows with every few contacts.
void expect_the_same(const ContactView& a, const ContactView& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a.contact[k].b, b.contact[k].b);
    // One that parted within the step is told as last found, or as it is now.
    if (a.contact[k].gap < 0.0) {
      EXPECT_LT(norm(a.contact[k].point - b.contact[k].point), 1e-11);
    }
    EXPECT_LT(norm(a.impulse[k] - b.impulse[k]), 1e-9);
    EXPECT_NEAR(a.work[k], b.work[k], 1e-10);
  }
  ASSERT_EQ(a.loads.size(), 1u);
  EXPECT_LT(norm(a.loads[0].impulse - b.loads[0].impulse), 1e-9);
  EXPECT_LT(norm(a.loads[0].angular_impulse - b.loads[0].angular_impulse), 1e-9);
}

TEST(dem_load, a_plane_at_rest_acts_as_the_one_that_a_narrow_phase_finds) {
  for (const double rolling : {0.0, 1e-6}) {
    for (const bool midway : {false, true}) {
      DemWorld simple{{.at_contact_point = midway}}, found{{.at_contact_point = midway}};
      found.host.simple_floor = false;
      for (DemWorld* world : {&simple, &found}) {
        set_law(*world, rolling);
        world->bodies.position[0] = {0, 0, -0.0049};
        world->add_cloud(3, 0.5);
      }
      for (int k = 0; k < 3; ++k) {
        const StepSummary one = simple.step(1e-3), other = found.step(1e-3);
        EXPECT_EQ(one.contacts, other.contacts);
        EXPECT_NEAR(one.work.contact_loss, other.work.contact_loss, 1e-12);
        ASSERT_TRUE(k > 0 || simple.dem.contacts().size() > 9) << "nine of the floor";
        expect_the_same(simple.dem.contacts(), found.dem.contacts());
      }
      for (std::size_t i = 1; i < simple.bodies.id.size(); ++i) {
        EXPECT_LT(norm(simple.bodies.velocity[i] - found.bodies.velocity[i]), 1e-9);
      }
    }
  }
}

TEST(dem_load, a_floor_bears_the_weight_where_it_lies) {
  // Law: impulse -m g dt, about the floor's centre with the lever of where the ball rests.
  DemWorld world;
  set_law(world, 0.0);
  world.bodies.position[0] = {0.3, 0, 0};
  const std::size_t i = world.add_ball({1.0, 2.0, 0.01}, 0.01);
  for (int k = 0; k < 400; ++k) world.step(1e-3);
  const ContactView view = world.dem.contacts();
  ASSERT_EQ(view.loads.size(), 1u);
  const Vec3 weight = 1e-3 * world.bodies.mass[i] * world.host.gravity;
  EXPECT_LT(norm(view.loads[0].impulse - weight), 1e-9 * norm(weight));
  EXPECT_LT(norm(view.loads[0].angular_impulse - cross({0.7, 2.0, 0.0}, weight)), 1e-9 * norm(weight));
  EXPECT_EQ(view.loads[0].work, 0.0);
}

TEST(dem_load, the_load_of_a_body_that_moves_as_told_is_its_work) {
  // Law: what contacts do to the wall is what the wall does not give to the account; its impulse is the change of momentum.
  DemWorld world;
  set_law(world, 0.0);
  world.host.gravity = {};
  world.bodies.motion[0] = Motion::kinematic;
  world.bodies.position[0] = {0, 0, -0.006};
  world.bodies.velocity[0] = {0.1, 0, 0.3};
  world.bodies.angular_velocity[0] = {0, 0, 2.0};
  world.add_cloud(3, 0.1);
  double total = 0.0;
  for (int k = 0; k < 20; ++k) {
    const Vec3 before = world.momentum();
    const StepSummary summary = world.step(1e-3);
    const ContactView view = world.dem.contacts();
    ASSERT_EQ(view.loads.size(), 1u);
    EXPECT_NEAR(view.loads[0].work, -summary.work.boundary_work, 1e-15 + 1e-12 * std::abs(total));
    EXPECT_LT(norm(view.loads[0].impulse + (world.momentum() - before)), 1e-15);
    total += summary.work.boundary_work;
  }
  EXPECT_GT(total, 1e-6);
}

TEST(dem_load, a_ball_that_moves_as_told_gives_what_its_load_takes) {
  DemWorld world;
  set_law(world, 0.0);
  world.host.gravity = {};
  const std::size_t paddle = world.add_ball({0.006, 0.006, -0.006}, 0.005);
  world.bodies.motion[paddle] = Motion::kinematic;
  world.bodies.velocity[paddle] = {0.1, 0, 0.3};
  world.bodies.angular_velocity[paddle] = {0, 20.0, 2.0};
  world.add_cloud(3, 0.1);
  double total = 0.0;
  for (int k = 0; k < 20; ++k) {
    const StepSummary summary = world.step(1e-3);
    const ContactView view = world.dem.contacts();
    ASSERT_EQ(view.loads.size(), 2u) << "the plane's, and that of the ball";
    EXPECT_EQ(view.loads[1].body, paddle);
    EXPECT_NEAR(view.loads[1].work, -summary.work.boundary_work, 1e-15 + 1e-12 * std::abs(total));
    total += summary.work.boundary_work;
  }
  EXPECT_GT(total, 1e-6);
}

TEST(dem_load, contacts_take_what_the_account_says_is_lost) {
  // Over whole collisions. At each force the velocity is a predicted one: the error falls with the sub-step.
  const auto error_of = [](double h) {
    DemWorld world{{.sub_step = h, .force_step = true}};
    set_law(world, 0.0);
    world.host.gravity = {};
    world.add_cloud(4, 1.0);
    for (Vec3& position : world.bodies.position) position *= 1.1;  // none touches another
    const double before = world.kinetic_energy();
    double taken = 0.0, lost = 0.0;
    for (int k = 0; k < 100; ++k) {
      lost += world.step(1e-3).work.contact_loss;
      for (const double work : world.dem.contacts().work) taken += work;
    }
    EXPECT_GT(lost, 0.1 * before);
    return std::abs(taken - lost) / lost;
  };
  const double coarse = error_of(4e-5), fine = error_of(5e-6);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.25 * coarse);
}

}  // namespace
}  // namespace scree
