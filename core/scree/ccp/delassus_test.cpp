// The matrix-free Delassus operator against a dense assembly from the definition of the Jacobian, and the judge against
// closed forms.
#include "scree/ccp/delassus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "scree/ccp/judge.hpp"
#include "scree/math/contact_frame.hpp"
#include "support/allocation_count.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using test::planted_problem;
using test::random_problem;
using test::sphere_on_floor;
using test::TestingProblem;
using test::with_matrix;

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

Eigen::Matrix<double, 1, 6> eigen(const Twist& t) {
  Eigen::Matrix<double, 1, 6> row;
  row << eigen(t.linear).transpose(), eigen(t.angular).transpose();
  return row;
}

// Rows of D^T as they are defined: the velocity of b's point minus that of a's, along each axis of the contact; those of
// blocks as they stand.
Matrix dense_delassus(const CcpProblem& p) {
  Matrix jacobian = Matrix::Zero(static_cast<Eigen::Index>(p.rows()), static_cast<Eigen::Index>(6 * p.bodies()));
  Matrix inverse_mass = Matrix::Zero(jacobian.cols(), jacobian.cols());
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(p.bodies()); ++k) {
    const Mat3& j = p.inverse_inertia[static_cast<std::size_t>(k)];
    inverse_mass.block<3, 3>(6 * k, 6 * k).diagonal().setConstant(p.inverse_mass[static_cast<std::size_t>(k)]);
    inverse_mass.block<3, 3>(6 * k + 3, 6 * k + 3) << j.row0.x, j.row0.y, j.row0.z, j.row1.x, j.row1.y, j.row1.z,
        j.row2.x, j.row2.y, j.row2.z;
  }
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(p.contacts.size()); ++i) {
    const CcpContact& c = p.contacts[static_cast<std::size_t>(i)];
    const Eigen::Vector3d n = eigen(c.normal), t = eigen(contact_frame(c.normal).tangent1);
    Eigen::Matrix3d axes;
    axes << n.transpose(), t.transpose(), n.cross(t).transpose();
    for (int row = 0; row < 3; ++row) {
      const Eigen::Vector3d axis = axes.row(row).transpose();
      jacobian.block<1, 3>(3 * i + row, 6 * c.a) -= axis.transpose();
      jacobian.block<1, 3>(3 * i + row, 6 * c.a + 3) -= eigen(c.arm_a).cross(axis).transpose();
      jacobian.block<1, 3>(3 * i + row, 6 * c.b) += axis.transpose();
      jacobian.block<1, 3>(3 * i + row, 6 * c.b + 3) += eigen(c.arm_b).cross(axis).transpose();
    }
  }
  for (const CcpBlock& block : p.blocks) {
    for (std::size_t k = 0; k < block.rows; ++k) {
      const auto row = static_cast<Eigen::Index>(p.contact_rows() + block.first_row + k);
      jacobian.block<1, 6>(row, 6 * block.a) += eigen(p.block_rows[block.first_row + k].a);
      jacobian.block<1, 6>(row, 6 * block.b) += eigen(p.block_rows[block.first_row + k].b);
    }
  }
  Matrix n = jacobian * inverse_mass * jacobian.transpose();
  for (Eigen::Index i = 0; i < n.rows() && !p.compliance.empty(); ++i) {
    n(i, i) += p.compliance[static_cast<std::size_t>(i)];
  }
  return n;
}

Vector as_vector(std::span<const double> v) {
  return Eigen::Map<const Vector>(v.data(), static_cast<Eigen::Index>(v.size()));
}

std::vector<double> random_rows(const CcpProblem& p, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  std::vector<double> values(p.rows());
  for (double& value : values) value = normal(random);
  return values;
}

/// The diagonal block of unit i, contacts first.
Matrix diagonal_of(const CcpProblem& p, std::size_t i) {
  if (i < p.contacts.size()) {
    const Mat3 block = diagonal_block(p, i);
    Matrix out(3, 3);
    out << eigen(block.row0).transpose(), eigen(block.row1).transpose(), eigen(block.row2).transpose();
    return out;
  }
  const auto rows = static_cast<Eigen::Index>(p.blocks[i - p.contacts.size()].rows);
  Matrix out(rows, rows);
  diagonal_block_of_block(p, i - p.contacts.size(), {out.data(), static_cast<std::size_t>(out.size())});
  return out;  // by columns, and symmetric
}

