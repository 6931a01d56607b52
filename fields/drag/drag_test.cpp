#include "drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"
#include "support/semi_implicit.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

using test::Flight;
using test::ThreeSteps;

constexpr double kPi = std::numbers::pi;
constexpr double kViscosity = 1.81e-5;  // of air [Pa s]
constexpr double kAirDensity = 1.225;   // [kg/m3]

/// A drag field set up in a scene of its own, and the bodies it acts on.
struct Scene {
  explicit Scene(const char* toml, int threads = 1)
      : services{threads}, drag{options_from_text(toml, Drag::parameters())}, bodies{services.attributes()} {
    drag.setup(services);
  }
  test::FakeSceneServices services;
  Drag drag;
  test::TestBodies bodies;
};

TEST(drag, stokes_force_is_six_pi_eta_r_u_against_the_motion) {
  Scene scene{"law = 'stokes'"};
  scene.bodies.add_sphere(1, {}, 2e-3, 946.0, {0.3, -0.4, 1.2});
  scene.drag.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  const double factor = 6.0 * kPi * kViscosity * 2e-3;
  // Three products each: a few roundings.
  EXPECT_NEAR(scene.bodies.force[0].x, -factor * 0.3, 1e-15 * factor);
  EXPECT_NEAR(scene.bodies.force[0].y, factor * 0.4, 1e-15 * factor);
  EXPECT_NEAR(scene.bodies.force[0].z, -factor * 1.2, 1e-15 * factor);
}

TEST(drag, schiller_naumann_force_is_half_rho_cd_area_speed_squared) {
  for (const double speed : {1e-3, 0.1, 2.0, 7.0, 8.0, 60.0}) {
    Scene scene{"law = 'schiller_naumann'"};
    const double r = 1e-3;
    scene.bodies.add_sphere(1, {}, r, 946.0, {0.0, speed, 0.0});
    scene.drag.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
    const double reynolds = kAirDensity * speed * 2.0 * r / kViscosity;  // 0.14 ... 8121: both branches
    const double cd = reynolds < 1000.0 ? 24.0 / reynolds * (1.0 + 0.15 * std::pow(reynolds, 0.687)) : 0.44;
    const double expected = 0.5 * kAirDensity * cd * kPi * r * r * speed * speed;
    EXPECT_NEAR(scene.bodies.force[0].y, -expected, 1e-13 * expected) << "at " << speed << " m/s";
  }
}

TEST(drag, schiller_naumann_at_rest_in_still_air_is_zero_and_finite) {
  Scene scene{"law = 'schiller_naumann'"};
  scene.bodies.add_sphere(1, {}, 1e-3, 946.0);
  scene.drag.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  EXPECT_EQ(scene.bodies.force[0], Vec3{});
}

TEST(drag, only_the_velocity_relative_to_the_wind_counts) {
  for (const char* law : {"law = 'stokes'\n", "law = 'schiller_naumann'\n"}) {
    Scene calm{law};
    Scene windy{(std::string{law} + "wind = [1.0, 2.0, -0.5]").c_str()};
    calm.bodies.add_sphere(1, {}, 1e-3, 946.0, {0.25, -0.5, 2.0});
    windy.bodies.add_sphere(1, {}, 1e-3, 946.0, {1.25, 1.5, 1.5});
    calm.drag.add_forces(calm.bodies.view(), 0.0, calm.bodies.wrenches());
    windy.drag.add_forces(windy.bodies.view(), 0.0, windy.bodies.wrenches());
    // All velocities above are exact in binary: so are their differences, and the forces are the same bits.
    EXPECT_EQ(calm.bodies.force[0], windy.bodies.force[0]) << law;
    EXPECT_NE(calm.bodies.force[0], Vec3{});
  }
}

TEST(drag, leaves_immovable_bodies_alone) {
  Scene scene{"wind = [5.0, 0.0, 0.0]"};
  scene.bodies.add_immovable(1, {});
  scene.drag.add_forces(scene.bodies.view(), 0.0, scene.bodies.wrenches());
  EXPECT_EQ(scene.bodies.force[0], Vec3{});
}

