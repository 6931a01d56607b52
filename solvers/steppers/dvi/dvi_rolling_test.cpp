// Rolling and spinning friction of dvi.
#include "dvi_world.hpp"
#include "scree/math/contact_frame.hpp"

#include <gtest/gtest.h>

#include <random>

namespace scree::test {
namespace {

constexpr double kG = 9.81;
constexpr double kRadius = 0.05;

DviOptions exact() { return {.coulomb = true, .coulomb_limits = {.tolerance = 1e-12, .max_solves = 100}}; }

/// A sphere on the floor that rolls along x with the speed v, or floats there as the associated problem has it.
std::size_t add_rolling(World& w, double v, double floating) {
  const double turn = v / (kRadius + 0.5 * floating);
  const std::size_t i = w.add_sphere({0, 0, kRadius + floating}, kRadius, 1000.0, {v, 0, 0});
  w.bodies.angular_velocity[i] = {0, turn, 0};
  return i;
}

// What holds the sphere back: friction F and the moment mu_r N, with m v' = -F, I w' = R F - mu_r N, v = R w and I = 2/5 m
// R^2: v' = -5 mu_r g / (7 R). It rolls for v0 / |v'| and 7 R v0^2 / (10 mu_r g). The associated problem lets it float at
// h mu_r w, which takes 1e-5 of its radius from the arms here.
TEST(dvi_rolling, sphere_stops_after_the_closed_form_distance) {
  const double v0 = 0.5, mu_r = 1e-3, slow = 5 * mu_r * kG / (7 * kRadius);
  for (const double h : {2e-3, 1e-3}) {
    World w;
    w.host.material({.friction = 0.5, .rolling_friction = mu_r});
    const std::size_t i = add_rolling(w, v0, h * mu_r * v0 / kRadius);
    while (w.time < 0.9 * v0 / slow) w.step(h);
    EXPECT_NEAR(w.bodies.velocity[i].x, v0 - slow * w.time, 1e-4 * v0) << h;
    while (w.time < 1.1 * v0 / slow) w.step(h);
    EXPECT_NEAR(w.bodies.velocity[i].x, 0.0, 1e-12);
    EXPECT_NEAR(w.bodies.angular_velocity[i].y, 0.0, 1e-11);
    // Positions lag by half a step: v0 h / 2 in all.
    EXPECT_NEAR(w.bodies.position[i].x, 7 * kRadius * v0 * v0 / (10 * mu_r * kG) - 0.5 * v0 * h, 2e-4);
  }
}

// With exact Coulomb friction nothing floats, and v0 - |v'| t holds to rounding, whatever the step.
TEST(dvi_rolling, exact_friction_slows_a_rolling_sphere_by_the_closed_form_for_any_step) {
  const double v0 = 0.5, mu_r = 1e-3, slow = 5 * mu_r * kG / (7 * kRadius);
  for (const double h : {1e-2, 3e-3, 1e-3}) {
    World w{exact()};
    w.host.material({.friction = 0.5, .rolling_friction = mu_r});
    const std::size_t i = add_rolling(w, v0, 0.0);
    const int steps = static_cast<int>(0.9 * v0 / slow / h);
    w.run(steps, h);
    EXPECT_NEAR(w.bodies.velocity[i].x, v0 - slow * w.time, 1e-9) << h;
    EXPECT_NEAR(w.bodies.position[i].z, kRadius, 1e-10);
    EXPECT_NEAR(w.bodies.position[i].x, v0 * w.time - 0.5 * slow * w.time * (w.time + h), 1e-8);
  }
}

// A sliding contact that resists rolling: friction mu m g slows it, and turns it against mu_r m g.
TEST(dvi_rolling, exact_friction_of_a_sliding_sphere_turns_it_against_the_rolling_moment) {
  const double v0 = 1.0, mu = 0.2, mu_r = 2e-3, h = 1e-3;
  World w{exact()};
  w.host.material({.friction = mu, .rolling_friction = mu_r});
  const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius, 1000.0, {v0, 0, 0});
  w.run(50, h);
  const double t = 50 * h;
  EXPECT_NEAR(w.bodies.velocity[i].x, v0 - mu * kG * t, 1e-9);
  EXPECT_NEAR(w.bodies.angular_velocity[i].y, 2.5 * (mu - mu_r / kRadius) * kG / kRadius * t, 1e-7);
  EXPECT_NEAR(w.bodies.position[i].z, kRadius, 1e-10);
}

// Phi / h + u_n = mu_r |w_r|: the price of convexity, as for sliding.
TEST(dvi_rolling, associated_contact_floats_at_h_mu_r_times_its_rolling) {
  const double v0 = 0.5, mu_r = 5e-3, h = 1e-3;
  World w;
  w.host.material({.friction = 0.5, .rolling_friction = mu_r});
  const std::size_t i = add_rolling(w, v0, h * mu_r * v0 / kRadius);
  for (int k = 0; k < 50; ++k) {
    w.step(h);
    EXPECT_NEAR(w.bodies.position[i].z - kRadius, h * mu_r * w.bodies.angular_velocity[i].y, 1e-12);
  }
}

// A sphere spinning about the vertical: I w' = -mu_s m g, and it stops after w0 I / (mu_s m g) = 2 R^2 w0 / (5 mu_s g).
TEST(dvi_rolling, spinning_sphere_stops_after_the_closed_form_time) {
  const double w0 = 20.0, mu_s = 2e-3, h = 1e-3;
  World w;
  w.host.material({.friction = 0.5, .spinning_friction = mu_s});
  const double stop = 0.4 * kRadius * kRadius * w0 / (mu_s * kG);
  // The associated problem lets it float at h mu_s w: it starts there, and sinks as w falls.
  const Vec3 sinking{0, 0, -mu_s * w0 * h / stop};
  const std::size_t i = w.add_sphere({0, 0, kRadius + h * mu_s * w0}, kRadius, 1000.0, sinking);
  w.bodies.angular_velocity[i] = {0, 0, w0};
  while (w.time < 0.9 * stop) w.step(h);
  EXPECT_NEAR(w.bodies.angular_velocity[i].z, w0 * (1 - w.time / stop), 1e-9 * w0);
  while (w.time < stop + 2 * h) w.step(h);
  EXPECT_NEAR(w.bodies.angular_velocity[i].z, 0.0, 1e-11);
  EXPECT_NEAR(w.bodies.velocity[i].x, 0.0, 1e-12);
}

// A turntable takes a sphere at its middle along: I w' = mu_s m g until both turn alike.
TEST(dvi_rolling, turntable_spins_a_sphere_up_to_its_own_speed) {
  const double turn = 5.0, mu_s = 2e-3, h = 1e-3, gain = mu_s * kG / (0.4 * kRadius * kRadius);
  World w{exact()};
  w.host.material({.friction = 0.5, .spinning_friction = mu_s});
  w.bodies.motion[0] = Motion::kinematic;
  w.bodies.angular_velocity[0] = {0, 0, turn};
  const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius);
  while (w.time < 0.9 * turn / gain) w.step(h);
  EXPECT_NEAR(w.bodies.angular_velocity[i].z, gain * w.time, 1e-8 * turn);
  while (w.time < turn / gain + 2 * h) w.step(h);
  EXPECT_NEAR(w.bodies.angular_velocity[i].z, turn, 1e-9);
}

