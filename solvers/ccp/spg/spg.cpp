#include "spg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/sweep/stall_watch.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Safeguards of the spectral step [1], in units where the diagonal of N is one.
constexpr double kShortest = 1e-8, kLongest = 1e8;
/// Looks after which the body velocities are made anew: they gather the rounding of all steps. Where the residual is as small
/// as this share of the largest velocity of r, it shows, and each look does so.
constexpr int kLooksToRefresh = 10;
constexpr double kRoundingShows = 1e-6;

SpgOptions::Scaling scaling_of(std::string_view name) {
  return name == "block"     ? SpgOptions::Scaling::block
         : name == "contact" ? SpgOptions::Scaling::unit
                             : SpgOptions::Scaling::none;
}

SpgOptions::Step step_of(std::string_view name) {
  return name == "bb1" ? SpgOptions::Step::bb1 : name == "bb2" ? SpgOptions::Step::bb2 : SpgOptions::Step::alternating;
}

}  // namespace

Spg::Spg(const Options& options)
    : Spg{SpgOptions{.scaling = scaling_of(options.text("scaling")),
                     .step = step_of(options.text("step")),
                     .hold = static_cast<int>(options.integer("hold")),
                     .memory = static_cast<int>(options.integer("memory")),
                     .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Spg::parameters() {
  return {
      Parameter::choice("scaling", {"block", "contact", "none"},
                        "measure each contact in its own two masses (normal, tangents), in their mean, or all in one")
          .by_default("block"),
      Parameter::choice("step", {"bb1", "bb2", "alternating"},
                        "spectral step of Barzilai and Borwein: the long one, the short one, or one after the other")
          .by_default("bb1"),
      Parameter::integer("hold", "iterations that use one spectral step").by_default(4).at_least(1.0).at_most(100.0),
      Parameter::integer("memory", "iterates that the line search compares with; 1 makes it monotone")
          .by_default(10)
          .at_least(1.0)
          .at_most(1000.0),
      Parameter::integer("check_interval", "iterations between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

void Spg::prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma) {
  delassus_.bind(problem, context.executor);
  packed_.build(delassus_, options_.scaling);
  confirmation_.start(delassus_, gamma, context.tolerance, context.executor);
  packed_.pack(gamma, x_);
  x_best_ = x_;
  d_ = x_;
  w_.assign(packed_.body_groups(), packed::Twists{});
  v_ = w_;
  product_.assign(packed_.has_matrix() ? problem.rows() : 0, 0.0);
  product_d_ = product_;
  sums_.resize(packed_.runs());
  partial_.resize(std::max(packed_.runs(), packed_.body_chunks()));
  search_.start(options_.memory);
  alpha_ = 1.0;
  hold_ = options_.hold;
  pending_ = 0.0;
  refresh();
}

// A direction, a step along it, and the spectral step of the next; the residual of x before it, when asked for. False when
// there is no way down.
bool Spg::iterate(int iteration, double* residual) {
  Sums sums = unit_pass(residual);
  const double curvature = packed_.has_matrix() ? matrix_pass() : body_pass();
  sums.curvature += curvature;
  pending_ = 0.0;
  // A projection's slope is at least this steep. Near the answer u^T d itself drowns in the rounding of x: d is of the order
  // of the residual, but known to the last bits of x only, and u is of any size.
  sums.slope = std::min(sums.slope, -sums.distance / alpha_);
  if (!(sums.slope < 0.0)) {
    if (fresh_ && alpha_ == 1.0) return false;
    // Rounding of the velocities, or of what the last step was made of, may hide the way down.
    refresh();
    alpha_ = 1.0;
    return true;
  }
  pending_ = search_.step(sums.slope, sums.curvature);
  if (pending_ != 1.0) move_slots();  // they were moved by a whole step, which it mostly is
  fresh_ = false;
  if (iteration % hold_ == 0) choose_step(iteration / hold_, sums);
  return true;
}

void Spg::choose_step(int turn, const Sums& sums) {
  const bool second =
      options_.step == SpgOptions::Step::bb2 || (options_.step == SpgOptions::Step::alternating && turn % 2 == 0);
  const double ratio = second ? sums.curvature / product_norm() : sums.distance / sums.curvature;
  alpha_ = std::isfinite(ratio) ? std::clamp(ratio, kShortest, kLongest) : kLongest;
}

// x, when its residual is the least so far and its objective, which has changed by `change`, not above the start.
void Spg::keep_best(SolveSummary& summary, double residual, double change) {
  if (!(residual < summary.residual) || change > 0.0) return;
  summary.residual = residual;
  packed_.copy(x_, x_best_);
}

// The residual of x with its last step [m/s], from the impulses alone.
double Spg::look(SolveSummary& summary) {
  refresh();
  const double now = confirmation_.residual(packed_, x_, packed_.look(x_, product_).residual);
  keep_best(summary, now, search_.change());
  return now;
}

SolveStatus Spg::descend(const SolveContext& context, SolveSummary& summary) {
  StallWatch watch{packed_.problem().r};
  double small = 0.0;
  for (const double velocity : packed_.problem().r) small = std::max(small, kRoundingShows * std::abs(velocity));
  int next_look = 2, looks = 0;  // the pass of an iteration looks at the answer of the one before
  bool kept = false;             // an answer from the impulses alone
  while (!kept && summary.iterations < context.max_iterations) {
    const int k = ++summary.iterations;
    const double change = search_.change();
    const bool looking = k >= next_look;
    double seen = kInfinity;
    bool moving = iterate(k, looking ? &seen : nullptr);
    if (looking) {
      // Held steps amplify rounding.
      hold_ = seen < small ? 1 : options_.hold;
      if (!std::isfinite(seen)) return SolveStatus::numerical_failure;
      if (seen > context.tolerance) keep_best(summary, seen, change);
      next_look = k < options_.check_interval ? 2 * k : k + options_.check_interval;
    }
    const bool near = seen <= context.tolerance, last = k == context.max_iterations || !moving;
    if (near || last) {
      const double now = look(summary);
      kept = now <= context.tolerance && summary.residual == now;
      next_look = k + 1;
    } else if (looking && (++looks % kLooksToRefresh == 0 || seen < small)) {
      refresh();
    }
    const bool looked = looking || near || last;
    if (context.on_iteration) context.on_iteration({k, looked ? summary.residual : -1.0});
    if (!kept && (!moving || (looked && watch.stalled(k, summary.residual)))) return SolveStatus::stalled;
  }
  return SolveStatus::iteration_limit;
}

SolveSummary Spg::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "spg: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!project_guess(problem, gamma)) return {SolveStatus::numerical_failure, 0, kInfinity};
  prepare(problem, context, gamma);
  const double guess_residual = confirmation_.residual(problem, gamma, packed_.look(x_, product_).residual);
  if (guess_residual <= context.tolerance) return {SolveStatus::converged, 0, guess_residual};
  // Any step downhill beats the guess, whose residual may be small by accident far away.
  SolveSummary summary{SolveStatus::iteration_limit, 0, kInfinity};
  summary.status = descend(context, summary);
  if (std::isinf(summary.residual)) {
    summary.residual = guess_residual;  // the guess was not improved on
  } else {
    // Judged from the impulses alone, as the caller would.
    x_.swap(x_best_);
    refresh();
    packed_.unpack(x_, gamma);
    summary.residual = confirmation_.residual(problem, gamma, packed_.look(x_, product_).residual);
  }
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
}

void Spg::release_workspace() {
  delassus_ = {};
  packed_.release_memory();
  confirmation_.release_memory();
  release(x_.contacts, x_.rows, d_.contacts, d_.rows, x_best_.contacts, x_best_.rows, w_, v_, product_, product_d_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Spg>("spg", "Spectral projected gradient: one light pass an iteration.",
                                            scree::Spg::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("spg", "1.0.0", &list)};
