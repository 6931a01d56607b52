// pgs beside Bullet's sequential impulse solver (float64), on the same contacts, interleaved in one run, one thread.
//
//     sequential_impulse [BED] [REPEATS]     a bed file; without it (or with "-"), a synthetic bed of 64 000 spheres
//
// The cost of an iteration is the difference of two solves with 50 and 150 iterations, so that setting up cancels; that of
// a solve of 100 iterations, which holds it, stands beside it. Bullet's friction works along one tangent unless asked for
// two, and on a box or a cone of its own; the residual is that of scree's judge after projection on the cones. Bullet gets
// the bodies and contacts in scree's order, which follows space and spares its caches, and in that of the file.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <numeric>
#include <string_view>

#include "bed.hpp"
#include "bullet_group.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::bench {
namespace {

constexpr double kStep = 1e-3;  // [s], as in BedProblem
constexpr int kFew = 50, kMany = 150, kWhole = 100;

/// One way to solve; `solve` returns seconds for a number of iterations.
struct Contender {
  const char* name;
  std::function<double(int)> solve;
  std::function<std::vector<double>()> impulses;
  std::vector<double> iteration, whole;  // [s] of each repeat
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double residual_of(const CcpProblem& problem, std::vector<double> gamma) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    store_block(gamma, i, project_cone3(load_block(gamma, i), problem.contacts[i].friction));
  }
  return ccp_residual(problem, gamma);
}

/// A scree solver.
class Scree {
 public:
  Scree(PluginHost& host, const CcpProblem& problem, const std::string& toml) : problem_{problem} {
    const PluginEntry& entry = host.entry("ccp_solver", "pgs", {});
    plugin_ = entry.make(options_from_text(toml, entry.parameters));
    solver_ = dynamic_cast<CcpSolver*>(plugin_.get());
  }
  double solve(int iterations) {
    SolveContext context;
    context.tolerance = 0.0;
    context.max_iterations = iterations;
    gamma_.assign(problem_.rows(), 0.0);
    const auto start = std::chrono::steady_clock::now();
    solver_->solve(problem_, context, gamma_);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    return took.count();
  }
  [[nodiscard]] const std::vector<double>& impulses() const { return gamma_; }

 private:
  CcpProblem problem_;
  std::unique_ptr<Plugin> plugin_;
  CcpSolver* solver_ = nullptr;
  std::vector<double> gamma_;
};

std::vector<Vec3> free_velocities(const Bed& bed, const BedProblem& made) {
  std::vector<Vec3> free;
  for (const BodyIndex body : made.bodies()) {
    free.push_back(body < BedProblem::kWalls ? Vec3{}
                                             : bed.velocity[body - BedProblem::kWalls] + kStep * Vec3{0, 0, -9.81});
  }
  return free;
}

// Numbers of the problem's bodies in the order in which the bed's file has them.
std::vector<std::uint32_t> file_order(std::span<const BodyIndex> bodies) {
  std::vector<std::uint32_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return bodies[a] < bodies[b]; });
  return order;
}

void report(const CcpProblem& problem, std::vector<Contender>& contenders, int repeats) {
  for (int k = 0; k < repeats; ++k) {
    for (Contender& c : contenders) {
      const double few = c.solve(kFew), many = c.solve(kMany);
      c.iteration.push_back((many - few) / (kMany - kFew));
      c.whole.push_back(c.solve(kWhole));
    }
  }
  const double to_ns = 1e9 / static_cast<double>(problem.contacts.size());
  const double own = median(contenders.front().iteration);
  fmt::print("{} bodies, {} contacts, {} repeats, medians\n\n", problem.bodies(), problem.contacts.size(), repeats);
  fmt::print(
      "| solver | ns per contact and iteration | least | with setting up, {0} iterations | over {1} | residual after "
      "{0} [m/s] |\n"
      "|---|---|---|---|---|---|\n",
      kWhole, contenders.front().name);
  for (Contender& c : contenders) {
    c.solve(kWhole);
    fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2g} |\n", c.name, to_ns * median(c.iteration),
               to_ns * *std::min_element(c.iteration.begin(), c.iteration.end()), to_ns * median(c.whole) / kWhole,
               median(c.iteration) / own, residual_of(problem, c.impulses()));
  }
}

int run(const char* file, int repeats) {
  const Bed bed = std::string_view{file} == "-" ? synthetic_bed(64000) : read_bed(file);
  const BedProblem made{bed};
  const CcpProblem problem = made.problem();
  const std::vector<Vec3> free = free_velocities(bed, made);
  PluginHost host;
  const char* const folder = std::getenv("SCREE_PLUGIN_PATH");
  host.search(folder != nullptr ? folder : SCREE_BENCH_PLUGINS);

  Scree pgs{host, problem, ""}, coloured{host, problem, "order = \"coloured\""};
  BulletGroup one{problem, free, kStep, {}}, two{problem, free, kStep, {.two_directions = true}};
  BulletGroup as_read{
      problem, free, kStep, {.two_directions = true, .bodies = file_order(made.bodies()), .contacts = made.found()}};
  const auto of = [](const char* name, auto& with) {
    return Contender{name, [&with](int n) { return with.solve(n); }, [&with] { return with.impulses(); }, {}, {}};
  };
  std::vector<Contender> contenders{of("scree pgs", pgs), of("scree pgs, coloured", coloured),
                                    of("Bullet, its default: one tangent", one), of("Bullet, two tangents", two),
                                    of("Bullet, two tangents, order of the file", as_read)};
  report(problem, contenders, repeats);
  return 0;
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) try {
  return scree::bench::run(argc > 1 ? argv[1] : "-", argc > 2 ? std::max(1, std::atoi(argv[2])) : 5);
} catch (const std::exception& problem) {
  std::fprintf(stderr, "sequential_impulse: %s\n", problem.what());
  return 2;
}
