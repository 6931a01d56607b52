// What the impulses of steps before are worth as a guess, for every solver: other guesses than those of the last step, and how good one
// would have to be.
//
//     warm_starts [--only=NAME,...] [--starts=NAME,...] [--limit=N] FILE,FILE,FILE ...
//
// Each argument is three problems of consecutive steps (`scree run --record-ccp`, bench/ccp/drum_problems.py); the third is
// solved, the others, solved to 1e-7 m/s, give the guesses:
//
//     zero          nothing
//     last          what the run started from: the impulses of the step before, as its solver left them
//     exact         those of the step before, solved to 1e-7 m/s
//     turned        the same, turned with their contacts
//     mean          mean of the two steps before
//     extrapolated  twice the last less the one before
//     normal        normal parts of the last
//     three_quarters, half, quarter, tenth   the solution and so much of what `last` is away from it: how good a guess has to be
//     known         the solution, but nothing at contacts that carried nothing in the step before: no memory knows more
//
// First it says what a step changes: contacts that carry, that are new among them, that carried before; the distance of guesses
// from the solution over the solution's size; that of the best combination of the last three steps, by hindsight; and the same in
// the energy that solvers lower, where zero has 1. Then the iterations to 1e-2, 1e-3 and 1e-4 m/s, means over the arguments; a
// minus: not within N (20000).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>

#include "known_steps.hpp"
#include "methods.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/ccp/guess.hpp"

namespace scree::bench {
namespace {

constexpr std::array kResiduals{1e-2, 1e-3, 1e-4};  // [m/s]
constexpr double kCarries = 1e-12;                  // less than this is no impulse [N s]
const std::vector<std::string> kStarts{"zero",   "last",           "exact", "turned",  "mean",  "extrapolated",
                                       "normal", "three_quarters", "half",  "quarter", "tenth", "known"};

using Impulses = std::vector<double>;

Impulses sum(double a, const Impulses& x, double b, const Impulses& y) {
  Impulses out(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) out[k] = a * x[k] + b * y[k];
  return out;
}

double product(const Impulses& x, const Impulses& y) {
  double out = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) out += x[k] * y[k];
  return out;
}

/// Three steps: the problem of the last, and what those before leave for it.
class Moment {
 public:
  explicit Moment(const std::string& files) {
    const std::vector<std::string> names = split(files, ',');
    if (names.size() != 3) throw std::runtime_error{files + ": three files of consecutive steps, please"};
    const KnownStep first = read_known_step(names[0]), second = read_known_step(names[1]);
    now_ = read_known_step(names[2]);
    if (first.record.origin.step + 2 != now_.record.origin.step ||
        second.record.origin.step + 1 != now_.record.origin.step) {
      throw std::runtime_error{files + ": not consecutive steps"};
    }
    const auto brought = [&](const Impulses& of_first) {
      return carry(second.record, carry(first.record, of_first, second.record, Carried::in_world), now_.record,
                   Carried::in_world);
    };
    exact_ = carry(second.record, second.solution, now_.record, Carried::in_world);
    turned_ = carry(second.record, second.solution, now_.record, Carried::with_contact);
    before_ = brought(first.solution);
    long_before_ = brought(first.record.guess);
  }

  [[nodiscard]] CcpProblem problem() const { return now_.record.problem(); }
  [[nodiscard]] const Impulses& solution() const { return now_.solution; }
  [[nodiscard]] std::array<const Impulses*, 3> three() const { return {&exact_, &before_, &long_before_}; }

  /// @throws std::runtime_error for a name that is none.
  [[nodiscard]] Impulses start(const std::string& name) const {
    const Impulses& last = now_.record.guess;
    if (name == "zero") return Impulses(last.size(), 0.0);
    if (name == "last") return last;
    if (name == "exact") return exact_;
    if (name == "turned") return turned_;
    if (name == "mean") return sum(0.5, exact_, 0.5, before_);
    if (name == "extrapolated") return sum(2.0, exact_, -1.0, before_);
    if (name == "normal") return only_normal(last);
    if (name == "known") return only_known();
    for (const auto& [part, share] :
         {std::pair{"three_quarters", 0.75}, {"half", 0.5}, {"quarter", 0.25}, {"tenth", 0.1}}) {
      if (name == part) return sum(share, last, 1.0 - share, solution());
    }
    throw std::runtime_error{"no start has the name " + name};
  }

  /// Contacts that carry now; those among them that did not before; those that did and do not now.
  [[nodiscard]] std::array<std::size_t, 3> carrying() const {
    std::array<std::size_t, 3> out{};
    for (std::size_t k = 0; k < exact_.size(); k += 3) {
      const bool then = exact_[k] > kCarries, now = solution()[k] > kCarries;
      out[0] += static_cast<std::size_t>(now);
      out[1] += static_cast<std::size_t>(now && !then);
      out[2] += static_cast<std::size_t>(then && !now);
    }
    return out;
  }

