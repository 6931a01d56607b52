// A chain of 100 links, a drum of 10 t with grains of 1 g, a table with more joints than it needs: with 100 iterations a step of
// every solver that copes. Those that do not are told in docs/measured and in the README of the solver.
#include <gtest/gtest.h>

#include "rigs.hpp"
#include "scree/ccp/judge.hpp"
#include "solver_by_name.hpp"
#include "support/trials.hpp"

namespace scree::test {
namespace {

constexpr int kIterations = 100;
// The long run of the full tests; an unstable chain has left its joints within a hundred steps.
int steps() { return trials(250); }

/// What a run was like at its worst.
struct Worst {
  double joint = 0.0;     ///< [m]
  double gain = 0.0;      ///< energy above that of the start [J]
  double turn = 0.0;      ///< angular velocity [rad/s]
  double residual = 0.0;  ///< [m/s]
};

Worst run(Rig& rig, CcpSolver& solver) {
  Worst worst;
  const double start = rig.energy();
  for (int k = 0; k < steps(); ++k) {
    worst.residual = std::max(worst.residual, rig.advance(solver, kIterations).residual);
    worst.joint = std::max(worst.joint, rig.worst_joint());
    worst.gain = std::max(worst.gain, rig.energy() - start);
    for (const Twist& v : rig.velocity) worst.turn = std::max(worst.turn, norm(v.angular));
    if (!(worst.gain < 1e6)) break;  // gone
  }
  return worst;
}

/// Points at half a link from the centres of two bodies leave their tangents by this much in a step [m].
double path_error(const Rig& rig, double turn) { return 0.5 * kLink * (turn * rig.step) * (turn * rig.step); }

class Machine : public testing::TestWithParam<const char*> {};
class ChainInFull : public testing::TestWithParam<const char*> {};
class ChainByShares : public testing::TestWithParam<const char*> {};

// Joints are satisfied to the error of a straight step, all of which the next one undoes; no energy comes from nowhere.
TEST_P(ChainInFull, hangs_and_swings) {
  for (const bool level : {false, true}) {
    Rig rig = chain(level);
    const double weight = 50.0 * kGravity;
    const auto solver = solver_named(GetParam());
    const Worst worst = run(rig, *solver);
    EXPECT_LE(worst.residual, 1e-6);
    EXPECT_LE(worst.joint, path_error(rig, worst.turn) + 1e-8);
    EXPECT_LE(worst.gain, weight * 1e-8);  // as if the chain had been lifted by 10 nm
    if (level) continue;
    // Link k carries those below it.
    const std::size_t links = rig.joints.size();
    for (std::size_t k = 0; k < links; ++k) {
      const double carried = weight * rig.step * static_cast<double>(links - k) / static_cast<double>(links);
      EXPECT_NEAR(rig.gamma[3 * k], carried, 1e-3 * weight * rig.step);
    }
  }
}

// Solvers that know only gradients leave the long waves of a chain for later. A guess that goes on from step to step and joints
// that ask for all of their error at once are then unstable together; a share of 1/20 is less than what the iterations gain.
TEST_P(ChainByShares, hangs_and_swings_when_joints_ask_for_little_at_a_time) {
  for (const bool level : {false, true}) {
    Rig rig = chain(level);
    rig.share = 0.05;
    const auto solver = solver_named(GetParam());
    const Worst worst = run(rig, *solver);
    EXPECT_LE(worst.joint, path_error(rig, worst.turn) / rig.share + 1e-3 * kLink);
    EXPECT_LE(worst.gain, 50.0 * kGravity * 1e-4);  // of a weight of 490 N, as if lifted by 0.1 mm
  }
}

// A grain that is thrown forward rolls away at 5/7 of its speed, whatever the impulses on the way: angular momentum about the
// contact is kept.
TEST_P(Machine, drum_of_ten_tonnes_stays_and_grains_of_a_gram_roll_away) {
  Rig rig = drum();
  const auto solver = solver_named(GetParam());
  const Worst worst = run(rig, *solver);
  EXPECT_LE(worst.gain, 0.0);
  EXPECT_LE(norm(rig.velocity[1].linear) + norm(rig.velocity[1].angular), 1e-6);
  EXPECT_LE(norm(rig.position[1]), 1e-6);
  for (std::size_t k = 2; k < rig.mass.size(); ++k) {
    EXPECT_NEAR(rig.velocity[k].linear.x, 5.0 / 7.0 * kThrown, 2e-3 * kThrown);
    EXPECT_GE(rig.position[k].z - 1.005, -1e-5);
  }
}

// 24 equations more than unknowns, or four feet where three would do: what is not determined stays bounded, the table stands.
TEST_P(Machine, table_on_four_legs_stands) {
  for (const bool fixed : {true, false}) {
    Rig rig = table(fixed);
    const Vec3 plate = rig.position[1];
    const auto solver = solver_named(GetParam());
    const Worst worst = run(rig, *solver);
    EXPECT_LE(worst.joint, 1e-8);
    EXPECT_LE(norm(rig.position[1] - plate), 1e-6);
    EXPECT_LE(worst.gain, 1e-6);
    double carried = 0.0, most = 0.0;
    for (std::size_t k = fixed ? 6 : 0; k < rig.gamma.size(); k += fixed ? 12 : 3) {
      if (k < (fixed ? rig.gamma.size() : 12)) carried += rig.gamma[k], most = std::max(most, std::abs(rig.gamma[k]));
    }
    const double weight = 28.0 * kGravity * rig.step;
    EXPECT_NEAR(carried, weight, 1e-5 * weight);
    EXPECT_LE(most, weight);
  }
}

std::string name_of(const testing::TestParamInfo<const char*>& solver) { return solver.param; }

INSTANTIATE_TEST_SUITE_P(solvers, Machine,
                         testing::Values("pgs", "asgs", "jacobi", "apgd", "spg", "admm", "interior_point",
                                         "semismooth_newton"),
                         name_of);
INSTANTIATE_TEST_SUITE_P(solvers, ChainInFull, testing::Values("admm", "interior_point", "semismooth_newton"), name_of);
INSTANTIATE_TEST_SUITE_P(solvers, ChainByShares,
                         testing::Values("asgs", "apgd", "spg", "admm", "interior_point", "semismooth_newton"),
                         name_of);

}  // namespace
}  // namespace scree::test