// On an incline a sphere stays iff tan a <= mu_r / R, and else rolls with 5/7 (g sin a - mu_r / R g cos a).
TEST(dvi_rolling, sphere_stays_on_an_incline_up_to_the_rolling_angle) {
  const double mu_r = 5e-3, limit = std::atan(mu_r / kRadius), h = 1e-3;
  for (const double turn : {-1e-3, 1e-3, 0.1}) {
    World w;
    w.host.material({.friction = 2.0, .rolling_friction = mu_r});
    const double sine = std::sin(limit + turn), cosine = std::cos(limit + turn);
    w.host.gravity = {kG * sine, 0, -kG * cosine};
    const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius);
    w.run(200, h);
    if (turn < 0) {
      EXPECT_NEAR(w.bodies.velocity[i].x, 0.0, 1e-11);
      const ContactView view = w.dvi.contacts();
      const ContactFrame frame = contact_frame(view.contact[0].normal);
      const double weight = w.bodies.mass[i] * kG * h;
      // Friction turns it by R m g sin a, and the floor's moment holds against that.
      const Vec3 force = to_world(frame, view.impulse[0]), moment = to_world(frame, view.angular_impulse[0]);
      EXPECT_NEAR(force.x, -weight * sine, 1e-9 * weight);
      EXPECT_NEAR(moment.y, -weight * sine * kRadius, 1e-9 * weight * kRadius);
      EXPECT_NEAR(moment.x, 0.0, 1e-9 * weight * kRadius);
      EXPECT_NEAR(moment.z, 0.0, 1e-9 * weight * kRadius);
    } else {
      // The normal impulse is raised by what lifts it to its growing gap: h mu_r a / R of g.
      const double a = 5.0 / 7.0 * kG * (sine - mu_r / kRadius * cosine);
      EXPECT_NEAR(w.bodies.velocity[i].x, a * 0.2, 2e-3 * a * 0.2 + mu_r / kRadius * a * h);
    }
  }
}

