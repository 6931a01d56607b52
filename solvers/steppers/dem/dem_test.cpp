// What dem keeps: momentum, energy accounts, bits whatever the threads and lists, and springs through restarts and removals.
#include "dem.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem_world.hpp"
#include "scree/base/error.hpp"

namespace scree {
namespace {

using test::DemWorld;

void expect_same_bits(const DemWorld& one, const DemWorld& other) {
  EXPECT_EQ(one.bodies.position, other.bodies.position);
  EXPECT_EQ(one.bodies.velocity, other.bodies.velocity);
  EXPECT_EQ(one.bodies.angular_velocity, other.bodies.angular_velocity);
}

void rub(DemWorld& world) { world.law.friction = 0.5, world.law.damping = 0.3, world.law.stiffness = 2e3; }

TEST(dem, momentum_is_kept_and_with_levers_at_the_point_of_contact_angular_momentum_too) {
  DemWorld world{{.at_contact_point = true}};
  rub(world);
  world.add_cloud(6, 0.2);
  const Vec3 p = world.momentum(), l = world.angular_momentum();
  for (int k = 0; k < 5; ++k) world.step(1e-3);
  // 216 bodies, about 200 sub-steps: sums of rounding errors of p (1e-2 kg m/s).
  EXPECT_NEAR(norm(world.momentum() - p), 0.0, 1e-15);
  EXPECT_NEAR(norm(world.angular_momentum() - l), 0.0, 1e-14);
}

TEST(dem, kinetic_energy_changes_by_what_the_account_says) {
  DemWorld world;
  rub(world);
  world.host.gravity = {0, 0, -9.81};
  world.bodies.position[0] = {0, 0, -0.006};
  world.add_cloud(4, 0.2);
  for (int k = 0; k < 10; ++k) {
    const double before = world.kinetic_energy();
    const StepWork work = world.step(1e-3).work;
    const double change = work.force_work + work.boundary_work + work.joint_work - work.contact_loss;
    // Each kick times the mean of the velocities before and after it: exact but for rounding.
    EXPECT_NEAR(world.kinetic_energy() - before, change, 1e-12 * (world.kinetic_energy() + std::abs(change))) << k;
  }
}

TEST(dem, a_wall_that_moves_does_the_work_that_its_force_says) {
  DemWorld world;
  world.law.damping = 0.5;
  world.bodies.motion[0] = Motion::kinematic;
  world.bodies.position[0] = {}, world.bodies.velocity[0] = {0, 0, 0.3};
  const std::size_t i = world.add_ball({0, 0, 0.0101}, 0.01);
  double work = 0.0, impulse = 0.0;
  for (int k = 0; k < 20; ++k) {
    work += world.step(1e-3).work.boundary_work;
    const ContactView contacts = world.dem.contacts();
    for (const Vec3& j : contacts.impulse) impulse += j.x;
  }
  // The floor's speed times the momentum that it gave.
  EXPECT_NEAR(impulse, world.bodies.mass[i] * world.bodies.velocity[i].z, 1e-15);
  EXPECT_NEAR(work, 0.3 * impulse, 1e-15);
}

TEST(dem, threads_do_not_show_in_the_bits) {
  DemWorld one{{}, 1}, two{{}, 2};
  for (DemWorld* world : {&one, &two}) {
    rub(*world);
    world->add_cloud(14, 0.2);  // 2744 bodies: two chunks, with contacts across
    for (int k = 0; k < 2; ++k) world->step(1e-3);
  }
  expect_same_bits(one, two);
}

TEST(dem, the_skin_of_the_list_does_not_show_in_the_bits) {
  DemWorld thin{{.skin = 2e-5}}, thick{{.skin = 5e-3}};
  for (DemWorld* world : {&thin, &thick}) {
    rub(*world);
    world->add_cloud(5, 0.5);
    for (int k = 0; k < 10; ++k) world->step(1e-3);
  }
  EXPECT_GT(thin.host.searches, 5 * thick.host.searches);
  expect_same_bits(thin, thick);
}

class DemRestart : public testing::TestWithParam<double> {};
// With and without resistance to rolling, for which contacts keep a moment too.
INSTANTIATE_TEST_SUITE_P(rolling, DemRestart, testing::Values(0.0, 1e-6));

TEST_P(DemRestart, in_mid_contact_goes_on_with_the_same_bits) {
  DemWorld whole, first;
  for (DemWorld* world : {&whole, &first}) {
    rub(*world);
    world->law.rolling = GetParam();
    world->host.gravity = {0, 0, -9.81};
    world->bodies.position[0] = {0, 0, -0.005};
    world->add_cloud(5, 0.3);
    for (int k = 0; k < 3; ++k) world->step(1e-3);
  }
  test::MemoryState state;
  test::MemoryWriter writer{state};
  first.dem.save(writer);
  DemWorld second;
  rub(second);
  second.law.rolling = GetParam();
  second.host.gravity = first.host.gravity;
  second.bodies.position[0] = first.bodies.position[0];
  second.add_cloud(5, 0.3);
  second.bodies.position = first.bodies.position, second.bodies.orientation = first.bodies.orientation;
  second.bodies.velocity = first.bodies.velocity, second.bodies.angular_velocity = first.bodies.angular_velocity;
  second.time = first.time;
  second.dem.load(test::MemoryReader{state});
  for (int k = 0; k < 3; ++k) {
    whole.step(1e-3);
    second.step(1e-3);
  }
  expect_same_bits(whole, second);
}

TEST(dem, a_ball_on_a_slope_hangs_on_its_spring_when_other_bodies_go) {
  // Friction of 0.5 holds it against a pull of 0.05 of its weight, by the spring alone; its moment of inertia against rolling.
  DemWorld world;
  rub(world);
  world.host.gravity = {0.5, 0, -9.81};
  world.bodies.position[0] = {};
  const std::size_t other = world.add_ball({0.5, 0, 0.0099}, 0.01);
  const std::size_t i = world.add_ball({0, 0, 0.0099}, 0.01);
  world.bodies.inertia[i] = {1e3, 1e3, 1e3};
  world.bodies.position[i].z = 0.01 - world.bodies.mass[i] * 9.81 / world.law.stiffness;
  for (int k = 0; k < 300; ++k) world.step(1e-3);
  const double rest = world.bodies.position[i].x;
  EXPECT_NEAR(world.bodies.velocity[i].x, 0.0, 1e-5);
  // m g sin / kt
  EXPECT_NEAR(rest, world.bodies.mass[i] * 0.5 / world.law.stiffness,
              0.05 * world.bodies.mass[i] * 0.5 / world.law.stiffness);
  const auto forget = [&](auto& column) { column.erase(column.begin() + static_cast<std::ptrdiff_t>(other)); };
  forget(world.bodies.id), forget(world.bodies.motion), forget(world.bodies.shape), forget(world.bodies.material);
  forget(world.bodies.position), forget(world.bodies.orientation), forget(world.bodies.velocity);
  forget(world.bodies.angular_velocity), forget(world.bodies.mass), forget(world.bodies.inertia);
  forget(world.bodies.radius), forget(world.bodies.force), forget(world.bodies.torque);
  for (int k = 0; k < 50; ++k) world.step(1e-3);
  // Without its spring it would creep by that way again.
  EXPECT_NEAR(world.bodies.position[i - 1].x, rest, 1e-3 * rest);
}

TEST(dem, impulses_of_a_step_are_the_change_of_momentum) {
  DemWorld world;
  rub(world);
  const std::size_t a = world.add_ball({0, 0, 0}, 0.005, {0.3, 0.1, 0}), b = world.add_ball({0.0101, 0, 0}, 0.005);
  const Vec3 before = world.bodies.mass[b] * world.bodies.velocity[b];
  Vec3 given;
  std::size_t seen = 0;
  for (int k = 0; k < 10; ++k) {
    world.step(1e-3);
    const ContactView contacts = world.dem.contacts();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      ++seen;
      EXPECT_EQ(contacts.contact[c].a, a);
      EXPECT_EQ(contacts.contact[c].b, b);
      given += to_world(contact_frame(contacts.contact[c].normal), contacts.impulse[c]);
    }
  }
  EXPECT_GE(seen, 1u);
  // The frame of a report is that of the end of the step; the normal turns a little meanwhile.
  EXPECT_NEAR(norm(world.bodies.mass[b] * world.bodies.velocity[b] - before - given), 0.0, 1e-12);
}

TEST(dem, a_turning_plane_is_found_in_time) {
  // However far its points go: a neighbour list that is renewed too late lets the ball in.
  DemWorld world;
  world.host.gravity = {0, 0, -9.81};
  world.bodies.motion[0] = Motion::kinematic;
  world.bodies.position[0] = {}, world.bodies.angular_velocity[0] = {0, 0, 0.01};
  const std::size_t i = world.add_ball({0.3, 0, 0.06}, 0.01);
  double least = 1.0;
  for (int k = 0; k < 200; ++k) {
    world.step(1e-3);
    least = std::min(least, world.bodies.position[i].z);
  }
  // At 1 m/s the spring gives v sqrt(m/k) = 0.65 mm.
  EXPECT_GT(least, 0.01 - 7e-4);
  EXPECT_LT(least, 0.01);
}

TEST(dem, balls_with_one_centre_are_pushed_apart) {
  DemWorld world;
  const std::size_t a = world.add_ball({0, 0, 0}, 0.005), b = world.add_ball({0, 0, 0}, 0.005);
  world.step(1e-4);
  EXPECT_TRUE(is_finite(world.bodies.position[a]));
  EXPECT_GT(norm(world.bodies.position[b] - world.bodies.position[a]), 0.0);
}

TEST(dem, a_contact_shorter_than_a_step_is_reported) {
  DemWorld world;
  world.law.stiffness = 1e6;  // contact time of 5e-5 s
  world.add_ball({0, 0, 0}, 0.005, {1, 0, 0});
  world.add_ball({0.0105, 0, 0}, 0.005);
  world.step(1e-3);
  ASSERT_EQ(world.dem.contacts().size(), 1u);
  EXPECT_NEAR(world.dem.contacts().velocity_before[0].x, -1.0, 1e-9);
  EXPECT_NEAR(world.dem.contacts().velocity_after[0].x, 1.0, 2e-3);
  EXPECT_GT(world.dem.contacts().contact[0].gap, 0.0);
}

TEST(dem, a_step_that_the_law_calls_too_long_is_refused_unless_forced) {
  DemWorld refused{{.sub_step = 1e-3}}, forced{{.sub_step = 1e-3, .force_step = true}};
  refused.add_ball({0, 0, 0}, 0.005);
  forced.add_ball({0, 0, 0}, 0.005);
  EXPECT_THROW(refused.step(1e-3), Error);
  EXPECT_NO_THROW(forced.step(1e-3));
}

// 0.05 pi sqrt(m / k) of 5e-4 kg and 1e20 N/m is 3.5e-13 s: 3e9 in a step. So is a sub-step that the scene forces.
TEST(dem, a_step_of_more_than_a_million_sub_steps_is_refused) {
  DemWorld stiff, asked{{.sub_step = 0.9e-9, .force_step = true}};
  stiff.law.stiffness = 1e20;
  for (DemWorld* world : {&stiff, &asked}) {
    world->add_ball({0, 0, 0}, 0.005);
    try {
      world->step(1e-3);
      FAIL() << "was taken";
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("more than the 1e+06"), std::string::npos) << text;
      EXPECT_EQ(text.find("for 'stuff' on 'stuff'") != std::string::npos, world == &stiff) << text;
      EXPECT_EQ(text.find("longer `sub_step`") != std::string::npos, world == &asked) << text;
    }
  }
}

