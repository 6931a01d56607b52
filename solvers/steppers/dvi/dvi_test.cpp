// dvi against closed forms: flight, bounces, rest, piles, warm start and restart.
#include "dvi_world.hpp"

#include <gtest/gtest.h>

#include <random>

namespace scree::test {
namespace {

constexpr double kG = 9.81;

// The semi-implicit scheme: v exact, x_N = x_exact + a h t / 2.
TEST(dvi, free_flight_is_the_semi_implicit_closed_form) {
  World w;
  const std::size_t i = w.add_sphere({0, 0, 10}, 0.1, 1000.0, {1, 2, 3});
  const double h = 1e-3;
  w.run(1000, h);
  const double t = 1000 * h;
  // A thousand sums of numbers near ten: 1000 roundings of 1e-15.
  EXPECT_NEAR(w.bodies.velocity[i].z, 3 - kG * t, 1e-12);
  EXPECT_NEAR(w.bodies.position[i].z, 10 + 3 * t - 0.5 * kG * t * t - 0.5 * kG * h * t, 1e-11);
  EXPECT_NEAR(w.bodies.position[i].x, t, 1e-12);
}

struct Bounces {
  std::vector<double> time;    ///< [s]
  std::vector<double> height;  ///< greatest after each bounce [m]
};

Bounces bounce(double restitution, double h, double end) {
  World w;
  w.host.material({.restitution = restitution});
  const double r = 0.05;
  const std::size_t i = w.add_sphere({0, 0, 1.0 + r}, r);
  Bounces out;
  double top = 0.0, before = 0.0;
  while (w.time < end) {
    w.step(h);
    const double v = w.bodies.velocity[i].z;
    if (before < 0.0 && v > 0.0) {
      if (!out.time.empty()) out.height.push_back(top);
      out.time.push_back(w.time);
      top = 0.0;
    }
    top = std::max(top, w.bodies.position[i].z - r);
    before = v;
  }
  return out;
}

TEST(dvi, ball_from_one_metre_meets_bounce_times_and_heights) {
  const double e = 0.8, h = 2.5e-4;
  const Bounces b = bounce(e, h, 2.5);
  ASSERT_GE(b.height.size(), 3u);
  // First order: each bounce is early by at most a step, and each flight adds g h t / 2 to the height.
  const double fall = std::sqrt(2.0 / kG);
  EXPECT_NEAR(b.time[0], fall, 2 * h);
  EXPECT_NEAR(b.time[1], fall * (1 + 2 * e), 6 * h);
  EXPECT_NEAR(b.height[0], e * e, 8 * h);
  EXPECT_NEAR(b.height[1], std::pow(e, 4), 8 * h);
}

// t1 (1 + e) / (1 - e) = 1.354571 s for e = 0.5. Bounces end at min_bounce_speed, which leaves out at most
// 2 * 0.1 / g (1 + e + ...) = 0.04 s of the sum; without that limit the ball must be at rest just after.
TEST(dvi, ball_stops_when_the_geometric_sum_of_its_bounces_is_over) {
  for (const double h : {1e-3, 5e-4}) {
    World w{DviOptions{.limits = {.min_bounce_speed = 1e-3}}};
    w.host.material({.restitution = 0.5});
    const std::size_t i = w.add_sphere({0, 0, 1.05}, 0.05);
    double stop = 0.0;
    while (w.time < 1.6) {
      w.step(h);
      if (std::abs(w.bodies.velocity[i].z) > 2 * kG * h) stop = w.time;
    }
    EXPECT_NEAR(stop, 1.354571, 25 * h);
    EXPECT_NEAR(w.bodies.position[i].z, 0.05, kG * h * h);
  }
}

TEST(dvi, slow_impacts_do_not_bounce_and_far_ones_do_not_bounce_in_the_air) {
  World w;
  w.host.material({.restitution = 0.9});
  const std::size_t slow = w.add_sphere({0, 0, 0.05}, 0.05, 1000.0, {0, 0, -0.05});
  const std::size_t fast = w.add_sphere({1, 0, 0.05 + 1.5e-2}, 0.05, 1000.0, {0, 0, -1.0});
  w.step(1e-2);
  EXPECT_NEAR(w.bodies.velocity[slow].z, 0.0, 1e-12);
  EXPECT_LT(w.bodies.velocity[fast].z, -1.0);  // 15 mm away at 1 m/s: not within 10 ms
  w.step(1e-2);
  EXPECT_NEAR(w.bodies.velocity[fast].z, 0.9 * (1.0 + kG * 1e-2), 1e-12);
}

TEST(dvi, impulses_at_rest_carry_the_weight_of_the_column_above) {
  World w;
  const double r = 0.05, h = 1e-3;
  for (int k = 0; k < 4; ++k) w.add_sphere({0, 0, r + 2 * r * k}, r);
  w.run(20, h);
  const double weight = w.bodies.mass[1] * kG * h;
  const ContactView view = w.dvi.contacts();
  ASSERT_EQ(view.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const double above = 4.0 - static_cast<double>(view.contact[k].b - 1);
    EXPECT_NEAR(view.impulse[k].x, above * weight, 1e-9 * weight);
    EXPECT_NEAR(view.velocity_after[k].x, 0.0, 1e-11);
  }
}

// Who looks at a contact finds its point on the bodies' surfaces when he puts them back by the age.
TEST(dvi, contacts_are_of_the_bodies_at_the_beginning_of_the_step) {
  World w;
  const double r = 0.05, h = 1e-2;
  const std::size_t i = w.add_sphere({0, 0, r}, r, 1000.0, {0.5, 0, 0});
  w.step(h);
  const ContactView view = w.dvi.contacts();
  ASSERT_EQ(view.size(), 1u);
  EXPECT_EQ(view.age, h);
  const Vec3 then = w.bodies.position[i] - view.age * w.bodies.velocity[i];
  EXPECT_NEAR(norm(view.contact[0].point - then), r, 1e-12);
}

// Four spheres, the lower three a gap apart: W/3 and 0.10595 W between them, 4/3 W under each lower one.
TEST(dvi, four_spheres_share_the_weight_as_statics_says) {
  World w;
  w.host.material({.friction = 0.8});
  const double r = 0.05, h = 1e-3, side = 2 * r * 1.001;
  const double ring = side / std::sqrt(3.0);
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0943951023931953 * k;
    w.add_sphere({ring * std::cos(angle), ring * std::sin(angle), r}, r);
  }
  w.add_sphere({0, 0, r + std::sqrt(4 * r * r - ring * ring)}, r);
  w.step(h);
  w.step(h);
  const double weight = w.bodies.mass[1] * kG * h;
  const double sine = ring / (2 * r), cosine = std::sqrt(1 - sine * sine);
  for (std::size_t k = 0; k < w.dvi.contacts().size(); ++k) {
    const ContactView view = w.dvi.contacts();
    const Vec3 g = view.impulse[k];
    if (view.contact[k].a == 0) {
      EXPECT_NEAR(g.x, 4.0 / 3.0 * weight, 1e-6 * weight);
      continue;
    }
    if (view.contact[k].b != 4) continue;
    // Force along the line between the foot of the lower sphere and its contact: normal N, tangent N tan(a / 2).
    const double tangent = sine / (1 + cosine), normal = weight / 3 / (cosine + sine * tangent);
    EXPECT_NEAR(g.x, normal, 1e-6 * weight);
    EXPECT_NEAR(std::hypot(g.y, g.z), normal * tangent, 1e-6 * weight);
  }
}

// Newton's cradle of two: v1 = ((1 + e) / 2 - e) v, v2 = (1 + e) / 2 v.
TEST(dvi, two_equal_spheres_exchange_momentum_by_restitution) {
  const double e = 0.7, v = 2.0;
  World w;
  w.host.gravity = {};
  w.host.material({.restitution = e});
  const std::size_t a = w.add_sphere({0, 0, 1}, 0.05, 1000.0, {v, 0, 0});
  const std::size_t b = w.add_sphere({0.1, 0, 1}, 0.05);
  w.step(1e-3);
  EXPECT_NEAR(w.bodies.velocity[a].x, ((1 + e) / 2 - e) * v, 1e-12);
  EXPECT_NEAR(w.bodies.velocity[b].x, (1 + e) / 2 * v, 1e-12);
}

TEST(dvi, overlap_is_undone_at_the_recovery_speed_at_most) {
  World w{DviOptions{.limits = {.recovery_speed = 0.15}}};
  w.host.gravity = {};
  const std::size_t deep = w.add_sphere({0, 0, 0.04}, 0.05);
  const std::size_t shallow = w.add_sphere({1, 0, 0.05 - 1e-5}, 0.05);
  const StepSummary s = w.step(1e-3);
  EXPECT_NEAR(w.bodies.velocity[deep].z, 0.15, 1e-12);
  EXPECT_NEAR(w.bodies.velocity[shallow].z, 1e-5 / 1e-3, 1e-12);
  EXPECT_NEAR(s.max_penetration, 0.01, 1e-12);
  EXPECT_NEAR(s.mean_penetration, 0.5 * (0.2 + 2e-4), 1e-12);
}

// A compliant contact at rest is compressed by m g / k.
TEST(dvi, compliant_contact_settles_at_the_spring_s_compression) {
  World w;
  const double k = 1e4;
  w.host.material({.compliance = 1 / k, .damping = 20.0});
  const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
  w.run(3000, 1e-3);
  const double compression = w.bodies.mass[i] * kG / k;
  EXPECT_NEAR(0.05 - w.bodies.position[i].z, compression, 1e-6 * compression);
  EXPECT_NEAR(w.dvi.contacts().impulse[0].x, w.bodies.mass[i] * kG * 1e-3, 1e-9);
}

TEST(dvi, kinematic_bodies_move_as_told_and_carry_others) {
  World w{DviOptions{.coulomb = true, .coulomb_limits = {.tolerance = 1e-12}}};
  w.host.material({.friction = 0.5});
  w.bodies.motion[0] = Motion::kinematic;
  w.bodies.velocity[0] = {0.2, 0, 0};
  const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
  w.run(1000, 1e-3);
  EXPECT_NEAR(w.bodies.position[0].x, 0.2, 1e-12);
  EXPECT_EQ(w.bodies.velocity[0], (Vec3{0.2, 0, 0}));
  // A sphere on a moving belt from rest: friction acts until the surfaces agree, v = 2/7 of the belt's (5/7 rule).
  EXPECT_NEAR(w.bodies.velocity[i].x, 2.0 / 7.0 * 0.2, 1e-9);
}

TEST(dvi, warm_start_solves_a_resting_pile_without_iterations) {
  for (const bool warm : {false, true}) {
    World w{DviOptions{.warm_start = warm}};
    for (int k = 0; k < 5; ++k) w.add_sphere({0, 0, 0.05 + 0.1 * k}, 0.05);
    w.run(30, 1e-3);
    w.host.iterations = 0;
    w.host.tolerance = 1e-9;
    w.run(10, 1e-3);
    if (warm) {
      EXPECT_EQ(w.host.iterations, 0);
    } else {
      EXPECT_GT(w.host.iterations, 100);
    }
  }
}

void fill(World& w) {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> u{-0.01, 0.01};
  for (int k = 0; k < 27; ++k) {
    const int layer = k / 9;
    w.add_sphere({0.1 * (k % 3) + u(random), 0.1 * (k / 3 % 3) + u(random), 0.06 + 0.11 * layer}, 0.05, 1000.0,
                 {u(random), u(random), -1.0});
  }
  w.host.material({.friction = 0.4, .restitution = 0.3});
  w.host.tolerance = 1e-4;
}

TEST(dvi, two_threads_give_the_bits_of_one) {
  World one{{}, 1}, two{{}, 2};
  fill(one);
  fill(two);
  one.run(60, 2e-3);
  two.run(60, 2e-3);
  EXPECT_EQ(one.bodies.position, two.bodies.position);
  EXPECT_EQ(one.bodies.angular_velocity, two.bodies.angular_velocity);
}

TEST(dvi, restart_from_what_was_saved_goes_on_bit_for_bit) {
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
