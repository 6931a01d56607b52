// What memory allows, and what the solvers make of it.
//
//     ccp_floor_bench floor [SOLVER [OPTIONS]]   one thread: an iteration against its floor
//     ccp_floor_bench threads    two threads against the best serial variant, beside the gain of a plain copy
//     ccp_floor_bench memory [CONTACTS]    bytes a contact of each solver, peak resident set of all that solves such a problem
//
// The floor of an iteration: each contact's record (120 bytes at most) once, its impulse read and written, the velocities of the
// bodies once, over the bandwidth of copying. SCREE_BED=FILE for a bed of one's own; without it, a synthetic one of 64 000
// spheres. Figures are medians of interleaved repeats. On one thread processor time is taken, which a busy machine bends less,
// though not its caches. It does not show how many iterations a solver needs.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <span>
#include <string_view>

#include "bed.hpp"
#include "methods.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::bench {
namespace {

constexpr int kRepeats = 5;
constexpr int kFew = 20, kMany = 60;  // iterations; their difference is free of what comes before and after

struct Variant {
  const char* name;
  const char* plugin;
  const char* toml;
};

constexpr Variant kSerial[] = {{"apgd", "apgd", ""}, {"spg", "spg", ""}, {"pgs", "pgs", ""}, {"asgs", "asgs", ""}};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

using Clock = double (*)();

Bed the_bed() {
  const char* const file = std::getenv("SCREE_BED");
  return file != nullptr ? read_bed(file) : synthetic_bed(64000);
}

/// Seconds of one iteration.
double iteration(CcpSolver& solver, const CcpProblem& problem, const Executor& executor, Clock clock) {
  std::vector<double> gamma(problem.rows());
  double took[2];
  for (int k = 0; k < 2; ++k) {
    std::fill(gamma.begin(), gamma.end(), 0.0);
    SolveContext context;
    context.tolerance = 0.0;
    context.max_iterations = k == 0 ? kFew : kMany;
    context.executor = &executor;
    const double start = clock();
    solver.solve(problem, context, gamma);
    took[k] = clock() - start;
  }
  return (took[1] - took[0]) / (kMany - kFew);
}

/// Bytes read and written a second by copying what no cache holds.
double copy_bandwidth(const Executor& executor, Clock clock) {
  static std::vector<char> from(std::size_t{1} << 28, 1), to(from.size(), 2);
  constexpr std::size_t kGrain = std::size_t{1} << 24;
  const double start = clock();
  executor.for_chunks(from.size(), kGrain, [](std::size_t first, std::size_t last) {
    std::memcpy(to.data() + first, from.data() + first, last - first);
  });
  return 2.0 * static_cast<double>(from.size()) / (clock() - start);
}

double floor_bytes(const CcpProblem& p) {
  constexpr double kRecord = 120.0, kImpulse = 3 * sizeof(double);
  return static_cast<double>(p.contacts.size()) * (kRecord + 2.0 * kImpulse) +
         static_cast<double>(p.bodies()) * 6 * sizeof(double);
}

void print_floor(std::span<const Variant> variants) {
  const BedProblem bed{the_bed()};
  const CcpProblem problem = bed.problem();
  const auto contacts = static_cast<double>(problem.contacts.size());
  const Executor one{1};
  fmt::print("{} contacts, {} bodies; floor {:.0f} bytes a contact and iteration\n\n", problem.contacts.size(),
             problem.bodies(), floor_bytes(problem) / contacts);
  fmt::print("{:<16}{:>12}{:>14}{:>10}{:>10}\n", "", "copy GB/s", "ns/contact", "floor", "ratio");
  for (const Variant& variant : variants) {
    const std::unique_ptr<CcpSolver> solver = make_solver(variant.plugin, variant.toml);
    std::vector<double> bandwidth, taken, ratio;
    for (int k = 0; k < kRepeats; ++k) {
      bandwidth.push_back(copy_bandwidth(one, &processor_seconds));
      taken.push_back(iteration(*solver, problem, one, &processor_seconds));
      ratio.push_back(taken.back() * bandwidth.back() / floor_bytes(problem));
    }
    fmt::print("{:<16}{:>12.1f}{:>14.1f}{:>10.1f}{:>10.2f}\n", variant.name, median(bandwidth) * 1e-9,
               median(taken) * 1e9 / contacts, floor_bytes(problem) / median(bandwidth) * 1e9 / contacts,
               median(ratio));
  }
}

void print_threads() {
  struct Row {
    Variant serial, threaded;
  };
  static constexpr Row kRows[] = {{{"apgd", "apgd", ""}, {"apgd", "apgd", ""}},
                                  {{"spg", "spg", ""}, {"spg", "spg", ""}},
                                  {{"pgs", "pgs", ""}, {"pgs coloured", "pgs", "order = \"coloured\""}},
                                  {{"asgs", "asgs", ""}, {"asgs coloured", "asgs", "order = \"coloured\""}}};
  const BedProblem bed{the_bed()};
  const CcpProblem problem = bed.problem();
  const Executor one{1}, two{2};
  fmt::print("{:<16}{:>16}{:>18}{:>8}{:>12}{:>14}\n", "", "serial ms/it", "2 threads ms/it", "gain", "copy gain",
             "gain / copy");
  for (const Row& row : kRows) {
    const std::unique_ptr<CcpSolver> serial = make_solver(row.serial.plugin, row.serial.toml),
                                     threaded = make_solver(row.threaded.plugin, row.threaded.toml);
    std::vector<double> before, after, gain, copy_gain;
    for (int k = 0; k < kRepeats; ++k) {
      before.push_back(iteration(*serial, problem, one, &wall_seconds));
      after.push_back(iteration(*threaded, problem, two, &wall_seconds));
      gain.push_back(before.back() / after.back());
      const double single = copy_bandwidth(one, &wall_seconds);
      copy_gain.push_back(copy_bandwidth(two, &wall_seconds) / single);
    }
    fmt::print("{:<16}{:>16.2f}{:>18.2f}{:>8.2f}{:>12.2f}{:>14.2f}\n", row.threaded.name, median(before) * 1e3,
               median(after) * 1e3, median(gain), median(copy_gain), median(gain) / median(copy_gain));
  }
}

double resident_bytes(const char* key) {
  std::FILE* const status = std::fopen("/proc/self/status", "r");
  if (status == nullptr) return 0.0;
  char line[256];
  double kilobytes = 0.0;
  while (std::fgets(line, sizeof line, status) != nullptr) {
    if (std::strncmp(line, key, std::strlen(key)) == 0) kilobytes = std::strtod(line + std::strlen(key), nullptr);
  }
  std::fclose(status);
  return 1024.0 * kilobytes;
}

void print_memory(std::size_t contacts) {
  // A cubic grid has a little less than three contacts a sphere.
  const BedProblem bed{synthetic_bed(static_cast<std::size_t>(static_cast<double>(contacts) / 2.98))};
  const CcpProblem problem = bed.problem();
  const auto m = static_cast<double>(problem.contacts.size());
  fmt::print("{} contacts, {} bodies; the problem itself and its impulses: {:.0f} bytes a contact\n",
             problem.contacts.size(), problem.bodies(),
             sizeof(CcpContact) + 48.0 + 80.0 * static_cast<double>(problem.bodies()) / m);
  static constexpr Variant kVariants[] = {{"apgd", "apgd", ""},
                                          {"spg", "spg", ""},
                                          {"pgs", "pgs", ""},
                                          {"pgs coloured", "pgs", "order = \"coloured\""},
                                          {"jacobi", "jacobi", ""},
                                          {"asgs", "asgs", ""},
                                          {"asgs coloured", "asgs", "order = \"coloured\""}};
  const Executor two{2};
  SolveContext context;
  context.tolerance = 0.0;
  context.max_iterations = 3;
  context.executor = &two;
  fmt::print("{:<16}{:>18}\n", "", "bytes/contact");
  std::vector<double> gamma(problem.rows());
  for (const Variant& variant : kVariants) {
    const std::unique_ptr<CcpSolver> solver = make_solver(variant.plugin, variant.toml);
    const double before = resident_bytes("VmRSS:");
    std::fill(gamma.begin(), gamma.end(), 0.0);
    solver->solve(problem, context, gamma);
    fmt::print("{:<16}{:>18.0f}\n", variant.name, (resident_bytes("VmRSS:") - before) / m);
  }
  fmt::print("peak resident set {:.2f} GiB\n", resident_bytes("VmHWM:") / static_cast<double>(1U << 30));
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "floor";
  if (what == "floor") {
    const scree::bench::Variant asked{argc > 2 ? argv[2] : "", argc > 2 ? argv[2] : "", argc > 3 ? argv[3] : ""};
    scree::bench::print_floor(argc > 2 ? std::span{&asked, 1} : std::span{scree::bench::kSerial});
  } else if (what == "threads") {
    scree::bench::print_threads();
  } else if (what == "memory") {
    scree::bench::print_memory(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2'000'000);
  } else {
    fmt::print(stderr, "ccp_floor_bench: '{}' is not one of floor, threads, memory\n", what);
    return 2;
  }
  return 0;
}
