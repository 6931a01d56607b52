// siconos_solve PROBLEM --method admm|nsgs [--tolerance X] [--max-iterations N] [--threads 1] [--json]
//
// A recorded contact problem by a solver of Siconos, judged by scree: a peer for bench/ccp/profiles.py. `admm` without the
// update of s solves the associated (convex) problem; `nsgs` solves exact Coulomb friction, and is judged for that. Siconos
// stops at an error of its own, which is made smaller until scree's residual is within the tolerance; the time is that of the
// last solve alone. The matrix W is given to it, its assembly is not timed.
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {
namespace {

struct Wanted {
  std::string file;
  bool exact = false;
  double tolerance = 1e-4;  // [m/s]
  int max_iterations = 10000;
};

struct Outcome {
  std::vector<double> gamma;
  int iterations = 0;
  double seconds = 0.0, residual = 0.0;
};

/// Three rows of a contact at one of its bodies: impulse directions and their moments.
struct Side {
  std::size_t contact = 0;
  std::array<Vec3, 3> linear, angular;
};

Side side_of(const CcpProblem& p, std::size_t i, bool second) {
  const CcpContact& c = p.contacts[i];
  const double sign = second ? 1.0 : -1.0;
  const ContactFrame frame = contact_frame(c.normal);
  Side side{i, {sign * frame.normal, sign * frame.tangent1, sign * frame.tangent2}, {}};
  for (std::size_t k = 0; k < 3; ++k) side.angular[k] = cross(second ? c.arm_b : c.arm_a, side.linear[k]);
  return side;
}

/// W = D^T M^-1 D + E as a sparse matrix of Siconos.
NumericsMatrix* delassus_matrix(const CcpProblem& p) {
  std::vector<std::vector<Side>> of_body(p.bodies());
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    for (const bool second : {false, true}) {
      const std::uint32_t body = second ? p.contacts[i].b : p.contacts[i].a;
      if (p.inverse_mass[body] > 0.0) of_body[body].push_back(side_of(p, i, second));
    }
  }
  std::size_t blocks = 0;
  for (const auto& sides : of_body) blocks += sides.size() * sides.size();
  const int rows = static_cast<int>(p.rows());
  NumericsMatrix* w = NM_create(NM_SPARSE, rows, rows);
  NM_triplet_alloc(w, static_cast<CS_INT>(9 * blocks + p.rows()));
  const auto add = [&](std::size_t row, std::size_t column, double value) {
    NM_entry(w, static_cast<int>(row), static_cast<int>(column), value);
  };
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    for (const Side& i : of_body[body]) {
      for (const Side& j : of_body[body]) {
        for (std::size_t k = 0; k < 9; ++k) {
          const std::size_t r = k / 3, c = k % 3;
          add(3 * i.contact + r, 3 * j.contact + c,
              p.inverse_mass[body] * dot(i.linear[r], j.linear[c]) +
                  dot(i.angular[r], p.inverse_inertia[body] * j.angular[c]));
        }
      }
    }
  }
  for (std::size_t row = 0; row < p.compliance.size(); ++row) add(row, row, p.compliance[row]);
  return w;
}

Outcome solve(const CcpProblem& p, NumericsMatrix* w, const Wanted& wanted, double own_tolerance) {
  std::vector<double> q(p.r.begin(), p.r.end()), mu, u(p.rows(), 0.0);
  for (const CcpContact& c : p.contacts) mu.push_back(c.friction);
  FrictionContactProblem problem{3, static_cast<int>(p.contacts.size()), w, q.data(), mu.data()};
  const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options{
      solver_options_create(wanted.exact ? SICONOS_FRICTION_3D_NSGS : SICONOS_FRICTION_3D_ADMM), solver_options_delete};
  options->iparam[SICONOS_IPARAM_MAX_ITER] = wanted.max_iterations;
  options->dparam[SICONOS_DPARAM_TOL] = own_tolerance;
  if (!wanted.exact) {
    options->iparam[SICONOS_FRICTION_3D_ADMM_IPARAM_UPDATE_S] = SICONOS_FRICTION_3D_ADMM_UPDATE_S_NO;
  }
  Outcome outcome{std::vector<double>(p.rows(), 0.0)};
  const auto start = std::chrono::steady_clock::now();
  fc3d_driver(&problem, outcome.gamma.data(), u.data(), options.get());
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  project_guess(p, outcome.gamma);
  const CcpFigures figures = CcpJudge{}.figures(p, outcome.gamma, nullptr);
  outcome.residual = wanted.exact ? figures.coulomb_residual : figures.residual;
  return outcome;
}

void run(const Wanted& wanted) {
  const CcpRecord record = read_ccp_file(wanted.file);
  const CcpProblem problem = record.problem();
  if (!problem.blocks.empty()) throw Error{ErrorKind::usage, "only problems of contacts alone can be given to Siconos"};
  NumericsMatrix* w = delassus_matrix(problem);
  Outcome outcome;
  double own = wanted.tolerance;
  do {
    outcome = solve(problem, w, wanted, own);
    own *= 0.1;
  } while (outcome.residual > wanted.tolerance && own > 1e-14 && outcome.iterations < wanted.max_iterations);
  NM_clear(w);
  std::free(w);
  const bool good = outcome.residual <= wanted.tolerance;
  std::printf(
      "{\"solver\": \"siconos_%s\", \"status\": \"%s\", \"iterations\": %d, \"residual\": %.9g, \"wall_time\": %.9g}\n",
      wanted.exact ? "nsgs" : "admm", good ? "converged" : "iteration_limit", outcome.iterations, outcome.residual,
      outcome.seconds);
}

Wanted read_arguments(int count, char** arguments) {
  Wanted wanted;
  for (int k = 1; k < count; ++k) {
    const std::string key = arguments[k];
    const auto value = [&] { return k + 1 < count ? std::string{arguments[++k]} : std::string{}; };
    if (key == "--method") {
      wanted.exact = value() == "nsgs";
    } else if (key == "--tolerance") {
      wanted.tolerance = std::strtod(value().c_str(), nullptr);
    } else if (key == "--max-iterations") {
      wanted.max_iterations = static_cast<int>(std::strtol(value().c_str(), nullptr, 10));
    } else if (key == "--threads") {
      value();  // Siconos works with one
    } else if (key != "--json") {
      wanted.file = key;
    }
  }
  return wanted;
}

}  // namespace
}  // namespace scree

int main(int count, char** arguments) {
  try {
    scree::run(scree::read_arguments(count, arguments));
  } catch (const scree::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
