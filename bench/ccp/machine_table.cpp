// Chain, drum and table of tests/machines with every solver: what 100 iterations bring from zero, and what becomes of 1000 steps with
// 100 iterations each that start from the impulses before, when joints ask for all of their error or a share of it at a time.
//
//     machine_table          prints a table for docs/measured
#include <fmt/format.h>

#include <memory>

#include "machines/rigs.hpp"
#include "methods.hpp"

namespace {

using namespace scree;
using namespace scree::test;

constexpr int kSteps = 1000, kIterations = 100;

std::string cold(Rig rig, CcpSolver& solver) {
  rig.gamma.clear();
  const SolveSummary summary = rig.advance(solver, kIterations);
  return fmt::format("{:.0e} ({})", summary.residual, summary.iterations);
}

std::string loop(Rig rig, CcpSolver& solver, double share) {
  rig.share = share;
  const double start = rig.energy();
  double joint = 0.0, gain = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    rig.advance(solver, kIterations);
    joint = std::max(joint, rig.worst_joint());
    gain = std::max(gain, rig.energy() - start);
    if (!(gain < 1e5)) return fmt::format("gone at step {}", k);
  }
  return fmt::format("{:.0e} m, {:.0e} J", joint, gain);
}

}  // namespace

int main() {
  struct Case {
    const char* name;
    Rig rig;
    bool shares;
  };
  const std::array<Case, 5> cases{Case{"chain, hanging", chain(false), true}, Case{"chain, level", chain(true), true},
                                  Case{"drum", drum(), false}, Case{"table, fixed", table(true), false},
                                  Case{"table, standing", table(false), false}};
  for (const Case& c : cases) {
    fmt::print("\n{}\n\n| solver | from zero: residual [m/s] (iterations) | steps, share 1 |{}\n|---|---|---|{}\n",
               c.name, c.shares ? " share 0.2 | share 0.05 |" : "", c.shares ? "---|---|" : "");
    for (const char* name : {"pgs", "asgs", "jacobi", "apgd", "spg", "admm", "interior_point", "semismooth_newton"}) {
      const std::unique_ptr<CcpSolver> solver = bench::make_solver(name);
      fmt::print("| `{}` | {} | {} |", name, cold(c.rig, *solver), loop(c.rig, *solver, 1.0));
      if (c.shares) fmt::print(" {} | {} |", loop(c.rig, *solver, 0.2), loop(c.rig, *solver, 0.05));
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
  return 0;
}
