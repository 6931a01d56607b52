// Time and iterations to stated residuals, for every solver, from zero and from the guess of a run.
//
//     time_to_residual [--only=NAME,...] [--limit=N] [--no-map] LABEL=FILE[,FILE...] ...
//     time_to_residual --events --only=NAME [--warm] [--limit=N] FILE
//
// A FILE is a bed (.txt), solved from zero, or a problem that `scree run --record-ccp` wrote (.h5), solved from zero and
// from its guess. The files of a label are averaged. Solvers are those of the plugin folder with their defaults, and apgd
// without its scaling ("plain apgd"); --only=asgs takes some, NAME{KEY = VALUE} with other settings. A solve gets at most N
// iterations (4000).
//
// To a residual: one solve with it as tolerance, the least of three if short. To the natural map: the same with the largest
// tolerance found, by interpolation, at which the map is small enough. One thread. --events says what happens as it happens, for
// time_table.py, which ends what takes too long. Other guesses than the impulses of the step before: warm_starts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>

#include "bed.hpp"
#include "methods.hpp"
#include "natural_map.hpp"
#include "scree/ccp/ccp_file.hpp"

namespace scree::bench {
namespace {

constexpr std::array kResiduals{1e-2, 1e-3, 1e-4};  // [m/s]
constexpr double kMap = 1e-4;                       // [1]
constexpr int kMapTries = 8;
constexpr double kMost = 0.7;   // of a tolerance that misses, for the next try: the map does not follow it closely
constexpr double kShort = 0.5;  // solves of less are repeated [s]
constexpr double kLong = 4.0;   // of more the first answer to the natural map is taken [s]

struct Settings {
  std::vector<std::string> only;
  int limit = 4000;
  bool map = true, events = false, warm = false;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What one solve took.
struct Cost {
  double iterations = 0.0, seconds = 0.0;
};

using Row = std::array<std::optional<Cost>, kResiduals.size() + 1>;

struct Problem {
  std::optional<BedProblem> bed;
  std::optional<CcpRecord> record;
  [[nodiscard]] CcpProblem problem() const { return bed ? bed->problem() : record->problem(); }
};

Problem read(const std::string& file) {
  Problem out;
  if (file.ends_with(".txt")) {
    out.bed.emplace(read_bed(file));
  } else {
    out.record = read_ccp_file(file);
  }
  return out;
}

/// One method on one problem from one guess.
class Trial {
 public:
  Trial(const Method& method, const CcpProblem& problem, std::span<const double> guess, const Settings& settings)
      : problem_{problem}, guess_{guess}, settings_{settings}, solver_{make_solver(method.plugin, method.toml)} {
    delassus_.bind(problem_, nullptr);
  }

  Row run() {
    Row row;
    for (std::size_t k = 0; k < kResiduals.size(); ++k) {
      row[k] = solve(kResiduals[k]);
      if (settings_.events) say(fmt::format("{:g}", kResiduals[k]), row[k]);
      if (!row[k]) return row;
    }
    if (settings_.map) row.back() = solve_for_map();
    if (settings_.events && settings_.map && !row.back()) say("map", row.back());
    return row;
  }

 private:
  std::optional<Cost> solve(double tolerance) {
    Cost cost;
    double spent = 0.0;
    for (int k = 0; k < 3 && (k == 0 || spent / k < kShort); ++k) {
      gamma_.assign(problem_.rows(), 0.0);
      std::copy(guess_.begin(), guess_.end(), gamma_.begin());
      SolveContext context;
      context.tolerance = tolerance;
      context.max_iterations = settings_.limit;
      const auto start = Clock::now();
      if (settings_.events) watch(context, start);
      summary_ = solver_->solve(problem_, context, gamma_);
      const double took = seconds_since(start);
      if (summary_.status != SolveStatus::converged) return std::nullopt;
      cost = {static_cast<double>(summary_.iterations), k == 0 ? took : std::min(cost.seconds, took)};
      spent += took;
    }
    map_of_[tolerance] = natural_map(delassus_, gamma_);
    if (map_of_[tolerance] <= kMap && (!mapped_ || cost.iterations <= mapped_->iterations)) mapped_ = cost;
    return cost;
  }

  // Says that a solve begins, and about once a second how far it is.
  static void watch(SolveContext& context, Clock::time_point start) {
    fmt::print("begin\n");
    std::fflush(stdout);
    context.on_iteration = [start, least = 1e300, next = 1.0](const IterationReport& now) mutable {
      if (now.residual >= 0.0) least = std::min(least, now.residual);
      if (seconds_since(start) < next || least == 1e300) return;
      next = seconds_since(start) + 1.0;
      fmt::print("reached {:.3g}\n", least);
      std::fflush(stdout);
    };
  }

  void say(const std::string& target, const std::optional<Cost>& cost) const {
    if (cost) {
      fmt::print("done {} {:.0f} {:.5g}\n", target, cost->iterations, cost->seconds);
    } else {
      fmt::print("missed {} {} {:.3g}\n", target, to_string(summary_.status), summary_.residual);
    }
    std::fflush(stdout);
  }

