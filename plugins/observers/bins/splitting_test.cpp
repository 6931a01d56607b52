#include "splitting.hpp"

#include <gtest/gtest.h>

#include <random>

namespace scree {
namespace {

TEST(splitting, grade_recovery_and_efficiency_follow_their_definitions) {
  // 10 kg of target and 30 kg of others in all; the product holds 8 kg and 2 kg.
  const ProductMass product{8, 10}, total{10, 40};
  EXPECT_DOUBLE_EQ(grade(product), 0.8);
  EXPECT_DOUBLE_EQ(recovery(product, total), 0.8);
  EXPECT_DOUBLE_EQ(value(Objective::recovery_times_grade, product, total), 0.64);
  EXPECT_DOUBLE_EQ(value(Objective::separation_efficiency, product, total), 0.8 - 2.0 / 30.0);
  EXPECT_EQ(grade({}), 0.0);
  EXPECT_EQ(recovery({}, {}), 0.0);
}

TEST(splitting, separation_efficiency_is_one_for_a_perfect_split_and_zero_for_a_blind_one) {
  EXPECT_DOUBLE_EQ(value(Objective::separation_efficiency, {10, 10}, {10, 40}), 1.0);
  EXPECT_NEAR(value(Objective::separation_efficiency, {3, 12}, {10, 40}), 0.0, 1e-16);  // 30 % of everything
}

TEST(splitting, finds_the_gap_between_two_heaps) {
  StripMasses masses;
  masses.target = {{0, 0, 0, 0, 2, 3}, {1, 4, 0, 0, 0, 0}};
  masses.all = {1, 4, 0, 0, 2, 3};
  const BestSplit one = best_split(masses, {1, 0}, Objective::recovery_times_grade);
  ASSERT_EQ(one.edges.size(), 1u);
  EXPECT_GE(one.edges[0], 2u);
  EXPECT_LE(one.edges[0], 4u);
  EXPECT_DOUBLE_EQ(one.value, 1.0);
  // The other way round, a product for heap 0 in front of the splitter cannot be pure.
  EXPECT_LT(best_split(masses, {0, kNoTarget}, Objective::recovery_times_grade).value, 0.51);
}

// All ascending choices of edges, one after the other.
double best_by_enumeration(const StripMasses& masses, const std::vector<std::size_t>& wanted, Objective objective,
                           std::size_t product, std::size_t from) {
  const std::size_t strips = masses.all.size();
  const auto mass_between = [&](std::size_t begin, std::size_t end) {
    ProductMass mass;
    for (std::size_t s = begin; s < end; ++s) {
      mass.all += masses.all[s];
      if (wanted[product] != kNoTarget) mass.target += masses.target[wanted[product]][s];
    }
    return mass;
  };
  const auto gain = [&](std::size_t to) {
    return wanted[product] == kNoTarget ? 0.0 : value(objective, mass_between(from, to), mass_between(0, strips));
  };
  if (product + 1 == wanted.size()) return from < strips ? gain(strips) : -1e9;
  double best = -1e9;
  for (std::size_t to = from + 1; to < strips; ++to) {
    best = std::max(best, gain(to) + best_by_enumeration(masses, wanted, objective, product + 1, to));
  }
  return best;
}

TEST(splitting, is_as_good_as_trying_every_combination) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  for (int round = 0; round < 30; ++round) {
    StripMasses masses{{std::vector<double>(9), std::vector<double>(9)}, std::vector<double>(9)};
    for (std::size_t s = 0; s < 9; ++s) {
      masses.target[0][s] = uniform(random);
      masses.target[1][s] = uniform(random);
      masses.all[s] = masses.target[0][s] + masses.target[1][s] + uniform(random);
    }
    for (const auto& wanted : {std::vector<std::size_t>{0, 1}, {1, kNoTarget, 0}, {0, 1, kNoTarget, 1}}) {
      for (const Objective objective : {Objective::recovery_times_grade, Objective::separation_efficiency}) {
        std::size_t judged = 0;
        for (const std::size_t target : wanted) judged += target != kNoTarget ? 1 : 0;
        const double expected = best_by_enumeration(masses, wanted, objective, 0, 0) / static_cast<double>(judged);
        // Running sums and sums from scratch differ by a few roundings of values of order one.
        EXPECT_NEAR(best_split(masses, wanted, objective).value, expected, 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace scree
