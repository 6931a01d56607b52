#include "apgd.hpp"

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
/// The residual is far above the tolerance by this factor; then so many looks at it are left out.
constexpr double kFar = 10.0;
constexpr int kLooksLeftOut = 4;

}  // namespace

Apgd::Apgd(const Options& options)
    : Apgd{ApgdOptions{.scaled = options.boolean("scaled"),
                       .restart = options.boolean("restart"),
                       .growth = options.number("growth"),
                       .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Apgd::parameters() {
  return {
      Parameter::boolean("scaled", "measure each contact in its own mass; false: one length for all").by_default(true),
      Parameter::boolean("restart", "drop the momentum when it points uphill").by_default(true),
      Parameter::number("growth", "1", "factor on the step length after each accepted step")
          .by_default(1.0)
          .at_least(1.0)
          .at_most(2.0),
      Parameter::integer(
          "check_interval",
          "iterations between two computations of the residual; five times as many far above the tolerance")
          .by_default(10)
          .at_least(1.0),
  };
}

void Apgd::prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma) {
  delassus_.bind(problem, context.executor);
  packed_.build(delassus_, options_.scaled ? packed::Scaling::block : packed::Scaling::none);
  confirmation_.start(delassus_, gamma, context.tolerance, context.executor);
  if (problem.contacts.size() >= kManyRecords && problem.blocks.empty()) delassus_.release_partition();
  packed_.pack(gamma, x_);
  x_old_ = x_;
  p_.assign(packed_.body_groups(), packed::Twists{});
  p_old_ = p_;
  product_.assign(packed_.has_matrix() ? problem.rows() : 0, 0.0);
  product_old_ = product_;
  y_ = product_;
  product_y_ = product_;
  partial_.resize(std::max(packed_.runs(), packed_.body_chunks()));
  theta_ = 1.0, beta_ = 0.0;
  step_ = 1.0;
  pace_ = residual_per_pace_ = 0.0;
  start();
}

// One try of a step from y, which is a pass over the units. False when nothing can move any more.
bool Apgd::iterate() {
  const double theta_next = 0.5 * theta_ * (std::sqrt(theta_ * theta_ + 4.0) - theta_);
  const double beta_next = theta_ * (1.0 - theta_) / (theta_ * theta_ + theta_next);
  if (spread_ != beta_) move_to(beta_);
  Sums sums = unit_pass();
  sums += packed_.has_matrix() ? matrix_pass() : body_pass(beta_next);
  // Differences made of the last bits of the sums tell nothing: no reason to shrink the step.
  const double rounding = 1e-28 * std::abs(sums.quadratic);
  const double length = step_ * sums.curvature;
  const bool overshot = length > sums.distance + rounding;
  if (overshot) step_ = std::min(0.9 * step_, 0.98 * sums.distance / sums.curvature);
  // Up to twice the distance a step still goes down from y. It is kept, and the next one is shorter.
  if (length > 2.0 * sums.distance + rounding) {
    theta_ = 1.0, beta_ = 0.0;
    spread_ = -1.0;
    return step_ > 0.0;
  }
  const bool moved = sums.distance > 0.0 || beta_ != 0.0;
  quadratic_ = sums.quadratic;
  pace_ = std::sqrt(sums.distance) / step_;
  x_.swap(x_old_);
  p_.swap(p_old_);
  product_.swap(product_old_);
  spread_ = packed_.has_matrix() ? -1.0 : beta_next;
  theta_ = theta_next, beta_ = beta_next;
  if (options_.restart && sums.distance + sums.onward < 0.0) theta_ = 1.0, beta_ = 0.0;
  if (!overshot) step_ *= options_.growth;
  return moved && std::isfinite(sums.distance);
}

// The residual of x_, which is kept in gamma when it is the best so far and not above the start.
void Apgd::look(SolveSummary& summary, double start, std::span<double> gamma) {
  const double now = confirmation_.residual(packed_, x_, residual());
  residual_per_pace_ = now / pace_;
  if (!(now < summary.residual) || objective() > start) return;
  summary.residual = now;
  packed_.unpack(x_, gamma);
}

SolveStatus Apgd::descend(const SolveContext& context, SolveSummary& summary, std::span<double> gamma) {
  const double guess = objective(), start = guess + 1e-14 * std::abs(guess);  // up to rounding
  StallWatch watch{packed_.problem().r};
  int next_look = 1, left_out = 0;
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    ++summary.iterations;
    const bool moving = iterate();
    const bool last = summary.iterations == context.max_iterations || !moving;
    bool looking = last || summary.iterations >= next_look;
    // A look costs half an iteration and more. As far as the length of the steps tells, there is nothing to be seen yet.
    if (looking && !last && left_out < kLooksLeftOut && residual_per_pace_ * pace_ > kFar * context.tolerance) {
      looking = false;
      ++left_out;
      next_look = summary.iterations + options_.check_interval;
    }
    if (looking) {
      look(summary, start, gamma);
      left_out = 0;
      next_look = summary.iterations < options_.check_interval ? 2 * summary.iterations
                                                               : summary.iterations + options_.check_interval;
    }
    if (context.on_iteration) {  // watched: what the best iterate would be worth if it were looked at now
      const double best = looking ? summary.residual : std::min(summary.residual, residual());
      context.on_iteration({summary.iterations, best});
    }
    if (!moving || (looking && watch.stalled(summary.iterations, summary.residual))) return SolveStatus::stalled;
  }
  return SolveStatus::iteration_limit;
}

SolveSummary Apgd::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "apgd: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!project_guess(problem, gamma)) return {SolveStatus::numerical_failure, 0, kInfinity};
  prepare(problem, context, gamma);
  const double guess_residual = confirmation_.residual(problem, gamma, residual());
  if (guess_residual <= context.tolerance) return {SolveStatus::converged, 0, guess_residual};
  // Any step downhill beats the guess, whose residual may be small by accident far away.
  SolveSummary summary{SolveStatus::iteration_limit, 0, kInfinity};
  summary.status = descend(context, summary, gamma);
  if (std::isinf(summary.residual)) summary.residual = guess_residual;  // the guess was not improved on
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
}

void Apgd::release_workspace() {
  delassus_ = {};
  packed_.release_memory();
  confirmation_.release_memory();
  release(x_.contacts, x_.rows, x_old_.contacts, x_old_.rows, p_, p_old_);
  release(product_, product_old_, y_, product_y_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Apgd>(
      "apgd", "Accelerated projected gradient: fast to small residuals on deep piles.", scree::Apgd::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("apgd", "1.0.0", &list)};
