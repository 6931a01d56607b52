// Sweeps over contacts that resist rolling: what groups of four promise, whatever stands in their lanes.
#include <gtest/gtest.h>

#include <random>

#include "scree/ccp/judge.hpp"
#include "scree/ccp/sweep/block_sweep.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {
namespace {

struct Kind {
  bool isotropic = true;
  bool compliant = false;
  std::size_t rows = 6;  ///< 0: cones of 5 and 6 rows mixed
};

/// A cloud of bodies that meet each other and an immovable one in contacts that resist rolling.
TestingProblem cloud(const Kind& kind, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  std::normal_distribution<double> normal;
  const auto direction = [&] { return normalized(Vec3{normal(random), normal(random), normal(random)}); };
  TestingProblem t;
  t.add_immovable();
  for (int k = 0; k < 12; ++k) {
    const double m = 1.0 + 10.0 * uniform(random), j = 0.1 * m;
    t.add_body(m, kind.isotropic ? Vec3{j, j, j} : Vec3{j, 1.5 * j, 2.0 * j});
  }
  for (int k = 0; k < 30; ++k) {
    const auto a = static_cast<std::uint32_t>(12.0 * uniform(random));
    const auto b = a + 1 + static_cast<std::uint32_t>((12.0 - a) * uniform(random));
    const std::size_t rows = kind.rows != 0 ? kind.rows : 5 + random() % 2;
    CcpBlock block{.kind = CcpKind::cone, .a = a, .b = std::min(b, 12U), .friction = 0.8 * uniform(random)};
    block.spinning = 0.3 * uniform(random), block.rolling = k % 5 == 0 ? 0.0 : 0.3 * uniform(random);
    std::vector<double> r(rows);
    for (double& x : r) x = normal(random);
    r[0] += 0.5;
    t.add_block(block, rows_at_a_point(rows, true, direction(), 0.5 * direction(), 0.5 * direction(), 0.3), r);
  }
  if (kind.compliant) t.compliance.assign(t.view().rows(), 0.02);
  return t;
}

class ConeSweepTest : public testing::TestWithParam<Kind> {};

// Every update lowers the objective, forwards and backwards, and leaves the bodies with the velocities of the impulses.
TEST_P(ConeSweepTest, never_raises_the_objective_and_keeps_the_velocities) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TestingProblem t = cloud(GetParam(), seed);
    const CcpProblem p = t.view();
    ContactSweep contacts;
    contacts.bind(p, {});
    BlockSweep blocks;
    blocks.bind(p, contacts, {});
    std::vector<double> gamma(p.rows(), 0.0);
    std::vector<Twist> w(p.bodies()), expected(p.bodies());
    contacts.set_velocities(w);
    blocks.set_impulses(gamma);
    DelassusOperator delassus;
    delassus.bind(p, nullptr);
    double before = 0.0;
    for (int k = 0; k < 20; ++k) {
      blocks.sweep(k % 2 == 1);
      blocks.impulses(gamma);
      for (const CcpBlock& block : t.blocks) {
        EXPECT_LE(violation(block, std::span{gamma}.subspan(block.first_row, block.rows)), 1e-13);
      }
      const double after = delassus.objective(gamma);
      EXPECT_LE(after, before + 1e-12);  // energies of order 1
      before = after;
    }
    EXPECT_LT(before, -0.01);
    contacts.velocities(w);
    delassus.body_velocities(gamma, expected);
    for (std::size_t k = 0; k < w.size(); ++k) {
      EXPECT_LE(norm(w[k].linear - expected[k].linear), 1e-12);
      EXPECT_LE(norm(w[k].angular - expected[k].angular), 1e-12);
    }
  }
}

// Sweeps end at the solution that the judge asks for: compliance makes it the only one, and the way there fast.
TEST_P(ConeSweepTest, ends_where_the_judge_finds_a_solution) {
  TestingProblem t = cloud(GetParam(), 9);
  t.compliance.assign(t.view().rows(), 0.1);
  const CcpProblem p = t.view();
  ContactSweep contacts;
  contacts.bind(p, {});
  BlockSweep blocks;
  blocks.bind(p, contacts, {});
  std::vector<double> gamma(p.rows(), 0.0);
  contacts.set_velocities(std::vector<Twist>(p.bodies()));
  blocks.set_impulses(gamma);
  for (int k = 0; k < 2000; ++k) blocks.sweep(k % 2 == 1);
  blocks.impulses(gamma);
  EXPECT_LE(ccp_residual(p, gamma), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(kinds, ConeSweepTest,
                         testing::Values(Kind{true, false, 6}, Kind{true, true, 5}, Kind{false, false, 0},
                                         Kind{false, true, 0}));

}  // namespace
}  // namespace scree::test
