// Grains at rest beside plates of 1 mm, struck towards them: whole simulations, a lane for each plate.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "collision_parts.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using test::RandomNumbers;

constexpr int kLanes = 60;
constexpr int kSteps = 8;           // of 1 ms
constexpr double kLaneWidth = 0.3;  // beyond what a grain flies in a run [m]

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << v.x << ", " << v.y << ", " << v.z << "]";
  return out.str();
}

/// Plates with normals along z, a grain at rest up to 2 mm above each, and a second one that comes down on it with 1 to 10 m/s.
std::string scene(const std::string& plate, const std::string& grain, double restitution) {
  std::ostringstream out;
  out.precision(17);
  out << "[simulation]\nend_time = 1.0\ntime_step = 1e-3\n[time_stepper]\ntype = 'dvi'\n[ccp_solver]\ntype = 'pgs'\n"
         "tolerance = 1e-6\nmax_iterations = 5000\n[broad_phase]\ntype = 'grid'\n"
         "[material.stone]\nfriction = 0.3\nrestitution = "
      << restitution
      << "\n[shape.plate]\ntype = 'box'\nsize = [0.12, 0.12, 1e-3]\n"
         "[shape.sheet]\ntype = 'triangle_mesh'\n"
         "vertices = [-0.06, -0.06, 0.0, 0.06, -0.06, 0.0, 0.06, 0.06, 0.0, -0.06, 0.06, 0.0]\n"
         "triangles = [0, 1, 2, 0, 2, 3]\n[shape.sphere]\ntype = 'sphere'\nradius = 5e-4\n"
         "[shape.box]\ntype = 'box'\nsize = [1e-3, 1e-3, 1e-3]\n[shape.cylinder]\ntype = 'cylinder'\nradius = 5e-4\n"
         "length = 1e-3\n";
  RandomNumbers random{5};
  for (int k = 0; k < kLanes; ++k) {
    const int row = k / 8, column = k % 8;
    const Vec3 lane = kLaneWidth * Vec3{static_cast<double>(column), static_cast<double>(row), 0.0};
    const double gap = random.decades(1e-5, 2e-3), fall = random.uniform(1.0, 10.0);
    const Vec3 rest = lane + Vec3{0.0, 0.0, 5e-4 + 5e-4 + gap};
    const double apart = random.uniform(0.0, 1.0) * 1e-3 * fall;  // so that they meet within the first step
    out << "[[body]]\nshape = '" << plate << "'\nmaterial = 'stone'\nposition = " << text(lane)
        << "\n[[body]]\nmotion = 'dynamic'\nmaterial = 'stone'\nshape = '" << grain << "'\nposition = " << text(rest)
        << "\n[[body]]\nmotion = 'dynamic'\nmaterial = 'stone'\nshape = '" << grain
        << "'\nposition = " << text(rest + Vec3{0.0, 0.0, 1e-3 + apart}) << "\nvelocity = " << text({0.0, 0.0, -fall})
        << "\n";
  }
  return out.str();
}

struct Case {
  const char* plate;
  const char* grain;
  double restitution;
};

class StruckBesidePlate : public testing::TestWithParam<Case> {};

// Law: a grain at rest that is struck towards a plate, and what strikes it, are never seen on the plate's other side.
TEST_P(StruckBesidePlate, nothing_passes) {
  const Case& param = GetParam();
  Simulation simulation{
      SceneDocument::parse(scene(param.plate, param.grain, param.restitution)), test::plugin_host(), {}};
  int struck = 0;
  for (int step = 0; step < kSteps; ++step) {
    simulation.step();
    const BodyView bodies = simulation.bodies().view();
    for (std::size_t k = 0; k < 3 * kLanes; ++k) {
      if (bodies.motion[k] != Motion::dynamic) continue;
      ASSERT_GT(bodies.position[k].z, 0.0) << "body " << k << ", step " << step;
      struck += step == 0 && k % 3 == 1 && norm(bodies.velocity[k]) > 0.0;
    }
  }
  EXPECT_GT(struck, kLanes / 2) << "of the grains at rest; others show nothing";
}

INSTANTIATE_TEST_SUITE_P(grains, StruckBesidePlate,
                         testing::Values(Case{"plate", "sphere", 0.0}, Case{"plate", "sphere", 0.9},
                                         Case{"plate", "box", 0.0}, Case{"plate", "box", 0.9},
                                         Case{"plate", "cylinder", 0.5}, Case{"sheet", "sphere", 0.5},
                                         Case{"sheet", "box", 0.5}),
                         [](const auto& each) {
                           return std::string{each.param.plate} + "_" + each.param.grain + "_" +
                                  std::to_string(static_cast<int>(10.0 * each.param.restitution));
                         });

}  // namespace
}  // namespace scree
