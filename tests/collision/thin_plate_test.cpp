// Thin plates at speed: whole simulations in which grains are thrown at plates of 1 mm, a lane for each.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "collision_parts.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using test::RandomNumbers;

constexpr double kHalfEdge = 0.06;       // of a plate [m]
constexpr double kHalfThickness = 5e-4;  // [m]
constexpr double kLaneWidth = 0.6;       // beyond what a grain flies in a run [m]
constexpr int kSteps = 12;               // of 1 ms

struct Lane {
  Pose plate;
  double side = 1.0;  // of the plate from which the grain comes
};

struct Throw {
  std::string toml;
  std::vector<Lane> lanes;
};

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << v.x << ", " << v.y << ", " << v.z << "]";
  return out.str();
}

/// A body of the scene at a pose.
std::string body(const char* shape, const Pose& pose, const std::string& more) {
  const Quat& q = pose.orientation;
  const Vec3 axis{q.x, q.y, q.z};
  std::ostringstream out;
  out.precision(17);
  out << "[[body]]\nshape = '" << shape << "'\nmaterial = 'stone'\nposition = " << text(pose.position)
      << "\nrotation_axis = " << text(norm(axis) > 0.0 ? axis : Vec3{0, 0, 1})
      << "\nrotation_angle = " << 2.0 * std::atan2(norm(axis), q.w) << "\n"
      << more;
  return out.str();
}

/// Plates in all directions, and a grain thrown at the middle of each: from 1 mm to 25 mm before it, at 0 to 75 degrees from
/// its normal, with up to `speed` [m/s] and up to `spin` [rad/s].
Throw throw_at(const char* plate, const char* grain, double speed, double spin, unsigned seed) {
  Throw out;
  out.toml =
      "[simulation]\nend_time = 1.0\ntime_step = 1e-3\n[time_stepper]\ntype = 'dvi'\n[ccp_solver]\ntype = 'pgs'\n"
      "tolerance = 1e-6\nmax_iterations = 2000\n[broad_phase]\ntype = 'grid'\n[[narrow_phase]]\ntype = "
      "'sphere_cluster'\n"
      "[[narrow_phase]]\ntype = 'polyhedron'\n[material.stone]\nfriction = 0.3\n"
      "[shape.plate]\ntype = 'box'\nsize = [0.12, 0.12, 1e-3]\n"
      "[shape.sheet]\ntype = 'triangle_mesh'\n"
      "vertices = [-0.06, -0.06, 0.0, 0.06, -0.06, 0.0, 0.06, 0.06, 0.0, -0.06, 0.06, 0.0]\n"
      "triangles = [0, 1, 2, 0, 2, 3]\n"
      "[shape.sphere]\ntype = 'sphere'\nradius = 5e-4\n"
      "[shape.cluster]\ntype = 'sphere_cluster'\nspheres = [{centre = [-1e-3, 0.0, 0.0], radius = 6e-4}, "
      "{centre = [0.0, 2e-4, 0.0], radius = 5e-4}, {centre = [1e-3, 0.0, 3e-4], radius = 4e-4}]\n"
      "[shape.box]\ntype = 'box'\nsize = [2e-3, 1e-3, 1.5e-3]\n"
      "[shape.hull]\ntype = 'convex_hull'\npoints = [0.0, 0.0, 1.2e-3, 1e-3, 0.0, -4e-4, -5e-4, 9e-4, -4e-4, -5e-4, "
      "-9e-4, "
      "-4e-4]\n";
  RandomNumbers random{seed};
  for (int k = 0; k < 60; ++k) {
    Lane lane;
    lane.plate = {kLaneWidth * Vec3{static_cast<double>(k % 8), static_cast<double>(k / 8), 0.0},
                  random.pose(0.0).orientation};
    lane.side = k % 2 == 0 ? 1.0 : -1.0;
    const double angle = random.uniform(0.0, 75.0 * std::numbers::pi / 180.0);
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec3 from{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), lane.side * std::cos(angle)};
    // The grain's bounding radius is below 2 mm.
    const double distance = random.uniform(3e-3, 25e-3) / std::cos(angle);
    const Vec3 velocity = rotate(lane.plate.orientation, -random.uniform(0.1, 1.0) * speed * from);
    const Pose start{transform(lane.plate, std::min(distance, 0.05) * from), random.pose(0.0).orientation};
    out.toml += body(plate, lane.plate, "");
    out.toml += body(grain, start,
                     "motion = 'dynamic'\nvelocity = " + text(velocity) +
                         "\nangular_velocity = " + text(random.in_cube(spin / std::numbers::sqrt3)) + "\n");
    out.lanes.push_back(lane);
  }
  return out;
}

struct Case {
  const char* plate;
  const char* grain;
};

class ThinPlate : public testing::TestWithParam<Case> {};

// Law: a grain that flies at the middle of a plate is never seen on its other side; with steps of ten times the plate's
// thickness or not, from whatever angle, turning or not. The plate's edges lie farther than it can slide before the look.
TEST_P(ThinPlate, nothing_passes) {
  unsigned seed = 1;
  std::size_t stopped = 0;
  for (const double speed : {3.0, 10.0}) {
    for (const double spin : {0.0, 300.0}) {
      const Throw thrown = throw_at(GetParam().plate, GetParam().grain, speed, spin, seed++);
      Simulation simulation{SceneDocument::parse(thrown.toml), test::plugin_host(), {}};
      for (int step = 0; step < kSteps; ++step) {
        simulation.step();
        const BodyView bodies = simulation.bodies().view();
        for (std::size_t k = 0; k < thrown.lanes.size(); ++k) {
          const Lane& lane = thrown.lanes[k];
          const Vec3 at = transform(inverse(lane.plate), bodies.position[2 * k + 1]);
          if (std::max(std::abs(at.x), std::abs(at.y)) > kHalfEdge) continue;  // slid off
          ASSERT_GT(lane.side * at.z, 0.0)
              << "lane " << k << ", step " << step << ", up to " << speed << " m/s and " << spin << " rad/s";
          const Vec3 v = rotate_back(lane.plate.orientation, bodies.velocity[2 * k + 1]);
          stopped += step == kSteps - 1 && std::abs(v.z) < 0.05 && std::abs(at.z) < 3e-3;
        }
      }
    }
  }
  EXPECT_GT(stopped, 20u) << "grains that do not reach the plate show nothing";
}

INSTANTIATE_TEST_SUITE_P(shapes, ThinPlate,
                         testing::Values(Case{"plate", "sphere"}, Case{"plate", "cluster"}, Case{"plate", "box"},
                                         Case{"plate", "hull"}, Case{"sheet", "sphere"}, Case{"sheet", "cluster"},
                                         Case{"sheet", "box"}, Case{"sheet", "hull"}),
                         [](const auto& each) { return std::string{each.param.plate} + "_" + each.param.grain; });

}  // namespace
}  // namespace scree