TEST(dem, fields_are_asked_once_a_step_when_they_are_steady) {
  DemWorld world{{.sub_step = 1e-5, .force_step = true}};
  world.add_ball({0, 0, 0}, 0.005);
  world.step(1e-3);
  EXPECT_EQ(world.host.asked, 1);
  world.host.steady = false;
  world.step(1e-3);
  EXPECT_EQ(world.host.asked, 1 + 101);
}

// Law: what a joint kept apart is known from the step on in which the joint is gone, however far the neighbours reach.
TEST(dem, balls_that_may_meet_from_now_on_do) {
  for (const double skin : {1e-6, 1e-2}) {
    DemWorld world{{.skin = skin}};
    world.law.stiffness = 1e5;
    world.add_ball({0, 0, 0}, 0.01);
    const std::size_t faller = world.add_ball({0, 0, 0.0203}, 0.01, {0, 0, -0.1});
    world.bodies.motion[1] = Motion::fixed;
    world.host.balls_meet = false;
    world.step(1e-3);
    world.host.balls_meet = true;
    double deepest = 0.0;
    for (int k = 0; k < 20; ++k) {
      deepest = std::max(deepest, world.step(1e-3).max_penetration);
    }
    // Without loss the overlap grows to v sqrt(m / k), and the ball flies back as it came.
    EXPECT_NEAR(deepest, 0.1 * std::sqrt(world.bodies.mass[faller] / world.law.stiffness), 1e-6) << skin;
    EXPECT_NEAR(world.bodies.velocity[faller].z, 0.1, 1e-3) << skin;
  }
}

}  // namespace
}  // namespace scree