// Two equal spheres meet head-on, one spinning about the line between them. The moment mu_s g_n takes spin from one and
// gives it to the other, until both spin alike.
TEST(dvi_rolling, spin_is_shared_by_two_spheres_and_never_lost) {
  const double v = 1.0, w0 = 10.0;
  for (const double mu_s : {1e-3, 0.1}) {
    World w;
    w.host.gravity = {};
    w.host.material({.spinning_friction = mu_s});
    const std::size_t a = w.add_sphere({0, 0, 1}, kRadius, 1000.0, {v, 0, 0});
    const std::size_t b = w.add_sphere({2 * kRadius, 0, 1}, kRadius);
    w.bodies.angular_velocity[a] = {w0, 0, 0};
    w.step(1e-3);
    const double m = w.bodies.mass[a], inertia = w.bodies.inertia[a].x;
    const double wa = w.bodies.angular_velocity[a].x, wb = w.bodies.angular_velocity[b].x;
    EXPECT_NEAR(wa + wb, w0, 1e-11);
    // Sticking: g_n = m v / 2. Slipping: u_n = mu_s |w| of the associated problem, w = w0 - 2 mu_s g_n / I, and u_n = -v +
    // 2 g_n / m.
    const double slip_impulse = (v + mu_s * w0) / (2 / m + 2 * mu_s * mu_s / inertia);
    const double slip = w0 - 2 * mu_s * slip_impulse / inertia;
    EXPECT_NEAR(wa - wb, std::max(0.0, slip), 1e-9);
    EXPECT_EQ(slip > 0.0, mu_s < 0.01);  // both cases are met
    EXPECT_NEAR(w.dvi.contacts().angular_impulse[0].x, inertia * wb, 1e-12);
  }
}

// The length that angular rows are multiplied by drops out: a sphere ten times as large on the other side changes nothing.
TEST(dvi_rolling, moments_do_not_depend_on_who_is_named_first_or_how_large_the_other_is) {
  const double mu_s = 1e-3, v = 1.0, w0 = 50.0;
  std::vector<double> spin;
  for (const bool first : {true, false}) {
    World w;
    w.host.gravity = {};
    w.host.material({.spinning_friction = mu_s});
    const double big = 10 * kRadius;
    const auto add_small = [&] {
      const std::size_t i = w.add_sphere({first ? 0.0 : big + kRadius, 0, 1}, kRadius, 1000.0, {first ? v : -v, 0, 0});
      w.bodies.angular_velocity[i] = {w0, 0, 0};
      return i;
    };
    std::size_t small = first ? add_small() : 0;
    w.add_sphere({first ? big + kRadius : 0.0, 0, 1}, big);
    if (!first) small = add_small();
    w.step(1e-3);
    spin.push_back(w.bodies.angular_velocity[small].x);
  }
  EXPECT_LT(spin[0], w0);
  EXPECT_NEAR(spin[0], spin[1], 1e-10 * w0);
}

