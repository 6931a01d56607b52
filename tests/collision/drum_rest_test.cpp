// Solids at rest in hollow drums: whole simulations of what lies, stands or fits closely.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "collision_parts.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSize = 0.01;    // of the solids, about [m]
constexpr double kRadius = 0.05;  // of the drums [m]
constexpr double kHalf = 0.04;    // half length of the drums [m]

/// A solid that touches its drum, placed in the drum's frame, where `down` is the way of gravity.
struct Lying {
  const char* what;
  const char* shape;
  bool upright;  // the drum stands on a lid: down is -z; else it lies, and down is -y
  Vec3 position;
  Vec3 axis;
  double angle;
};

/// Half the angle at the tip of the cone.
const double kSlope = std::atan2(0.5 * kSize, 2.0 * kSize);

const Lying kLying[] = {
    {"a cylinder along a drum", "cylinder", false, {0, -(kRadius - 0.5 * kSize), 0}, {0, 0, 1}, 0.3},
    {"a cylinder across a drum",
     "cylinder",
     false,
     {0, -(std::sqrt(kRadius* kRadius - kSize * kSize) - 0.5 * kSize), 0},
     {0, 1, 0},
     0.5 * kPi},
    {"a cylinder on a lid", "cylinder", true, {0.01, 0.01, -(kHalf - kSize)}, {0, 0, 1}, 0.0},
    {"a cylinder lying on a lid", "cylinder", true, {0.0, 0.01, -(kHalf - 0.5 * kSize)}, {1, 0, 0}, 0.5 * kPi},
    {"a cylinder that fills a drum", "plug", true, {0, 0, -(kHalf - kSize)}, {0, 0, 1}, 0.0},
    {"a cone on its mantle along a drum",
     "cone",
     false,
     {0, -(kRadius - 2.0 * kSize * std::sin(kSlope) * 0.5), 0},
     {1, 0, 0},
     kSlope},
    {"a cone on a lid", "cone", true, {-0.02, 0.0, -(kHalf - kSize)}, {0, 0, 1}, 0.0},
    {"an ellipsoid", "ellipsoid", false, {0, -(kRadius - 0.5 * kSize), 0.01}, {0, 0, 1}, 0.0},
    {"a mesh", "mesh", false, {0, -(std::sqrt(kRadius* kRadius - kSize * kSize) - kSize), 0}, {0, 0, 1}, 0.0},
};

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << v.x << ", " << v.y << ", " << v.z << "]";
  return out.str();
}

std::string scene(const Lying& lying) {
  std::ostringstream out;
  out.precision(17);
  const double a = kSize, half = 0.5 * kSize;
  out << "[simulation]\nend_time = 1.0\ntime_step = 1e-3\n[time_stepper]\ntype = 'dvi'\n[ccp_solver]\ntype = 'pgs'\n"
         "tolerance = 1e-6\nmax_iterations = 5000\n[broad_phase]\ntype = 'grid'\n"
         "[material.stone]\ndensity = 2500.0\nfriction = 0.5\n[[force_field]]\ntype = 'gravity'\nacceleration = "
      << (lying.upright ? "[0.0, 0.0, -9.81]" : "[0.0, -9.81, 0.0]")
      << "\n[shape.drum]\ntype = 'cylinder'\nhollow = true\n"
      << "radius = " << kRadius << "\nlength = " << 2.0 * kHalf
      << "\n[shape.cylinder]\ntype = 'cylinder'\nradius = " << half << "\nlength = " << 2.0 * a
      << "\n[shape.plug]\ntype = 'cylinder'\nradius = " << kRadius - 1e-6 << "\nlength = " << 2.0 * a
      << "\n[shape.cone]\ntype = 'cone'\nradius = " << half << "\nheight = " << 2.0 * a
      << "\n[shape.ellipsoid]\ntype = 'ellipsoid'\nsemi_axes = " << text({half, half, a})
      << "\n[shape.mesh]\ntype = 'triangle_mesh'\nvertices = [";
  for (int i = 0; i < 8; ++i) {
    out << (i == 0 ? "" : ", ") << ((i & 1) != 0 ? a : -a) << ", " << ((i & 2) != 0 ? a : -a) << ", "
        << ((i & 4) != 0 ? a : -a);
  }
  out << "]\ntriangles = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, "
         "1, 3, 5, 3, 7, 5]\n"
         "[[body]]\nshape = 'drum'\nmaterial = 'stone'\n[[body]]\nmotion = 'dynamic'\nmaterial = 'stone'\nshape = '"
      << lying.shape << "'\nposition = " << text(lying.position) << "\nrotation_axis = " << text(lying.axis)
      << "\nrotation_angle = " << lying.angle << "\n";
  return out.str();
}

class DrumRest : public testing::TestWithParam<Lying> {};

// Law: what is at rest stays there: after a thousand steps of 1 ms nothing has moved by a hundredth of its size or turned by
// more than 0.01 rad, nor does it move any more.
TEST_P(DrumRest, what_lies_in_a_drum_stays) {
  Simulation simulation{SceneDocument::parse(scene(GetParam())), test::plugin_host(), {}};
  const auto grain = [&] { return simulation.bodies().view(); };
  const Pose before{grain().position[1], grain().orientation[1]};
  for (int step = 0; step < 1000; ++step) simulation.step();
  EXPECT_LT(norm(grain().position[1] - before.position), 0.01 * kSize) << GetParam().what;
  const Quat turned = conjugate(before.orientation) * grain().orientation[1];
  EXPECT_LT(2.0 * norm(Vec3{turned.x, turned.y, turned.z}), 0.01) << GetParam().what;
  EXPECT_LT(norm(grain().velocity[1]), 1e-4) << GetParam().what;
}

INSTANTIATE_TEST_SUITE_P(solids, DrumRest, testing::ValuesIn(kLying), [](const auto& each) {
  std::string name = each.param.what;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace scree