void expect_dense(const CcpProblem& p, const Matrix& n) {
  DelassusOperator delassus;
  delassus.bind(p, nullptr);
  const std::vector<double> gamma = random_rows(p, 5);
  std::vector<double> product(p.rows());
  delassus.apply(gamma, product);
  const Vector expected = n * as_vector(gamma);
  // About a hundred terms a row, each rounded once: 100 ulp of the largest.
  const double tolerance = 2e-14 * n.cwiseAbs().rowwise().sum().maxCoeff() * 3.0;
  EXPECT_LT((as_vector(product) - expected).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_NEAR(delassus.objective(gamma), 0.5 * as_vector(gamma).dot(expected) + as_vector(p.r).dot(as_vector(gamma)),
              tolerance * static_cast<double>(p.rows()));
  for (std::size_t i = 0; i < p.units(); ++i) {
    const Matrix block = diagonal_of(p, i);
    const std::size_t row = i < p.contacts.size() ? 3 * i : first_row(p, p.blocks[i - p.contacts.size()]);
    const auto at = static_cast<Eigen::Index>(row);
    EXPECT_LT((block - n.block(at, at, block.rows(), block.rows())).cwiseAbs().maxCoeff(), tolerance) << "unit " << i;
    EXPECT_NEAR(delassus.traces()[i], block.trace(), tolerance);
  }
}

TEST(delassus, products_and_blocks_of_contacts_equal_those_of_the_dense_matrix) {
  for (const bool compliant : {false, true}) {
    const TestingProblem t =
        random_problem({.bodies = 12, .immovable = 2, .contacts = 40, .compliant = compliant, .seed = 3});
    expect_dense(t.view(), dense_delassus(t.view()));
  }
}

// The same with rows of every kind, some of them on one body only, and with N written out in their place.
TEST(delassus, products_and_blocks_of_every_kind_equal_those_of_the_dense_matrix) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TestingProblem t = planted_problem({.bodies = 8,
                                              .immovable = 2,
                                              .contacts = seed % 3 * 7,
                                              .blocks = 30,
                                              .compliant = seed % 2 == 0,
                                              .seed = seed})
                                 .problem;
    const Matrix n = dense_delassus(t.view());
    expect_dense(t.view(), n);
    const TestingProblem explicit_n = with_matrix(t);
    expect_dense(explicit_n.view(), n);
  }
}

TEST(delassus, refuses_blocks_that_do_not_fit) {
  const auto refused = [](const CcpProblem& p) {
    DelassusOperator delassus;
    EXPECT_THROW(delassus.bind(p, nullptr), std::logic_error);
  };
  const TestingProblem good = planted_problem({.contacts = 0, .blocks = 5}).problem;
  TestingProblem t = good;
  t.blocks[3].first_row += 1;
  refused(t.view());
  t = good;
  t.block_rows.pop_back();
  refused(t.view());
  t = good;
  t.r.pop_back();
  refused(t.view());
  t = good;
  t.blocks.back().rows = 7;
  refused(t.view());
  t = with_matrix(good);
  t.matrix_first.pop_back();
  refused(t.view());
  t = with_matrix(good);
  t.inverse_mass = good.inverse_mass;
  t.inverse_inertia = good.inverse_inertia;
  refused(t.view());
}

