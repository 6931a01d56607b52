// bullet_solve PROBLEM [--tolerance X] [--max-iterations N] [--threads 1] [--json]
//
// A recorded contact problem by Bullet's sequential impulse solver (float64), judged by scree: a peer for
// bench/ccp/profiles.py. Bullet knows no residual: it is asked for more and more iterations, a quarter more each time, and the
// time is that of the first solve that is good enough, alone. Its friction acts along two tangents, each for itself, on normal
// impulses as they are: something between scree's two models. The smaller of their residuals counts.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bullet_group.hpp"
#include "scree/base/error.hpp"
#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"

namespace scree::bench {
namespace {

struct Wanted {
  std::string file;
  double tolerance = 1e-4;  // [m/s]
  int max_iterations = 10000;
};

Wanted read_arguments(int count, char** arguments) {
  Wanted wanted;
  for (int k = 1; k < count; ++k) {
    const std::string key = arguments[k];
    const auto value = [&] { return k + 1 < count ? std::string{arguments[++k]} : std::string{}; };
    if (key == "--tolerance") {
      wanted.tolerance = std::strtod(value().c_str(), nullptr);
    } else if (key == "--max-iterations") {
      wanted.max_iterations = static_cast<int>(std::strtol(value().c_str(), nullptr, 10));
    } else if (key == "--threads") {
      value();  // Bullet works with one
    } else if (key != "--json") {
      wanted.file = key;
    }
  }
  return wanted;
}

double residual_of(const CcpProblem& problem, std::vector<double> gamma) {
  project_guess(problem, gamma);
  const CcpFigures figures = CcpJudge{}.figures(problem, gamma, nullptr);
  return std::min(figures.residual, figures.coulomb_residual);
}

int run(const Wanted& wanted) {
  const CcpRecord record = read_ccp_file(wanted.file);
  const CcpProblem problem = record.problem();
  if (!problem.blocks.empty()) throw Error{ErrorKind::usage, "only problems of contacts alone can be given to Bullet"};
  const std::vector<Vec3> still(problem.bodies());
  BulletGroup bullet{problem, still, 1.0, {.two_directions = true, .given_rows = true}};
  double seconds = 0.0, residual = 0.0;
  int iterations = 5;
  for (;;) {
    iterations = std::min(iterations + 1 + iterations / 4, wanted.max_iterations);
    seconds = bullet.solve(iterations);
    residual = residual_of(problem, bullet.impulses());
    if (residual <= wanted.tolerance || iterations == wanted.max_iterations) break;
  }
  std::printf(
      "{\"solver\": \"bullet\", \"status\": \"%s\", \"iterations\": %d, \"residual\": %.9g, \"wall_time\": %.9g}\n",
      residual <= wanted.tolerance ? "converged" : "iteration_limit", iterations, residual, seconds);
  return 0;
}

}  // namespace
}  // namespace scree::bench

int main(int count, char** arguments) {
  try {
    return scree::bench::run(scree::bench::read_arguments(count, arguments));
  } catch (const scree::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
