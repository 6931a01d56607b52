// siconos_solve PROBLEM --method NAME [--tolerance X] [--max-iterations N] [--threads 1] [--json]
//
// A recorded contact problem by a solver of Siconos, judged by scree: a peer for bench/ccp/profiles.py. --methods prints the
// names. A method that solves the associated (convex) problem is judged for that, one for Coulomb friction for Coulomb friction; both
// residuals are printed. Siconos stops at an error of its own, which is made smaller until scree's residual is within the
// tolerance; the time is that of the last solve alone. Matrices are given to it, their assembly is not timed.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "scree/base/error.hpp"
#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/judge.hpp"
#include "siconos_methods.hpp"

namespace scree {
namespace {

struct Wanted {
  std::string file, method = "admm";
  double tolerance = 1e-4;  // [m/s]
  int max_iterations = 10000;
  bool list = false;
};

void list_methods() {
  for (const SiconosMethod& method : siconos_methods()) {
    std::printf("%-14s %s: %s\n", std::string{method.name}.c_str(), method.exact ? "Coulomb   " : "associated",
                std::string{method.about}.c_str());
  }
}

void run(const Wanted& wanted) {
  const SiconosMethod& method = siconos_method(wanted.method);
  const CcpRecord record = read_ccp_file(wanted.file);
  const CcpProblem problem = record.problem();
  SiconosSolver solver{method, problem};
  SiconosAnswer answer;
  CcpFigures figures;
  double own = wanted.tolerance, residual = 0.0;
  do {
    answer = solver.solve(own, wanted.max_iterations);
    figures = CcpJudge{}.figures(problem, answer.gamma, nullptr);
    residual = method.exact ? figures.coulomb_residual : figures.residual;
    own *= 0.1;
  } while (residual > wanted.tolerance && own > 1e-14 && answer.iterations < wanted.max_iterations);
  std::printf(
      "{\"solver\": \"siconos_%s\", \"status\": \"%s\", \"iterations\": %d, \"residual\": %.9g, \"wall_time\": %.9g, "
      "\"friction\": \"%s\", \"associated_residual\": %.9g, \"coulomb_residual\": %.9g}\n",
      wanted.method.c_str(), residual <= wanted.tolerance ? "converged" : "iteration_limit", answer.iterations,
      residual, answer.seconds, method.exact ? "coulomb" : "associated", figures.residual, figures.coulomb_residual);
}

Wanted read_arguments(int count, char** arguments) {
  Wanted wanted;
  for (int k = 1; k < count; ++k) {
    const std::string key = arguments[k];
    const auto value = [&] { return k + 1 < count ? std::string{arguments[++k]} : std::string{}; };
    if (key == "--method") {
      wanted.method = value();
    } else if (key == "--methods") {
      wanted.list = true;
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
    const scree::Wanted wanted = scree::read_arguments(count, arguments);
    if (wanted.list) {
      scree::list_methods();
    } else {
      scree::run(wanted);
    }
  } catch (const scree::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
