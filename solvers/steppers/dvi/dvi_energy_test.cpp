// The energy account of dvi: identities of the scheme, and closed forms of what contacts lose and moving walls do.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "dvi_world.hpp"
#include "scree/model/kinetic_energy.hpp"

namespace scree::test {
namespace {

constexpr double kG = 9.81;

double kinetic(const World& w) {
  double sum = 0.0;
  for (BodyIndex i = 0; i < w.bodies.id.size(); ++i) sum += kinetic_energy(w.bodies.view(), i);
  return sum;
}

double potential(const World& w) {
  double sum = 0.0;
  for (std::size_t i = 1; i < w.bodies.id.size(); ++i) sum += w.bodies.mass[i] * kG * w.bodies.position[i].z;
  return sum;
}

StepWork run(World& w, int steps, double h) {
  StepWork sum;
  for (int k = 0; k < steps; ++k) sum += w.step(h).work;
  return sum;
}

void drop_balls(World& w, double anisotropy) {
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> u{-0.01, 0.01};
  for (int k = 0; k < 12; ++k) {
    const int layer = k / 4, row = k / 2 % 2;
    const Vec3 centre = {0.1 * (k % 2) + u(random), 0.1 * row + u(random), 0.05 + 0.1 * layer};
    const std::size_t i = w.add_sphere(centre, 0.05, 1000.0, {u(random), u(random), -1.0});
    w.bodies.inertia[i].x *= anisotropy;
    w.bodies.angular_velocity[i] = 100.0 * Vec3{u(random), u(random), u(random)};
  }
}

struct Account {
  const char* name;
  DviOptions options;
  ContactMaterial material;
  double anisotropy = 1.0;
};

// T1 - T0 = force_work + boundary_work - contact_loss holds for any impulses, so for badly solved problems too, with a floor
// that rises, slides and turns, surfaces that move against their bodies, and for all rows that contacts may have.
class Accounts : public ::testing::TestWithParam<Account> {};

TEST_P(Accounts, kinetic_energy_changes_by_work_less_loss_in_every_step) {
  World w{GetParam().options};
  w.host.material(GetParam().material);
  w.host.tolerance = 1e-2;
  drop_balls(w, GetParam().anisotropy);
  w.bodies.motion[0] = Motion::kinematic;
  w.bodies.velocity[0] = {0.3, -0.1, 0.2};
  w.bodies.angular_velocity[0] = {0.0, 0.0, 2.0};
  w.bodies.surface_motion.resize(w.bodies.id.size());
  w.bodies.surface_motion[0] = {{-0.2, 0.4, 0.0}, {0.0, 0.0, -3.0}};
  w.bodies.surface_motion[3] = {{0.1, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  StepWork sum;
  for (int k = 0; k < 60; ++k) {
    const double before = kinetic(w);
    const StepWork work = w.step(2e-3).work;
    sum += work;
    // T is some ten joules, of a dozen bodies: some hundred roundings of 1e-15.
    EXPECT_NEAR(kinetic(w) - before, work.force_work + work.boundary_work - work.contact_loss, 1e-12);
  }
  EXPECT_GT(sum.contact_loss, 0.1);  // there is something to account for
  EXPECT_GT(std::abs(sum.boundary_work), 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    dvi_energy, Accounts,
    ::testing::Values(Account{"associated", {}, {.friction = 0.4, .restitution = 0.3}},
                      Account{"coulomb",
                              {.coulomb = true, .coulomb_limits = {.tolerance = 1e-2}},
                              {.friction = 0.4, .restitution = 0.3}},
                      Account{"rolling", {}, {.friction = 0.4, .rolling_friction = 2e-3, .spinning_friction = 1e-3}},
                      Account{"compliant", {}, {.friction = 0.4, .compliance = 1e-5, .damping = 10.0}},
                      Account{"gyroscopic", {.gyroscopic = true}, {.friction = 0.4}, 0.6}),
    [](const auto& tested) { return std::string{tested.param.name}; });

const std::array<DviOptions, 2> kFrictionModels = {DviOptions{},
                                                   {.coulomb = true, .coulomb_limits = {.tolerance = 1e-10}}};

// Positions move with the velocities at the end of a step: T + U + loss differs from its start by the sum of h m g (v1 - v0) / 2,
// that is h m g (v - v_start) / 2. And every bounce loses (1 - e^2) of the energy that it comes with.
TEST(dvi_energy, bouncing_ball_closes_to_the_known_term_and_loses_what_restitution_says) {
  const double e = 0.7, h = 5e-4;
  for (const DviOptions& options : kFrictionModels) {
    World w{options};
    w.host.material({.friction = 0.3, .restitution = e});
    const std::size_t i = w.add_sphere({0, 0, 1.05}, 0.05);
    const double m = w.bodies.mass[i], start = potential(w);
    double loss = 0.0, expected = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double v = w.bodies.velocity[i].z;
      loss += w.step(h).work.contact_loss;
      const double now = w.bodies.velocity[i].z;
      if (v < -0.1 && now > 0.0) {
        // The impulse also takes the weight of the step, at half the difference of the speeds.
        expected += 0.5 * (1.0 - e * e) * m * v * v + 0.5 * (1.0 - e) * m * kG * h * -v;
        EXPECT_NEAR(loss, expected, 1e-12);
      }
      EXPECT_NEAR(kinetic(w) + potential(w) + loss, start + 0.5 * h * m * kG * now, 1e-12 * start * (k + 1));
    }
    EXPECT_GT(expected, 0.75 * m * kG);  // two bounces: 1 - e^4 = 0.76
  }
}

// A body that cannot turn, at 1 m/s over a floor of mu = 0.3: the contact takes all of its energy, mu m g a metre.
TEST(dvi_energy, sliding_block_loses_friction_times_distance) {
  const double h = 1e-3, mu = 0.3;
  for (const DviOptions& options : kFrictionModels) {
    World w{options};
    w.host.material({.friction = mu});
    // The associated model lets it float at mu h |u_t|, and would throw it up if it began lower.
    const double height = options.coulomb ? 0.0 : mu * h * 1.0;
    const std::size_t i = w.add_sphere({0, 0, 0.05 + height}, 0.05, 1000.0, {1.0, 0, 0});
    w.bodies.inertia[i] = {1e9, 1e9, 1e9};
    const double m = w.bodies.mass[i], start = kinetic(w) + potential(w);
    double loss = 0.0;
    for (int k = 0; k < 500; ++k) {
      loss += w.step(h).work.contact_loss;
      const double slid = w.bodies.position[i].x;
      // Two steps' worth of friction, and what is left of the height.
      EXPECT_NEAR(loss, mu * m * kG * slid, 2 * h * mu * m * kG);
      EXPECT_NEAR(kinetic(w) + potential(w) + loss, start + 0.5 * h * m * kG * w.bodies.velocity[i].z, 1e-11);
    }
    EXPECT_NEAR(loss, 0.5 * m, 2 * h * m * kG);
    EXPECT_NEAR(norm(w.bodies.velocity[i]), 0.0, 1e-9);
  }
}

// A plate that rises at V under a ball at rest, without restitution: m V^2 of work, half of it lost, then the weight's m g V.
TEST(dvi_energy, plate_that_rises_lifts_a_ball) {
  const double h = 1e-3, speed = 0.5;
  World w;
  w.bodies.motion[0] = Motion::kinematic;
  w.bodies.velocity[0] = {0, 0, speed};
  const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
  const double m = w.bodies.mass[i], start = potential(w);
  const StepWork first = w.step(h).work;
  EXPECT_NEAR(first.boundary_work, m * speed * speed + m * kG * h * speed, 1e-12);
  EXPECT_NEAR(first.contact_loss, 0.5 * m * speed * speed + 0.5 * m * kG * h * speed, 1e-12);
  const StepWork rest = run(w, 999, h);
  EXPECT_NEAR(rest.boundary_work, m * kG * speed * 999 * h, 1e-10);
  EXPECT_NEAR(rest.contact_loss, 0.0, 1e-10);
  EXPECT_NEAR(
      kinetic(w) + potential(w) + first.contact_loss + rest.contact_loss - first.boundary_work - rest.boundary_work,
      start + 0.5 * h * m * kG * speed, 1e-10);
}

// A sphere on a belt of speed V, from rest until it rolls at 2/7 V: the belt does 2/7 m V^2, half of which is lost. The belt is
// a body that moves, or the surface of one that stays.
TEST(dvi_energy, belt_that_sets_a_sphere_rolling_does_twice_the_work_that_arrives) {
  const double h = 1e-3, speed = 0.2;
  for (const bool surface : {false, true}) {
    World w{kFrictionModels[1]};
    w.host.material({.friction = 0.5});
    const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
    if (surface) {
      w.bodies.surface_motion = {Twist{{speed, 0, 0}, {}}, Twist{}};
    } else {
      w.bodies.motion[0] = Motion::kinematic;
      w.bodies.velocity[0] = {speed, 0, 0};
    }
    const double m = w.bodies.mass[i];
    const StepWork work = run(w, 400, h);
    EXPECT_NEAR(work.boundary_work, 2.0 / 7.0 * m * speed * speed, 1e-9);
    EXPECT_NEAR(work.contact_loss, 1.0 / 7.0 * m * speed * speed, 1e-9);
    EXPECT_NEAR(kinetic(w), 1.0 / 7.0 * m * speed * speed, 1e-9);
  }
}

TEST(dvi_energy, two_threads_give_the_bits_of_one) {
  World one{{}, 1}, two{{}, 2};
  for (World* w : {&one, &two}) {
    w->host.tolerance = 1e-4;
    drop_balls(*w, 1.0);
  }
  const StepWork a = run(one, 30, 2e-3), b = run(two, 30, 2e-3);
  EXPECT_EQ(a.contact_loss, b.contact_loss);
  EXPECT_EQ(a.force_work, b.force_work);
}

}  // namespace
}  // namespace scree::test