TEST(dvi_rolling, restitution_and_recovery_hold_as_for_plain_contacts) {
  for (const double mu_r : {0.0, 1e-3}) {
    World w;
    w.host.gravity = {};
    w.host.material({.friction = 0.5, .restitution = 0.7, .rolling_friction = mu_r});
    const std::size_t bouncing = w.add_sphere({0, 0, kRadius}, kRadius, 1000.0, {0, 0, -1.0});
    const std::size_t deep = w.add_sphere({1, 0, 0.8 * kRadius}, kRadius);
    w.step(1e-3);
    EXPECT_NEAR(w.bodies.velocity[bouncing].z, 0.7, 1e-12);
    EXPECT_NEAR(w.bodies.velocity[deep].z, 0.15, 1e-12);
    EXPECT_EQ(w.dvi.contacts().angular_impulse.empty(), mu_r == 0.0);
  }
}

/// Rough spheres and smooth ones in one pile; the floor is rough.
void fill(World& w) {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> u{-0.01, 0.01};
  for (int k = 0; k < 27; ++k) {
    const int layer = k / 9;
    const std::size_t i = w.add_sphere({0.1 * (k % 3) + u(random), 0.1 * (k / 3 % 3) + u(random), 0.06 + 0.11 * layer},
                                       0.05, 1000.0, {u(random), u(random), -1.0});
    w.bodies.material[i] = k % 2 == 0 ? 0 : 1;
  }
  w.host.material({.friction = 0.4, .restitution = 0.3, .rolling_friction = 2e-3, .spinning_friction = 1e-3});
  w.host.add_material({.friction = 0.4});
  w.host.tolerance = 1e-4;
}

TEST(dvi_rolling, pile_of_rough_and_smooth_spheres_keeps_every_cone) {
  World w;
  fill(w);
  std::size_t rough = 0, smooth = 0;
  for (int k = 0; k < 60; ++k) {
    w.step(2e-3);
    const ContactView view = w.dvi.contacts();
    for (std::size_t c = 0; c < view.size(); ++c) {
      const Vec3 g = view.impulse[c], q = view.angular_impulse.empty() ? Vec3{} : view.angular_impulse[c];
      EXPECT_LE(std::hypot(g.y, g.z), 0.4 * g.x + 1e-12);
      const bool resists = w.bodies.material[view.contact[c].a] + w.bodies.material[view.contact[c].b] == 0;
      EXPECT_LE(std::abs(q.x), (resists ? 1e-3 : 0.0) * g.x + 1e-14);
      EXPECT_LE(std::hypot(q.y, q.z), (resists ? 2e-3 : 0.0) * g.x + 1e-14);
      ++(resists ? rough : smooth);
    }
  }
  EXPECT_GT(rough, 100u);
  EXPECT_GT(smooth, 100u);
}

TEST(dvi_rolling, warm_start_solves_a_sphere_at_rest_on_an_incline_without_iterations) {
  World w;
  w.host.material({.friction = 2.0, .rolling_friction = 5e-3, .spinning_friction = 1e-3});
  w.host.gravity = {0.05 * kG, 0.03 * kG, -kG};
  w.add_sphere({0, 0, kRadius}, kRadius);
  w.run(3, 1e-3);
  w.host.iterations = 0;
  w.host.tolerance = 1e-9;
  w.run(10, 1e-3);
  EXPECT_EQ(w.host.iterations, 0);
  // With half the step half the impulse.
  w.run(10, 0.5e-3);
  EXPECT_EQ(w.host.iterations, 0);
}

TEST(dvi_rolling, two_threads_give_the_bits_of_one) {
  World one{{}, 1}, two{{}, 2};
  fill(one);
  fill(two);
  one.run(40, 2e-3);
  two.run(40, 2e-3);
  EXPECT_EQ(one.bodies.position, two.bodies.position);
  EXPECT_EQ(one.bodies.angular_velocity, two.bodies.angular_velocity);
}

TEST(dvi_rolling, restart_from_what_was_saved_goes_on_bit_for_bit) {
  World whole, half;
  fill(whole);
  fill(half);
  whole.run(60, 2e-3);
  half.run(30, 2e-3);
  World resumed;
  fill(resumed);
  resumed.resume(half);
  resumed.run(30, 2e-3);
  EXPECT_EQ(resumed.bodies.position, whole.bodies.position);
  EXPECT_EQ(resumed.bodies.orientation, whole.bodies.orientation);
  EXPECT_EQ(resumed.bodies.angular_velocity, whole.bodies.angular_velocity);
}

}  // namespace
}  // namespace scree::test
