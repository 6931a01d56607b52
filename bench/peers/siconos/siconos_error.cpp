#include "siconos_error.hpp"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NumericsMatrix.h>
#include <RollingFrictionContactProblem.h>
#include <SolverOptions.h>
#include <fc3d_compute_error.h>
#include <rolling_fc3d_compute_error.h>

#include <cmath>
#include <memory>

#include "scree/base/require.hpp"

namespace scree {

namespace {
constexpr double kTolerance = 1e-16;  // decides the return value only
}  // namespace

SiconosError siconos_error(const FclibProblem& problem, std::vector<double> r) {
  const FclibLocal* local = std::get_if<FclibLocal>(&problem.form);
  SCREE_REQUIRE(local != nullptr && local->V.columns == 0,
                "siconos_error: a local problem without constraints is needed");
  const int rows = static_cast<int>(local->W.rows), contacts = static_cast<int>(problem.contacts());
  std::vector<double> w(local->W.rows * local->W.columns, 0.0);  // dense, by columns
  for (const MatrixEntry& e : local->W.entries) w[e.column * local->W.rows + e.row] += e.value;
  std::vector<double> q = local->q, mu = problem.mu, rolling = problem.rolling, u(q.size());
  double norm = 0.0;
  for (const double value : q) norm += value * value;
  norm = std::sqrt(norm);
  NumericsMatrix* matrix = NM_new();
  NM_fill(matrix, NM_DENSE, rows, rows, w.data());
  // Over a scale that is larger than any of its own.
  constexpr double kLarge = 1e12;
  SiconosError error;
  const auto measure = [&](auto&& posed, int solver, const auto& compute) {
    const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options{solver_options_create(solver),
                                                                           solver_options_delete};
    compute(&posed, r.data(), u.data(), kTolerance, options.get(), norm, &error.own);
    compute(&posed, r.data(), u.data(), kTolerance, options.get(), kLarge, &error.over_q);
    error.over_q *= kLarge / norm;
  };
  if (rolling.empty()) {
    measure(FrictionContactProblem{3, contacts, matrix, q.data(), mu.data()}, SICONOS_FRICTION_3D_NSGS,
            fc3d_compute_error);
  } else {
    measure(RollingFrictionContactProblem{5, contacts, matrix, q.data(), mu.data(), rolling.data()},
            SICONOS_ROLLING_FRICTION_3D_NSGS, rolling_fc3d_compute_error);
  }
  matrix->matrix0 = nullptr;  // it is ours
  NM_clear(matrix);
  return error;
}

}  // namespace scree
