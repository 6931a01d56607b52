// The reduction of FCLIB's problems to scree's, against dense algebra and problems with answers in closed form.
#include "scree/ccp/fclib/fclib_ccp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/fclib/fclib_export.hpp"
#include "scree/ccp/fclib/testing_fclib.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using test::small_global;
using test::small_local;

Matrix dense(const FclibMatrix& matrix) {
  Matrix out = Matrix::Zero(static_cast<Eigen::Index>(matrix.rows), static_cast<Eigen::Index>(matrix.columns));
  for (const MatrixEntry& e : matrix.entries) out(e.row, e.column) += e.value;
  return out;
}

Vector dense(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// N of a record, in full.
Matrix dense(const CcpRecord& record) {
  const auto rows = static_cast<Eigen::Index>(record.r.size());
  Matrix out = Matrix::Zero(rows, rows);
  const CcpMatrix matrix = record.matrix.view();
  for (std::size_t i = 0; i < record.blocks.size(); ++i) {
    for (std::size_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) {
      const CcpBlock &row = record.blocks[i], &column = record.blocks[matrix.column[k]];
      for (Eigen::Index a = 0; a < row.rows; ++a) {
        for (Eigen::Index b = 0; b < column.rows; ++b) {
          out(row.first_row + a, column.first_row + b) =
              matrix.values[matrix.value[k] + static_cast<std::size_t>(a * column.rows + b)];
        }
      }
    }
  }
  return out;
}

FclibMatrix sparse(const Matrix& matrix) {
  FclibMatrix out{static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
  for (std::uint32_t i = 0; i < out.rows; ++i) {
    for (std::uint32_t j = 0; j < out.columns; ++j) {
      if (matrix(i, j) != 0.0) out.entries.push_back({i, j, matrix(i, j)});
    }
  }
  return out;
}

TEST(fclib_ccp, local_problem_is_the_saddle_of_its_matrices) {
  const FclibProblem problem = small_local();
  const auto& local = std::get<FclibLocal>(problem.form);
  const FclibCcp reduced{problem, "file"};
  Matrix wanted = Matrix::Zero(7, 7);
  wanted.topLeftCorner(6, 6) = dense(local.W);
  wanted.topRightCorner(6, 1) = dense(local.V);
  wanted.bottomLeftCorner(1, 6) = dense(local.V).transpose();
  wanted.bottomRightCorner(1, 1) = dense(local.R);
  EXPECT_EQ(dense(reduced.record()), wanted);
  EXPECT_EQ(reduced.record().r, (std::vector<double>{-1.0, 0.25, 0.0, -0.5, 0.0, 0.125, 0.0625}));
  ASSERT_EQ(reduced.record().blocks.size(), 3u);
  EXPECT_EQ(reduced.record().blocks[1].kind, CcpKind::cone);
  EXPECT_EQ(reduced.record().blocks[1].friction, 0.25);
  EXPECT_EQ(reduced.record().blocks[2].kind, CcpKind::free);
}

// M v = H r + G lambda + f, u = H^T v + w and G^T v + b from any impulses, with M symmetric and not.
TEST(fclib_ccp, global_problem_is_reduced_by_its_own_equations) {
  std::mt19937 random{5};
  std::normal_distribution<double> normal;
  const auto draw = [&](Eigen::Index rows, Eigen::Index columns) {
    Matrix out(rows, columns);
    for (double& value : out.reshaped()) value = normal(random);
    return out;
  };
  for (const double gyroscopic : {0.0, 0.01}) {
    const Matrix root = draw(9, 9), skew = draw(9, 9);
    const Matrix mass = root * root.transpose() + Matrix::Identity(9, 9) + gyroscopic * (skew - skew.transpose());
    const Matrix h = draw(9, 6), g = draw(9, 2);
    const Vector f = draw(9, 1), w = draw(6, 1), b = draw(2, 1);
    const auto list = [](const Vector& v) { return std::vector<double>{v.begin(), v.end()}; };
    const FclibProblem problem{.form = FclibGlobal{sparse(mass), sparse(h), list(f), list(w), sparse(g), list(b)},
                               .mu = {0.5, 0.5}};
    const FclibCcp reduced{problem, "file"};
    const FclibSolution answer = [&] {
      const Vector gamma = draw(8, 1);
      FclibSolution found = reduced.solution(list(gamma));
      EXPECT_EQ(reduced.impulses(found), list(gamma));
      return found;
    }();
    const Vector v = dense(answer.v), r = dense(answer.r), lambda = dense(answer.lambda);
    // Rounding: condition of M, below 1e3, times 1e-16 times numbers of order 10.
    EXPECT_LT((mass * v - h * r - g * lambda - f).norm(), 1e-11);
    EXPECT_LT((dense(answer.u) - h.transpose() * v - w).norm(), 1e-11);
    Vector gamma(8);
    gamma << r, lambda;
    const Vector rows = dense(reduced.record()) * gamma + dense(reduced.record().r);
    EXPECT_LT((rows.head(6) - dense(answer.u)).norm(), 1e-11);
    EXPECT_LT((rows.tail(2) - g.transpose() * v - b).norm(), 1e-11);
  }
}

TEST(fclib_ccp, plane_rolling_contact_stands_in_five_rows_of_which_two_are_zero) {
  FclibProblem problem = small_local();
  problem.rolling = {0.01, 0.02};
  const FclibCcp reduced{problem, "file"};
  ASSERT_EQ(reduced.record().r.size(), 11u);
  EXPECT_EQ(reduced.record().blocks[1].rows, 5);
  EXPECT_EQ(reduced.record().blocks[1].rolling, 0.02);
  const Matrix n = dense(reduced.record());
  for (const Eigen::Index zero : {2, 4, 7, 9}) {
    EXPECT_EQ(n.row(zero).norm(), 0.0);
    EXPECT_EQ(n.col(zero).norm(), 0.0);
  }
  EXPECT_EQ(n(0, 5), 0.5);                  // normal rows of the two contacts
  EXPECT_EQ(n(6, 10), -0.25);               // tangent of the second with the bilateral constraint
  EXPECT_EQ(reduced.record().r[8], 0.125);  // its rolling row
}

TEST(fclib_ccp, first_guess_of_the_file_is_the_guess) {
  FclibProblem problem = small_local();
  EXPECT_EQ(FclibCcp(problem, "file").record().guess, std::vector<double>(7, 0.0));
  problem.guesses = {{{}, {}, {1, 2, 3, 4, 5, 6}, {7}}, {{}, {}, {0, 0, 0, 0, 0, 0}, {0}}};
  EXPECT_EQ(FclibCcp(problem, "file").record().guess, (std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
}

// Two stacked masses at rest on the floor, the upper one held sideways by nothing that acts: each contact carries what lies
// above it, and friction 0.5 holds what pushes sideways, 0.5 N s against 0.5 times 6 N s.
TEST(fclib_ccp, stack_at_rest_has_no_velocity_under_its_own_weight) {
  const FclibCcp reduced{small_global(), "file"};
  const FclibSolution answer = reduced.solution(std::vector<double>{6, -0.5, 0, 4, 0, 0, 0});
  for (const double v : answer.v) EXPECT_NEAR(v, 0.0, 1e-15);
  for (const double u : answer.u) EXPECT_NEAR(u, 0.0, 1e-15);
}

// Written and read as a file of FCLIB, a problem with bodies is the same: the same velocities for the same impulses.
TEST(fclib_export, keeps_what_impulses_do) {
  test::TestingProblem t = test::random_problem({.bodies = 5, .contacts = 8, .compliant = true, .seed = 9});
  t.blocks = {{.kind = CcpKind::free, .rows = 2, .first_row = 0, .a = 1, .b = 3},
              {.kind = CcpKind::cone, .rows = 3, .first_row = 2, .a = 2, .b = 4, .friction = 0.75}};
  for (int k = 0; k < 5; ++k) {
    const double x = 0.1 * k;
    t.block_rows.push_back({{{1, x, 0}, {x, -1, 2}}, {{-1, -x, 0}, {0.5, x, x}}});
    t.r.push_back(x);
    t.compliance.push_back(0.5 * x);
  }
  const CcpProblem problem = t.view();
  std::mt19937 random{3};
  std::normal_distribution<double> normal;
  std::vector<double> gamma(problem.rows()), u(problem.rows());
  for (double& g : gamma) g = normal(random);
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  delassus.apply(gamma, u);
  const FclibProblem out = export_to_fclib(problem, gamma);
  EXPECT_EQ(out.contacts(), 9u);
  EXPECT_EQ(out.mu.back(), 0.75);
  EXPECT_EQ(out.bilateral_rows(), 2u);
  // Its own reduction, from matrices alone, and the solution that it carries.
  const FclibCcp back{out, "file"};
  const FclibSolution again = back.solution(back.impulses(*out.solution));
  const std::size_t contacts = problem.contact_rows();
  for (std::size_t k = 0; k < 27; ++k) {
    const std::size_t row = k < contacts ? k : k + 2;  // the free block stands between
    EXPECT_EQ(out.solution->r[k], gamma[row]);
    EXPECT_NEAR(out.solution->u[k], u[row] + problem.r[row], 1e-12);  // rounding of numbers of order 10
    EXPECT_NEAR(again.u[k], out.solution->u[k], 1e-12);
  }
  EXPECT_EQ(out.solution->lambda, (std::vector<double>{gamma[contacts], gamma[contacts + 1]}));
}

TEST(fclib_export, refuses_what_fclib_does_not_know) {
  const auto exporting = [](const CcpBlock& block) -> std::string {
    const test::TestingProblem t = test::one_block(1.0, block, std::vector<double>(block.rows, 0.0));
    try {
      (void)export_to_fclib(t.view(), std::vector<double>(block.rows, 0.0));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    return {};
  };
  const std::string head = "this problem cannot be kept as an FCLIB file: it has ",
                    tail = ", and FCLIB knows contacts of one sort and bilateral constraints only";
  EXPECT_EQ(exporting({.kind = CcpKind::box, .rows = 1}), head + "limits or motors" + tail);
  EXPECT_EQ(exporting({.kind = CcpKind::cone, .rows = 6}), head + "contacts of 1 or 6 rows" + tail);
  EXPECT_EQ(exporting({.kind = CcpKind::cone, .rows = 5}), "");
}

TEST(ccp_matrix, sums_entries_and_mirrors_its_blocks) {
  const std::vector<CcpBlock> blocks{{.kind = CcpKind::free, .rows = 2, .first_row = 0},
                                     {.kind = CcpKind::free, .rows = 1, .first_row = 2}};
  const CcpMatrixStore store =
      make_matrix(blocks, std::vector<MatrixEntry>{{0, 0, 1}, {0, 0, 2}, {1, 2, 4}, {2, 2, 8}, {2, 1, 6}});
  EXPECT_EQ(store.first, (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(store.column, (std::vector<std::uint32_t>{0, 1, 0, 1}));
  EXPECT_EQ(store.values, (std::vector<double>{3, 0, 0, 0, 0, 4, 0, 6, 8}));
  EXPECT_EQ(asymmetry(store.view(), blocks), 0.25);
  EXPECT_EQ(symmetric_values(store.view(), blocks), (std::vector<double>{3, 0, 0, 0, 0, 5, 0, 5, 8}));
}

}  // namespace
}  // namespace scree
