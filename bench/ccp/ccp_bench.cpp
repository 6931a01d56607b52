// CCP solvers on a bed of spheres: time per contact and iteration against what memory allows, and the residual bought.
//
//     SCREE_BED=bed.txt ccp_bench          a bed from a file; without it, a synthetic one of 64 000 spheres
//     SCREE_PLUGIN_PATH=DIR                folder of the solvers, when it is not the build's own
//
// It does not show time to a stated residual on a moving bed with warm starts, nor collision.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <map>

#include "bed.hpp"
#include "methods.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::bench {
namespace {

const BedProblem& bed_problem() {
  static const char* const file = std::getenv("SCREE_BED");
  static const BedProblem problem{file != nullptr ? read_bed(file) : synthetic_bed(64000)};
  return problem;
}

// Bytes that an iteration must move: the contact's minimal fields once, impulses read and written, velocities once.
double floor_bytes(const CcpProblem& p) {
  const auto m = static_cast<double>(p.contacts.size()), n = static_cast<double>(p.bodies());
  return m * (sizeof(CcpContact) + 2 * 3 * sizeof(double)) + n * 6 * sizeof(double);
}

// Bandwidth of copying what does not fit into caches, bytes read and written [B/s].
double copy_bandwidth() {
  static const double measured = [] {
    std::vector<char> from(std::size_t{1} << 27, 1), to(from.size(), 2);
    double best = 0.0;
    for (int k = 0; k < 7; ++k) {
      const auto start = std::chrono::steady_clock::now();
      std::memcpy(to.data(), from.data(), from.size());
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best = std::max(best, 2.0 * static_cast<double>(from.size()) / took.count());
    }
    return best;
  }();
  return measured;
}

void iterations(benchmark::State& state, const std::string& plugin, const std::string& toml, int threads) {
  const std::unique_ptr<CcpSolver> solver = make_solver(plugin, toml);
  const CcpProblem problem = bed_problem().problem();
  const Executor executor{threads};
  SolveContext context;
  context.tolerance = 0.0;
  context.max_iterations = 100;
  context.executor = &executor;
  std::vector<double> gamma(problem.rows());
  SolveSummary summary;
  for (auto _ : state) {
    std::fill(gamma.begin(), gamma.end(), 0.0);
    summary = solver->solve(problem, context, gamma);
  }
  const double each = static_cast<double>(problem.contacts.size()) * 100.0;
  using benchmark::Counter;
  state.counters["ns_per_contact_iteration"] =
      Counter{each * 1e-9, Counter::kIsIterationInvariantRate | Counter::kInvert};
  state.counters["floor_ns"] =
      floor_bytes(problem) / static_cast<double>(problem.contacts.size()) / copy_bandwidth() * 1e9;
  state.counters["residual"] = summary.residual;
  state.counters["contacts"] = static_cast<double>(problem.contacts.size());
}

// Iterations and time until the residual is reached, from zero.
void cold_solve(benchmark::State& state, const std::string& plugin, const std::string& toml, double tolerance) {
  const std::unique_ptr<CcpSolver> solver = make_solver(plugin, toml);
  const CcpProblem problem = bed_problem().problem();
  SolveContext context;
  context.tolerance = tolerance;
  context.max_iterations = 3000;
  std::vector<double> gamma(problem.rows());
  SolveSummary summary;
  for (auto _ : state) {
    std::fill(gamma.begin(), gamma.end(), 0.0);
    summary = solver->solve(problem, context, gamma);
  }
  state.counters["iterations"] = summary.iterations;
  state.counters["residual"] = summary.residual;
}

void register_all() {
  struct Solver {
    const char* name;
    const char* plugin;
    const char* toml;
    bool threaded;
  };
  static constexpr Solver kSolvers[] = {{"pgs", "pgs", "", false},
                                        {"pgs_coloured", "pgs", "order = \"coloured\"", true},
                                        {"apgd", "apgd", "", true},
                                        {"asgs", "asgs", "", false},
                                        {"asgs_coloured", "asgs", "order = \"coloured\"", true},
                                        {"jacobi", "jacobi", "", true},
                                        {"spg", "spg", "", true},
                                        {"spg_bb1", "spg", "step = \"bb1\"", true}};
  // Each of their iterations factorises: they are for small and medium problems, and for small residuals.
  static constexpr const char* kDirect[] = {"admm", "interior_point", "semismooth_newton"};
  constexpr std::size_t kMedium = 50000;
  for (const Solver& s : kSolvers) {
    for (int threads = 1; threads <= (s.threaded ? 2 : 1); ++threads) {
      benchmark::RegisterBenchmark(fmt::format("iterations/{}/threads:{}", s.name, threads).c_str(), &iterations,
                                   s.plugin, s.toml, threads)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MinTime(0.5);
    }
  }
  for (const Solver& s : kSolvers) {
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      benchmark::RegisterBenchmark(fmt::format("cold_solve/{}/residual:{:g}", s.name, tolerance).c_str(), &cold_solve,
                                   s.plugin, s.toml, tolerance)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->Iterations(1);
    }
  }
  if (bed_problem().problem().contacts.size() > kMedium) return;
  for (const char* name : kDirect) {
    for (const double tolerance : {1e-4, 1e-8}) {
      benchmark::RegisterBenchmark(fmt::format("cold_solve/{}/residual:{:g}", name, tolerance).c_str(), &cold_solve,
                                   name, "", tolerance)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->Iterations(1);
    }
  }
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  scree::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
