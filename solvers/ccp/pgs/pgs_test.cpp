// pgs: the conformance suite of CCP solvers in all its orders and steps, and what is its own.
#include "pgs.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {

INSTANTIATE_TEST_SUITE_P(
    pgs, CcpSolverConformance,
    testing::Values(SolverCase{"block", [] { return std::make_unique<Pgs>(PgsOptions{}); }},
                    SolverCase{"scalar", [] { return std::make_unique<Pgs>(PgsOptions{.scalar_step = true}); }},
                    SolverCase{"relaxed", [] { return std::make_unique<Pgs>(PgsOptions{.relaxation = 1.5}); }},
                    SolverCase{"coloured", [] { return std::make_unique<Pgs>(PgsOptions{.coloured = true}); }}),
    solver_case_name);

// The step's stiffness must bound the block, or an update may raise the objective: x^T (omega / step - A) x >= 0.
TEST(pgs, local_steps_bound_the_block) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const TestingProblem t = random_problem({.bodies = 6, .contacts = 12, .mass_decades = 2.0, .seed = seed});
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < t.contacts.size(); ++i) {
      const Mat3 a = diagonal_block(t.view(), i);
      const pgs::LocalStep step = pgs::block_step(a, 0.5, 1.0);
      for (int k = 0; k < 20; ++k) {
        const Vec3 x{normal(random), normal(random), normal(random)};
        const double bound = x.x * x.x / step.normal + (x.y * x.y + x.z * x.z) / step.tangent;
        EXPECT_LE(dot(x, a * x), bound * (1.0 + 1e-12));
      }
    }
  }
}

TEST(pgs, chunks_of_one_colour_share_no_movable_body) {
  const TestingProblem t = random_problem({.bodies = 4000, .immovable = 2, .contacts = 6000, .seed = 8});
  pgs::Colouring colouring;
  colouring.build(t.view());
  std::vector<int> seen(t.contacts.size(), 0);
  std::vector<std::int64_t> owner(t.inverse_mass.size());
  for (std::size_t c = 0; c + 1 < colouring.first().size(); ++c) {
    std::fill(owner.begin(), owner.end(), -1);
    for (std::size_t k = colouring.first()[c]; k < colouring.first()[c + 1]; ++k) {
      const std::size_t begin = colouring.chunks()[k] * pgs::Colouring::kChunkLength;
      for (std::size_t i = begin; i < std::min(begin + pgs::Colouring::kChunkLength, t.contacts.size()); ++i) {
        ++seen[i];
        for (const std::uint32_t body : {t.contacts[i].a, t.contacts[i].b}) {
          if (t.inverse_mass[body] == 0.0) continue;
          EXPECT_TRUE(owner[body] < 0 || owner[body] == static_cast<std::int64_t>(k));
          owner[body] = static_cast<std::int64_t>(k);
        }
      }
    }
  }
  for (std::size_t k = colouring.first().back(); k < colouring.chunks().size(); ++k) {
    const std::size_t begin = colouring.chunks()[k] * pgs::Colouring::kChunkLength;
    for (std::size_t i = begin; i < std::min(begin + pgs::Colouring::kChunkLength, t.contacts.size()); ++i) ++seen[i];
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

}  // namespace scree::test