  std::optional<Cost> solve_for_map() {
    for (int k = 0; k < kMapTries && (!mapped_ || mapped_->seconds <= kLong); ++k) {
      // The tightest tolerance that misses, and the loosest below it that does not.
      double misses = 0.0, holds = 0.0;
      for (const auto& [tolerance, map] : map_of_) {
        if (map > kMap && misses == 0.0) misses = tolerance;
        if (map <= kMap && misses == 0.0) holds = tolerance;
      }
      if (misses > 0.0 && holds > 0.0 && misses < 1.15 * holds) break;
      double next = 0.0;
      if (holds == 0.0) {
        next = misses * std::min(kMost, 0.9 * kMap / map_of_.at(misses));
      } else if (misses == 0.0) {
        next = 1.1 * holds * kMap / map_of_.at(holds);
      } else {
        const double slope = std::log(misses / holds) / std::log(map_of_.at(misses) / map_of_.at(holds));
        const double guess = holds * std::pow(kMap / map_of_.at(holds), slope);
        next = std::clamp(0.98 * guess, 1.02 * holds, 0.95 * misses);
      }
      if (!solve(next)) break;
      if (mapped_ && settings_.events) say("map", mapped_);
    }
    if (mapped_ && settings_.events) say("map", mapped_);
    return mapped_;
  }

  CcpProblem problem_;
  std::span<const double> guess_;
  const Settings& settings_;
  std::unique_ptr<CcpSolver> solver_;
  DelassusOperator delassus_;
  SolveSummary summary_;
  std::vector<double> gamma_;
  std::map<double, double> map_of_;  ///< natural map of the answer, by tolerance
  std::optional<Cost> mapped_;       ///< of the quickest solve whose answer had a map small enough
};

// The mean over several problems; nothing where one of them failed.
Row mean(const std::vector<Row>& rows) {
  Row out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    Cost sum;
    bool all = true;
    for (const Row& row : rows) {
      all = all && row[k].has_value();
      if (row[k]) sum.iterations += row[k]->iterations, sum.seconds += row[k]->seconds;
    }
    const auto count = static_cast<double>(rows.size());
    if (all) out[k] = Cost{sum.iterations / count, sum.seconds / count};
  }
  return out;
}

void print(const std::string& name, const Row& row) {
  fmt::print("| {} |", name);
  for (const std::optional<Cost>& cost : row) {
    if (cost) {
      fmt::print(" {:.0f}, {:.4g} |", cost->iterations, cost->seconds);
    } else {
      fmt::print(" - |");
    }
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void measure(const Settings& settings, const std::string& label, const std::vector<Problem>& problems) {
  std::size_t contacts = 0;
  for (const Problem& p : problems) contacts += p.problem().contacts.size() / problems.size();
  for (const bool warm : {false, true}) {
    if (warm && !problems.front().record) continue;
    fmt::print("\n{}, {}: {} problem(s), {} contacts. Iterations, seconds\n\n| solver |", label, warm ? "warm" : "cold",
               problems.size(), contacts);
    for (const double residual : kResiduals) fmt::print(" {:g} m/s |", residual);
    fmt::print(" natural map {:g} |\n|---|---|---|---|---|\n", kMap);
    for (const Method& method : methods_of(settings.only)) {
      std::vector<Row> rows;
      for (const Problem& p : problems) {
        const std::span<const double> guess = warm ? p.record->guess : std::span<const double>{};
        rows.push_back(Trial{method, p.problem(), guess, settings}.run());
      }
      print(method.name, mean(rows));
    }
  }
}

// One method on one problem, told line by line.
void tell(const Settings& settings, const std::string& file) {
  const Problem problem = read(file);
  fmt::print("contacts {}\n", problem.problem().contacts.size());
  std::vector<double> guess;
  if (settings.warm && problem.record) guess = problem.record->guess;
  Trial{methods_of(settings.only).front(), problem.problem(), guess, settings}.run();
}

int run(const std::vector<std::string>& arguments) {
  Settings settings;
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--only=")) {
      settings.only = split(argument.substr(7), ',');
    } else if (argument == "--no-map") {
      settings.map = false;
    } else if (argument == "--events") {
      settings.events = true;
    } else if (argument == "--warm") {
      settings.warm = true;
    } else if (settings.events && !argument.starts_with("--")) {
      tell(settings, argument);
    } else if (argument.starts_with("--limit=")) {
      settings.limit = std::stoi(argument.substr(8));
    } else {
      const std::size_t equals = argument.find('=');
      std::vector<Problem> problems;
      for (const std::string& file : split(argument.substr(equals + 1), ',')) problems.push_back(read(file));
      measure(settings, argument.substr(0, equals), problems);
    }
  }
  return 0;
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) try {
  return scree::bench::run({argv + 1, argv + argc});
} catch (const std::exception& problem) {
  std::fprintf(stderr, "time_to_residual: %s\n", problem.what());
  return 2;
}
