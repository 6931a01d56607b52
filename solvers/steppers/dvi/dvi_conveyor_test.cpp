// Surfaces that move against their bodies: belts and turntables, against closed forms.
#include "dvi_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree::test {
namespace {

constexpr double kG = 9.81;

DviOptions exact() { return {.coulomb = true, .coulomb_limits = {.tolerance = 1e-12, .max_solves = 100}}; }

/// A body so hard to turn that it slides like a block, on the floor.
std::size_t add_block(World& w) {
  const double infinite = 1e12;
  return w.bodies.add(w.bodies.id.size(), Motion::dynamic, {0, 0, 0.05}, 0.05, 1.0, {infinite, infinite, infinite}, {});
}

void move_surface(World& w, std::size_t body, const Twist& motion) {
  w.bodies.surface_motion.resize(w.bodies.id.size());
  w.bodies.surface_motion[body] = motion;
}

// Put on a belt of speed v at rest, it gains mu g t until v, after v^2 / (2 mu g).
TEST(dvi_conveyor, block_reaches_the_belt_s_speed_after_the_closed_form_distance) {
  const double v = 2.0, mu = 0.4, h = 1e-3, stop = v / (mu * kG);
  for (const bool coulomb : {true, false}) {
    World w{coulomb ? exact() : DviOptions{}};
    w.host.material({.friction = mu});
    const std::size_t i = add_block(w);
    // The associated problem floats at mu h |u_t|: start there, or it is thrown up.
    if (!coulomb) w.bodies.position[i].z += mu * h * v;
    move_surface(w, 0, {{v, 0, 0}, {}});
    double reached = 0.0;
    while (w.time < stop + 0.1) {
      w.step(h);
      const double u = w.bodies.velocity[i].x;
      // The float mu h |u_t| sinks at mu a h, a = mu g: once, the first step's normal impulse is less by m mu^2 g h.
      if (w.time < stop - h) {
        EXPECT_NEAR(u, mu * kG * w.time, 1e-9 + (coulomb ? 0.0 : mu * mu * mu * kG * h));
      }
      if (u < v - 1e-6) reached = w.bodies.position[i].x;
    }
    EXPECT_NEAR(w.bodies.velocity[i].x, v, 1e-9);
    EXPECT_NEAR(w.bodies.velocity[i].y, 0.0, 1e-12);
    // The last step before the belt's speed is up to h early, positions lag by half a step: 1.5 h v.
    EXPECT_NEAR(reached, v * v / (2 * mu * kG), 1.5 * h * v);
    EXPECT_EQ(w.bodies.position[0], Vec3{}) << "the belt's body stays";
  }
}

// Friction on the belt's partner is along the belt's motion, whichever of the two is a.
TEST(dvi_conveyor, friction_takes_the_partner_along_whichever_body_is_the_belt) {
  const double mu = 0.3, h = 1e-3, m = 1.0;
  for (const bool belt_is_a : {true, false}) {
    World w{exact()};
    w.host.material({.friction = mu});
    const std::size_t i = add_block(w);
    move_surface(w, belt_is_a ? 0 : i, {{1.0, 0, 0}, {}});
    w.step(h);
    // A floor that runs to +x pushes the block to +x; a crawler's belt, running to +x below, drives it to -x.
    EXPECT_NEAR(w.bodies.velocity[i].x, (belt_is_a ? 1 : -1) * mu * kG * h, 1e-12);
    const ContactView view = w.dvi.contacts();
    ASSERT_EQ(view.size(), 1u);
    const Vec3 impulse = to_world(contact_frame(view.contact[0].normal), view.impulse[0]);
    EXPECT_NEAR(impulse.x, (belt_is_a ? 1 : -1) * mu * m * kG * h, 1e-12);
    // What observers are told is the velocity of the surfaces.
    const Vec3 before = to_world(contact_frame(view.contact[0].normal), view.velocity_before[0]);
    const Vec3 after = to_world(contact_frame(view.contact[0].normal), view.velocity_after[0]);
    EXPECT_NEAR(before.x, belt_is_a ? -1.0 : 1.0, 1e-12);
    EXPECT_NEAR(after.x, before.x + w.bodies.velocity[i].x, 1e-12);
  }
}

// The belt climbs an incline: the block is carried up at its speed iff mu >= tan a, else it slides down.
TEST(dvi_conveyor, inclined_belt_carries_a_block_iff_mu_is_at_least_tan_a) {
  const double mu = 0.5, v = 0.5;
  for (const double turn : {-0.02, 0.02}) {
    const double angle = std::atan(mu) + turn;
    World w{exact()};
    w.host.material({.friction = mu});
    w.host.gravity = {-kG * std::sin(angle), 0, -kG * std::cos(angle)};
    const std::size_t i = add_block(w);
    w.bodies.velocity[i].x = v;
    move_surface(w, 0, {{v, 0, 0}, {}});
    w.run(200, 1e-3);
    const double slides = kG * (mu * std::cos(angle) - std::sin(angle)) * 0.2;
    EXPECT_NEAR(w.bodies.velocity[i].x, turn < 0 ? v : v + slides, 1e-9);
  }
}

// Only the tangents see a surface: one that blows along the normal does nothing.
TEST(dvi_conveyor, motion_along_the_normal_is_dropped) {
  World w;
  w.host.material({.friction = 0.5, .restitution = 0.9});
  const std::size_t i = add_block(w);
  move_surface(w, 0, {{0, 0, 3.0}, {}});
  w.run(10, 1e-3);
  EXPECT_NEAR(w.bodies.velocity[i].z, 0.0, 1e-12);
  EXPECT_NEAR(w.bodies.position[i].z, 0.05, 1e-12);
  EXPECT_NEAR(w.dvi.contacts().velocity_after[0].x, 0.0, 1e-12);
}

// A surface is carried by its body: the same belt turned by 90 degrees about z runs to +y.
TEST(dvi_conveyor, surface_turns_with_its_body) {
  World w{exact()};
  w.host.material({.friction = 0.5});
  w.bodies.orientation[0] = {std::numbers::sqrt2 / 2, 0, 0, std::numbers::sqrt2 / 2};
  const std::size_t i = add_block(w);
  move_surface(w, 0, {{0.1, 0, 0}, {}});
  w.run(100, 1e-3);
  EXPECT_NEAR(w.bodies.velocity[i].x, 0.0, 1e-12);
  EXPECT_NEAR(w.bodies.velocity[i].y, 0.1, 1e-10);
}

// A turntable whose body stays does to a sphere what one that turns as a whole does, rolling and spinning included.
TEST(dvi_conveyor, turning_surface_equals_a_turning_body_of_revolution) {
  const auto run = [](bool surface) {
    World w{exact()};
    w.host.material({.friction = 0.4, .rolling_friction = 1e-3, .spinning_friction = 1e-3});
    const std::size_t i = w.add_sphere({0.2, 0.1, 0.05}, 0.05);
    const Vec3 turn{0, 0, 4.0};
    w.bodies.motion[0] = Motion::kinematic;
    if (surface) {
      move_surface(w, 0, {{}, turn});
    } else {
      w.bodies.angular_velocity[0] = turn;
    }
    w.run(300, 1e-3);
    return std::pair{w.bodies.velocity[i], w.bodies.angular_velocity[i]};
  };
  const auto [v, spin] = run(true);
  const auto [v_body, spin_body] = run(false);
  // The same problem but for rounding.
  EXPECT_LT(norm(v - v_body), 1e-9);
  EXPECT_LT(norm(spin - spin_body), 1e-7);
  EXPECT_GT(std::abs(spin.z), 0.1);
  EXPECT_GT(norm(v), 0.1);
}

}  // namespace
}  // namespace scree::test