TEST(delassus, two_threads_give_the_bits_of_one_for_blocks_and_matrices) {
  // Contacts and blocks share a run, and there are several.
  const TestingProblem bodies = planted_problem({.bodies = 3000, .contacts = 3000, .blocks = 6000}).problem;
  // A chain of 9000 scalar blocks.
  TestingProblem chain;
  chain.matrix_first.push_back(0);
  constexpr std::uint32_t kBlocks = 9000;
  for (std::uint32_t i = 0; i < kBlocks; ++i) {
    chain.blocks.push_back({.kind = CcpKind::nonnegative, .rows = 1, .first_row = i});
    chain.r.push_back(std::sin(i));
    for (std::uint32_t j = i == 0 ? 0 : i - 1; j < std::min(i + 2, kBlocks); ++j) {
      chain.matrix_column.push_back(j);
      chain.matrix_value.push_back(chain.matrix_values.size());
      chain.matrix_values.push_back(i == j ? 2.0 : -1.0);
    }
    chain.matrix_first.push_back(static_cast<std::uint32_t>(chain.matrix_column.size()));
  }
  const Executor two{2};
  for (const TestingProblem& t : {bodies, chain}) {
    const CcpProblem p = t.view();
    const std::vector<double> gamma = random_rows(p, 6);
    std::vector<double> serial(p.rows()), parallel(p.rows());
    DelassusOperator delassus;
    delassus.bind(p, nullptr);
    delassus.apply(gamma, serial);
    const double objective = delassus.objective(gamma);
    delassus.bind(p, &two);
    delassus.apply(gamma, parallel);
    EXPECT_EQ(serial, parallel);
    EXPECT_EQ(objective, delassus.objective(gamma));
  }
}

TEST(delassus, two_threads_give_the_bits_of_one) {
  // Several runs of contacts, so that bodies are shared between runs.
  const TestingProblem t =
      random_problem({.bodies = 3000, .immovable = 5, .contacts = 20000, .compliant = true, .seed = 11});
  const CcpProblem p = t.view();
  std::vector<double> gamma(p.rows()), serial(p.rows()), parallel(p.rows());
  std::mt19937_64 random{6};
  std::normal_distribution<double> normal;
  for (double& g : gamma) g = normal(random);
  const Executor two{2};
  DelassusOperator delassus;
  delassus.bind(p, nullptr);
  delassus.apply(gamma, serial);
  const double objective = delassus.objective(gamma);
  const double residual = ccp_residual(p, gamma);
  delassus.bind(p, &two);
  delassus.apply(gamma, parallel);
  EXPECT_EQ(serial, parallel);
  EXPECT_EQ(objective, delassus.objective(gamma));
  EXPECT_EQ(residual, ccp_residual(p, gamma, &two));
}

TEST(delassus, products_ask_for_no_memory_after_bind) {
  const TestingProblem bodies = planted_problem({.bodies = 300, .contacts = 5000, .blocks = 500}).problem;
  const TestingProblem explicit_n = with_matrix(planted_problem({.contacts = 5, .blocks = 5}).problem);
  for (const TestingProblem& t : {bodies, explicit_n}) {
    const CcpProblem p = t.view();
    DelassusOperator delassus;
    delassus.bind(p, nullptr);
    const std::vector<double> gamma = random_rows(p, 7);
    std::vector<double> product(p.rows()), partial(2);
    std::vector<Twist> w(p.bodies());
    const std::uint64_t before = test::allocation_count();
    delassus.apply(gamma, product);
    delassus.body_velocities(gamma, w);
    delassus.row_velocities(w, gamma, product);
    EXPECT_NE(delassus.objective(gamma), 0.0);
    EXPECT_GT(ccp_residual(delassus, gamma, w, partial), 0.0);
    delassus.bind(p, nullptr);
    EXPECT_EQ(test::allocation_count(), before);
  }
}

// A sphere of mass m on the floor, approaching with speed v: the impulse m v stops it, and residual is then zero.
TEST(ccp_residual, vanishes_at_the_closed_form_and_measures_a_velocity) {
  const double m = 0.3, v = 2.0;
  const TestingProblem t = sphere_on_floor(m, 0.1, 0.5, {-v, 0.0, 0.0});
  EXPECT_NEAR(ccp_residual(t.view(), std::vector<double>{m * v, 0.0, 0.0}), 0.0, 1e-15);
  // Without impulse the error is the approach speed itself, whatever the mass.
  EXPECT_NEAR(ccp_residual(t.view(), std::vector<double>{0.0, 0.0, 0.0}), v, 1e-15);
}

TEST(ccp_residual, is_infinite_for_numbers_that_are_not_finite) {
  const TestingProblem t = sphere_on_floor(1.0, 0.1, 0.5, {-1.0, 0.0, 0.0});
  EXPECT_TRUE(std::isinf(ccp_residual(t.view(), std::vector<double>{std::nan(""), 0.0, 0.0})));
}

}  // namespace
}  // namespace scree
