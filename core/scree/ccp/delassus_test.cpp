// The matrix-free Delassus operator against a dense assembly from the definition of the Jacobian, and the judge against
// closed forms.
#include "scree/ccp/delassus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "scree/ccp/judge.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using test::random_problem;
using test::sphere_on_floor;
using test::TestingProblem;

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

// Rows of D^T as they are defined: the velocity of b's point minus that of a's, along each axis of the contact.
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
    const Eigen::Vector3d n = eigen(c.normal), t = eigen(c.tangent1);
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
  Matrix n = jacobian * inverse_mass * jacobian.transpose();
  for (Eigen::Index i = 0; i < n.rows() && !p.compliance.empty(); ++i) {
    n(i, i) += p.compliance[static_cast<std::size_t>(i)];
  }
  return n;
}

Vector as_vector(std::span<const double> v) {
  return Eigen::Map<const Vector>(v.data(), static_cast<Eigen::Index>(v.size()));
}

TEST(delassus, products_and_blocks_equal_those_of_the_dense_matrix) {
  for (const bool compliant : {false, true}) {
    const TestingProblem t =
        random_problem({.bodies = 12, .immovable = 2, .contacts = 40, .compliant = compliant, .seed = 3});
    const CcpProblem p = t.view();
    const Matrix n = dense_delassus(p);
    DelassusOperator delassus;
    delassus.bind(p, nullptr);

    std::vector<double> gamma(p.rows()), product(p.rows());
    std::mt19937_64 random{5};
    std::normal_distribution<double> normal;
    for (double& g : gamma) g = normal(random);
    delassus.apply(gamma, product);
    const Vector expected = n * as_vector(gamma);
    // About a hundred terms a row, each rounded once: 100 ulp of the largest.
    const double tolerance = 2e-14 * n.cwiseAbs().rowwise().sum().maxCoeff() * 3.0;
    EXPECT_LT((as_vector(product) - expected).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_NEAR(delassus.objective(gamma), 0.5 * as_vector(gamma).dot(expected) + as_vector(p.r).dot(as_vector(gamma)),
                tolerance * static_cast<double>(p.rows()));

    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      const Mat3 block = diagonal_block(p, i);
      const auto at = static_cast<Eigen::Index>(3 * i);
      EXPECT_LT((eigen(block.row0) - n.block<1, 3>(at, at).transpose()).cwiseAbs().maxCoeff(), tolerance);
      EXPECT_LT((eigen(block.row1) - n.block<1, 3>(at + 1, at).transpose()).cwiseAbs().maxCoeff(), tolerance);
      EXPECT_LT((eigen(block.row2) - n.block<1, 3>(at + 2, at).transpose()).cwiseAbs().maxCoeff(), tolerance);
      EXPECT_NEAR(diagonal_trace(p, i), (n.block<3, 3>(at, at).trace()), tolerance);
    }
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
