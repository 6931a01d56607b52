// Southwell: many short columns of equal spheres, each with the closed form of its impulses.
#include "scree/ccp/sweep/southwell.hpp"

#include <gtest/gtest.h>

#include "scree/ccp/judge.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {
namespace {

constexpr std::size_t kColumns = 500, kHeight = 3;
constexpr double kMass = 0.2, kSpeed = 1.0;

/// Columns that stand on one floor and would fall at kSpeed: contact k of a column, from below, carries kHeight - k spheres.
TestingProblem columns() {
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  for (std::size_t column = 0; column < kColumns; ++column) {
    for (std::size_t k = 0; k < kHeight; ++k) {
      const std::uint32_t sphere = t.add_body(kMass, {1e-4, 1e-4, 1e-4});
      t.add_contact(k == 0 ? floor : sphere - 1, sphere, {0, 0, 1}, {0, 0, k == 0 ? 0.0 : 0.05}, {0, 0, -0.05}, 0.5,
                    {k == 0 ? -kSpeed : 0.0, 0.0, 0.0});
    }
  }
  return t;
}

double carried(std::size_t k) { return static_cast<double>(kHeight - k) * kMass * kSpeed; }

std::vector<double> solution() {
  std::vector<double> gamma(3 * kColumns * kHeight, 0.0);
  for (std::size_t i = 0; i < kColumns * kHeight; ++i) gamma[3 * i] = carried(i % kHeight);
  return gamma;
}

/// A problem, and what Southwell works on.
struct Bench {
  explicit Bench(std::vector<double> guess) : gamma{std::move(guess)} {
    delassus.bind(problem, nullptr);
    w.resize(problem.bodies());
    delassus.body_velocities(gamma, w);
    southwell.bind(delassus);
  }
  TestingProblem t = columns();
  CcpProblem problem = t.view();
  DelassusOperator delassus;
  Southwell southwell;
  std::vector<double> gamma;
  std::vector<Twist> w;
};

}  // namespace

// One column without its impulses: it is solved, and nothing else is touched or visited.
TEST(southwell, solves_where_the_residual_is_and_leaves_the_rest) {
  constexpr std::size_t kEmpty = 77;
  std::vector<double> guess = solution();
  for (std::size_t k = 0; k < kHeight; ++k) guess[3 * (kEmpty * kHeight + k)] = 0.0;
  Bench b{guess};
  const double before = b.delassus.objective(b.gamma);
  const Southwell::Outcome outcome = b.southwell.relax(b.gamma, b.w, 1e-9, 1000000);
  EXPECT_TRUE(outcome.reached);
  EXPECT_LE(ccp_residual(b.problem, b.gamma), 1e-9 * (1.0 + 1e-6));  // w is summed up update by update
  EXPECT_LT(b.delassus.objective(b.gamma), before);
  for (std::size_t i = 0; i < b.problem.contacts.size(); ++i) {
    // A residual of 1e-9 m/s leaves an impulse of kHeight^2 masses times that.
    const double tolerance = i / kHeight == kEmpty ? 1e-9 * kMass * kHeight * kHeight : 0.0;
    EXPECT_NEAR(b.gamma[3 * i], carried(i % kHeight), tolerance);
  }
  // The error of the column falls by cos^2(pi / 7) = 0.81 a pass, so that 100 passes reach 1e-9; neighbours double the visits.
  EXPECT_LE(outcome.visits, 200 * kHeight);
}