TEST(drag, result_does_not_depend_on_the_number_of_threads) {
  Scene one{"", 1};
  Scene two{"", 2};
  for (Scene* scene : {&one, &two}) {
    for (BodyId i = 1; i <= 5000; ++i) {
      const double s = static_cast<double>(i);
      scene->bodies.add_sphere(i, {}, 1e-4 * (1.0 + std::fmod(s, 7.0)), 946.0, {std::sin(s), std::cos(s), 0.1 * s});
    }
    scene->drag.add_forces(scene->bodies.view(), 0.0, scene->bodies.wrenches());
  }
  EXPECT_TRUE(one.bodies.force == two.bodies.force);
}

/// Time and speed of a grain (946 kg/m3, r 1 mm) that fell 0.5 m from rest, with step `h`. Within the last step, which
/// is uniform motion in this scheme, the crossing is interpolated.
Flight drop(const char* law, double h) {
  Scene scene{law};
  scene.bodies.add_sphere(1, {}, 1e-3, 946.0);
  Flight flight;
  while (true) {
    const Flight before = flight;
    test::advance_flight(flight, h, [&](const Flight& at) {
      scene.bodies.velocity[0] = at.velocity;
      scene.drag.add_forces(scene.bodies.view(), at.time, scene.bodies.wrenches());
      return Vec3{0.0, -9.81, 0.0} + scene.bodies.force[0] / scene.bodies.mass[0];
    });
    if (flight.position.y > -0.5) continue;
    const double part = (before.position.y + 0.5) / (before.position.y - flight.position.y);
    flight.time = before.time + part * h;
    flight.velocity = before.velocity + part * (flight.velocity - before.velocity);
    return flight;
  }
}

void expect_first_order(const char* law, double exact_time, double exact_speed) {
  ThreeSteps time{};
  ThreeSteps speed{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Flight end = drop(law, test::kThreeSteps[k]);
    time[k] = end.time;
    speed[k] = -end.velocity.y;
    testing::Test::RecordProperty("time_error_" + std::to_string(k), std::to_string(time[k] - exact_time));
    // The scheme runs h/2 ahead of free fall; drag changes that little over this drop.
    EXPECT_NEAR(time[k], exact_time, 0.6 * test::kThreeSteps[k]);
    EXPECT_NEAR(speed[k], exact_speed, 6.0 * test::kThreeSteps[k]);
  }
  EXPECT_NEAR(test::observed_order(time, exact_time), 1.0, 0.05);
  // What is left after extrapolation is the interpolation of the crossing, g h^2 / 8 / v = 1e-8 s at 0.25 ms, times
  // the 8/3 of the last extrapolation, and the same at 0.5 ms and 1 ms: 4 and 16 times as much with weights 2 and 1/3.
  EXPECT_NEAR(test::extrapolated(time), exact_time, 4e-7);
  EXPECT_NEAR(test::extrapolated(speed), exact_speed, 4e-6);
}

// The states were computed independently, by a Runge-Kutta method of high order.
TEST(drag, stokes_drop_converges_to_the_exact_fall) { expect_first_order("law = 'stokes'", 0.3207449371, 3.10345815); }

TEST(drag, schiller_naumann_drop_converges_to_the_exact_fall) {
  expect_first_order("law = 'schiller_naumann'", 0.3294103332, 2.892074734);
}

TEST(drag, setup_states_which_grains_the_step_is_safe_for) {
  Scene scene{"law = 'stokes'"};
  ASSERT_EQ(scene.services.log_lines().size(), 1u);
  // 4.5 * 1.81e-5 Pa s * 1 ms
  EXPECT_NE(scene.services.log_lines()[0].find("8.145e-08 kg/m"), std::string::npos);
}

}  // namespace
}  // namespace scree