 private:
  static Impulses only_normal(Impulses gamma) {
    for (std::size_t k = 0; k < gamma.size(); ++k) {
      if (k % 3 != 0) gamma[k] = 0.0;
    }
    return gamma;
  }
  [[nodiscard]] Impulses only_known() const {
    Impulses out = solution();
    for (std::size_t k = 0; k < out.size(); k += 3) {
      if (exact_[k] <= kCarries) out[k] = out[k + 1] = out[k + 2] = 0.0;
    }
    return out;
  }

  KnownStep now_;
  Impulses exact_, turned_, before_, long_before_;
};

/// Of the combination of `parts` that is nearest to `goal`: its distance over the size of the goal.
double best_distance(const std::array<const Impulses*, 3>& parts, const Impulses& goal) {
  constexpr std::size_t kParts = 3;
  std::array<std::array<double, kParts + 1>, kParts> m{};
  for (std::size_t i = 0; i < kParts; ++i) {
    for (std::size_t j = 0; j < kParts; ++j) m[i][j] = product(*parts[i], *parts[j]);
    m[i][kParts] = product(*parts[i], goal);
  }
  for (std::size_t i = 0; i < kParts; ++i) {
    for (std::size_t j = 0; j < kParts; ++j) {
      if (i == j) continue;
      const double factor = m[j][i] / m[i][i];
      for (std::size_t k = i; k <= kParts; ++k) m[j][k] -= factor * m[i][k];
    }
  }
  Impulses rest = goal;
  for (std::size_t i = 0; i < kParts; ++i) rest = sum(1.0, rest, -m[i][kParts] / m[i][i], *parts[i]);
  return std::sqrt(product(rest, rest) / product(goal, goal));
}

void tell_changes(const Moment& moment, const std::string& files) {
  const CcpProblem problem = moment.problem();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  const Impulses& goal = moment.solution();
  const auto in_energy = [&](const Impulses& x) {
    Impulses n(x.size());
    delassus.apply(x, n);
    return product(x, n);
  };
  const auto [carrying, came, went] = moment.carrying();
  fmt::print("{}: {} contacts, {} carry, {} of them new, {} do no more\n", files, problem.contacts.size(), carrying,
             came, went);
  fmt::print("  distance (in energy):");
  for (const char* name : {"last", "turned", "mean", "extrapolated", "normal", "known"}) {
    Impulses guess = moment.start(name);
    project_guess(problem, guess);
    const Impulses away = sum(1.0, guess, -1.0, goal);
    fmt::print(" {} {:.3f} ({:.2f})", name, std::sqrt(product(away, away) / product(goal, goal)),
               std::sqrt(in_energy(away) / in_energy(goal)));
  }
  fmt::print("; best of three steps {:.3f}\n", best_distance(moment.three(), goal));
  std::fflush(stdout);
}

/// Iterations to each residual, means over the moments; none where one of them is missed.
std::string cell(const Method& method, const std::vector<Moment>& moments, const std::string& start, int limit) {
  std::string out;
  for (const double residual : kResiduals) {
    std::optional<double> mean = 0.0;
    for (const Moment& moment : moments) {
      if (!mean) break;
      Impulses gamma = moment.start(start);
      SolveContext context;
      context.tolerance = residual;
      context.max_iterations = limit;
      const SolveSummary summary = make_solver(method.plugin, method.toml)->solve(moment.problem(), context, gamma);
      if (summary.status == SolveStatus::converged) {
        *mean += summary.iterations / static_cast<double>(moments.size());
      } else {
        mean.reset();
      }
    }
    out += mean ? fmt::format(" {:.0f}", *mean) : " -";
    if (!mean) break;
  }
  return out;
}

void run(const std::vector<std::string>& arguments) {
  std::vector<std::string> only, starts = kStarts;
  std::vector<Moment> moments;
  int limit = 20000;
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--only=")) {
      only = split(argument.substr(7), ',');
    } else if (argument.starts_with("--starts=")) {
      starts = split(argument.substr(9), ',');
    } else if (argument.starts_with("--limit=")) {
      limit = std::stoi(argument.substr(8));
    } else {
      moments.emplace_back(argument);
      tell_changes(moments.back(), argument);
    }
  }
  if (moments.empty()) throw std::runtime_error{"no problems: FILE,FILE,FILE of consecutive steps"};
  fmt::print("\nIterations to 1e-2, 1e-3, 1e-4 m/s\n\n| solver |");
  for (const std::string& start : starts) fmt::print(" {} |", start);
  fmt::print("\n|---|");
  for (std::size_t k = 0; k < starts.size(); ++k) fmt::print("---|");
  for (const Method& method : methods_of(only)) {
    fmt::print("\n| {} |", method.name);
    for (const std::string& start : starts) {
      fmt::print("{} |", cell(method, moments, start, limit));
      std::fflush(stdout);
    }
  }
  fmt::print("\n");
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) try {
  scree::bench::run({argv + 1, argv + argc});
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "warm_starts: %s\n", problem.what());
  return 2;
}