// The same columns, each tied to the floor by a joint of three rows in place of the lowest contact, which carries the same.
TEST(southwell, joints_are_solved_as_contacts_are) {
  constexpr std::size_t kEmpty = 77, kContacts = kHeight - 1;
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  std::vector<double> guess, of_joints;
  for (std::size_t column = 0; column < kColumns; ++column) {
    for (std::size_t k = 0; k < kHeight; ++k) {
      const std::uint32_t sphere = t.add_body(kMass, {1e-4, 1e-4, 1e-4});
      const double carries = column == kEmpty ? 0.0 : carried(k);
      if (k > 0) t.add_contact(sphere - 1, sphere, {0, 0, 1}, {0, 0, 0.05}, {0, 0, -0.05}, 0.5, {});
      (k > 0 ? guess : of_joints).insert((k > 0 ? guess : of_joints).end(), {carries, 0.0, 0.0});
    }
  }
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    const CcpBlock joint{.kind = CcpKind::free, .a = floor, .b = 1 + column * static_cast<std::uint32_t>(kHeight)};
    t.add_block(joint, rows_at_a_point(3, false, {0, 0, 1}, {}, {0, 0, -0.05}, 1.0), {-kSpeed, 0.0, 0.0});
  }
  guess.insert(guess.end(), of_joints.begin(), of_joints.end());
  const CcpProblem problem = t.view();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  std::vector<Twist> w(problem.bodies());
  delassus.body_velocities(guess, w);
  Southwell southwell;
  southwell.bind(delassus);
  const Southwell::Outcome outcome = southwell.relax(guess, w, 1e-9, 1000000);
  EXPECT_TRUE(outcome.reached);
  EXPECT_LE(outcome.visits, 200 * kHeight);  // as with contacts alone
  const double tolerance = 1e-9 * kMass * kHeight * kHeight;
  for (std::size_t column = 0; column < kColumns; ++column) {
    EXPECT_NEAR(guess[3 * (kColumns * kContacts + column)], carried(0), tolerance);
    for (std::size_t k = 1; k < kHeight; ++k) {
      EXPECT_NEAR(guess[3 * (column * kContacts + k - 1)], carried(k), tolerance);
    }
  }
}

TEST(southwell, velocities_stay_those_of_the_impulses) {
  std::vector<double> guess = solution();
  guess[3] = guess[4] = 0.0;
  Bench b{guess};
  b.southwell.relax(b.gamma, b.w, 1e-6, 1000000);
  std::vector<Twist> w(b.w.size());
  b.delassus.body_velocities(b.gamma, w);
  for (std::size_t k = 0; k < w.size(); ++k) {
    EXPECT_NEAR(norm(w[k].linear - b.w[k].linear) + norm(w[k].angular - b.w[k].angular), 0.0, 1e-13);
  }
}

// A quarter of the columns is more than few: nothing is done.
TEST(southwell, leaves_a_problem_alone_where_many_contacts_miss) {
  std::vector<double> guess = solution();
  for (std::size_t column = 0; column < kColumns; column += 4) guess[3 * column * kHeight] = 0.0;
  Bench b{guess};
  EXPECT_EQ(b.southwell.relax(b.gamma, b.w, 1e-9, 1000000).visits, 0U);
  EXPECT_EQ(b.gamma, guess);
}

TEST(southwell, keeps_its_budget) {
  std::vector<double> guess = solution();
  for (std::size_t k = 0; k < kHeight; ++k) guess[3 * k] = 0.0;
  Bench b{guess};
  const Southwell::Outcome outcome = b.southwell.relax(b.gamma, b.w, 1e-12, 7);
  EXPECT_FALSE(outcome.reached);
  EXPECT_EQ(outcome.visits, 7U);
}

// All columns stand on one plate that moves: 500 contacts that would each wake all others. The queue holds few, and the end is
// checked over all of them.
TEST(southwell, body_that_all_columns_touch_is_solved_with_them) {
  TestingProblem t = columns();
  t.inverse_mass[0] = 1e-6;
  t.inverse_inertia[0] = Mat3::diagonal({1e-3, 1e-3, 1e-3});
  const CcpProblem problem = t.view();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  Southwell southwell;
  southwell.bind(delassus);
  std::vector<double> gamma = solution();
  std::vector<Twist> w(problem.bodies());
  delassus.body_velocities(gamma, w);
  // The plate gives way a little. The impulses over a plate that does not are right when r says so.
  for (std::size_t i = 0; i < t.r.size(); i += 3 * kHeight) t.r[i] += w[0].linear.z;
  gamma[3 * 77 * kHeight] = 0.0;
  delassus.body_velocities(gamma, w);
  constexpr double kTarget = 1e-6;
  const Southwell::Outcome outcome = southwell.relax(gamma, w, kTarget, 1000000);
  EXPECT_TRUE(outcome.reached);
  EXPECT_LE(ccp_residual(problem, gamma), kTarget * (1.0 + 1e-6));
}

}  // namespace scree::test
