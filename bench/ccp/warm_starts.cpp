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
// First it says what a step changes: contacts that carry, that are new among them, that carried before; how many of the new ones the
// step before knew, and how far open it left them (for rigid contacts, which end a step u_n h apart); how much of the change of the
// impulses (their squares) is in contacts that carry before and after; how far from the solution another start ends (is it the only
// one?); the distance of guesses from the solution over the solution's size; that of the best combination of the last three steps, by hindsight; and the same in
// the energy that solvers lower, where zero has 1. Then the iterations to 1e-2, 1e-3 and 1e-4 m/s, means over the arguments; a
// minus: not within N (20000).
#include <fmt/format.h>

#include <algorithm>
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
    keep_gaps(second);
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

  /// Of the contacts that carry now and did not before, those that the step before knew: how far open it left them [m], sorted.
  [[nodiscard]] std::vector<double> opened() const {
    std::vector<double> out;
    for (std::size_t k = 0; k < exact_.size(); k += 3) {
      if (exact_[k] <= kCarries && solution()[k] > kCarries && listed_[k] > 0.5) out.push_back(gap_[k]);
    }
    std::ranges::sort(out);
    return out;
  }

  /// Share of the squared change of the impulses that is in contacts that carry before and now.
  [[nodiscard]] double change_of_those_that_stay() const {
    double all = 0.0, stay = 0.0;
    for (std::size_t k = 0; k < exact_.size(); ++k) {
      const std::size_t normal = k - k % 3;
      const double change = (solution()[k] - exact_[k]) * (solution()[k] - exact_[k]);
      all += change;
      if (exact_[normal] > kCarries && solution()[normal] > kCarries) stay += change;
    }
    return stay / all;
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
  // A rigid contact that opens ends the step with a gap of h u_n, since its r has the gap it began with over h.
  void keep_gaps(const KnownStep& before) {
    const CcpProblem problem = before.record.problem();
    DelassusOperator delassus;
    delassus.bind(problem, nullptr);
    Impulses gap(problem.rows()), known(problem.rows(), 0.0);
    delassus.apply(before.solution, gap);
    const double h = now_.record.origin.time - before.record.origin.time;
    for (std::size_t k = 0; k < gap.size(); k += 3) {
      gap[k] = h * (gap[k] + problem.r[k]);
      gap[k + 1] = gap[k + 2] = 0.0;
      known[k] = 1.0;
    }
    gap_ = carry(before.record, gap, now_.record, Carried::with_contact);
    listed_ = carry(before.record, known, now_.record, Carried::with_contact);
  }
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
  Impulses gap_, listed_;  // in rows of normals: gaps at the end of the step before [m]; 1 for contacts that it knew
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

double distance(const Impulses& x, const Impulses& goal) {
  const Impulses away = sum(1.0, x, -1.0, goal);
  return std::sqrt(product(away, away) / product(goal, goal));
}

void tell_new_contacts(const Moment& moment) {
  const std::vector<double> opened = moment.opened();
  Impulses other(moment.solution().size(), 0.0);
  SolveContext context;
  context.tolerance = kExact;
  context.max_iterations = kMostSweeps;
  make_solver("asgs")->solve(moment.problem(), context, other);
  fmt::print("  {} of the new ones were known, left open by", opened.size());
  for (const double part : {0.1, 0.5, 0.9}) {
    const auto at = static_cast<std::size_t>(part * static_cast<double>(opened.size()));
    if (!opened.empty()) fmt::print(" {:.2g}", 1e6 * opened[at]);
  }
  fmt::print(
      " um (10, 50, 90 %); {:.2f} of the change is in contacts that stay; from zero to the solution within {:.1e}\n",
      moment.change_of_those_that_stay(), distance(other, moment.solution()));
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
  tell_new_contacts(moment);
  fmt::print("  distance (in energy):");
  for (const char* name : {"last", "turned", "mean", "extrapolated", "normal", "known"}) {
    Impulses guess = moment.start(name);
    project_guess(problem, guess);
    fmt::print(" {} {:.3f} ({:.2f})", name, distance(guess, goal),
               std::sqrt(in_energy(sum(1.0, guess, -1.0, goal)) / in_energy(goal)));
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
