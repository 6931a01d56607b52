// How asgs begins: pairs of sweeps in single precision, looked at in double precision.
#include <algorithm>
#include <limits>

#include "asgs.hpp"
#include "scree/ccp/judge.hpp"

namespace scree {
namespace {

/// Objectives closer than this share of their size are equal [1].
constexpr double kRounding = 1e-6;
/// Bodies in contact may differ so much in mass without rounding of the heavy one's impulses being seen on the light one [1].
constexpr double kEqual = 10.0;
/// With a tolerance below this share of the rounding most of the work is double precision's in any case [1].
constexpr double kLittle = 1e-3;
/// What single precision can hold with room for squares: [1/kg] and [1/(kg m2)].
constexpr double kLightest = 1e16;
/// With a larger share of contacts that miss the tolerance there is nothing to be seen yet [1]; so many intervals go without a look.
constexpr double kMany = 2.0 * Southwell::kFew;
constexpr int kLooksLeftOut = 5;
/// Intervals between looks without a new least residual, beside half of all sweeps, after which double precision goes on.
constexpr int kPatience = 12;

}  // namespace

bool Asgs::takes_conjugate_steps(const CcpProblem& problem) const {
  return options_.accelerated && options_.conjugate && problem.matrix.empty() && problem.compliance.empty();
}

// The residual down to which single precision serves [m/s]; infinite where it does not at all.
double Asgs::single_goal(double tolerance) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const CcpProblem& problem = delassus_.problem();
  if (!options_.single || options_.coloured || !takes_conjugate_steps(problem) || !SingleSweep::takes(problem))
    return kNever;
  double lightest = 0.0, heaviest = kLightest;
  for (std::size_t k = 0; k < problem.bodies(); ++k) {
    const double inverse = problem.inverse_mass[k];
    if (std::max(inverse, problem.inverse_inertia[k].row0.x) > kLightest) return kNever;
    if (inverse > 0.0) lightest = std::max(lightest, inverse), heaviest = std::min(heaviest, inverse);
  }
  double speed = 0.0;
  for (const double r : problem.r) speed = std::max(speed, std::abs(r));
  const double rounding = SingleSweep::kRounding * speed * std::max(1.0, lightest / (kEqual * heaviest));
  return tolerance < kLittle * rounding ? kNever : std::max(tolerance, rounding);
}

// For isotropic bodies that have the velocities w_ [J].
double Asgs::objective_of_x() const {
  const CcpProblem& problem = delassus_.problem();
  double sum = 0.0;
  for (std::size_t k = 0; k < w_.size(); ++k) {
    const double mass = problem.inverse_mass[k], moment = problem.inverse_inertia[k].row0.x;
    if (mass > 0.0) sum += 0.5 * squared_norm(w_[k].linear) / mass;
    if (moment > 0.0) sum += 0.5 * squared_norm(w_[k].angular) / moment;
  }
  for (std::size_t i = 0; i < x_.size(); ++i) sum += problem.r[i] * x_[i];
  return sum;
}

// Fetches x_ and w_; returns the residual.
double Asgs::look_single() {
  single_.impulses(delassus_.problem(), x_);
  delassus_.body_velocities(x_, w_);
  return ccp_residual(delassus_, x_, w_, partial_);
}

// Keeps x if it is the best so far and not above the start.
void Asgs::look_single(SolveSummary& summary, double start) {
  const double now = look_single();
  single_.correct(w_);
  objective_ = objective_of_x();
  if (!(now < summary.residual) || objective_ > start) return;
  summary.residual = now;
  std::copy(x_.begin(), x_.end(), x_best_.begin());
}

// Where the next pair starts; false when there is no way on.
bool Asgs::plan_single(bool uphill) {
  if (failures_ < kFailures) {
    if (!uphill && single_.choose()) return true;
    if (uphill) failures_ = kFailures;
    if (!uphill && ++failures_ == kFailures) {
      single_.begin_momentum();
      theta_ = 1.0, beta_ = 0.0;
    }
    return !uphill;
  }
  if (uphill && beta_ == 0.0) return false;
  if (uphill) {
    single_.undo();
    ++undone_;
  }
  plan_momentum(single_.against() > 0.0);
  if (uphill) theta_ = 1.0, beta_ = 0.0;
  single_.set_momentum(beta_);
  return true;
}

// As far as it goes; descend() goes on from there.
void Asgs::descend_single(const SolveContext& context, SolveSummary& summary) {
  const double goal = single_goal(context.tolerance), start = objective_;
  if (!std::isfinite(goal) || context.max_iterations < 2) return;
  single_.start(delassus_.problem(), x_, w_, context.executor);
  double before = start, least = summary.residual;
  int next_look = 2, last_look = 0, found = 0;
  bool going = true, uphill = false, looked = false;
  while (going && summary.residual > goal && summary.iterations + 2 <= context.max_iterations &&
         summary.iterations - found < std::max(kPatience * options_.check_interval, summary.iterations / 2)) {
    const double now = single_.advance(goal);
    const double rounding = kRounding * std::abs(before);
    uphill = !(now <= before + rounding) || (failures_ < kFailures && !single_.step().delivers(before - now, rounding));
    if (!uphill) before = now;
    summary.iterations += 2;
    const bool early =
        single_.missing() > kMany && summary.iterations < last_look + kLooksLeftOut * options_.check_interval;
    looked =
        !uphill && ((summary.iterations >= next_look && !early) || summary.iterations + 2 > context.max_iterations);
    if (looked) {
      look_single(summary, start);
      going = objective_ <= start;
      last_look = summary.iterations;
      next_look = summary.iterations + look_distance(summary, goal);
    }
    if (context.on_iteration) {
      context.on_iteration({summary.iterations - 1, -1.0});
      context.on_iteration({summary.iterations, looked ? summary.residual : std::min(summary.residual, look_single())});
    }
    if (looked && may_finish(context, summary)) finish(context, summary);
    if (summary.residual < least) least = summary.residual, found = summary.iterations;
    going = going && plan_single(uphill);
  }
  if (summary.residual <= context.tolerance) return;
  if (uphill) x_ = x_best_;
  if (!uphill && !looked) single_.impulses(delassus_.problem(), x_);
  meet_x();
  if (objective_ <= start) return;
  x_ = x_best_;
  meet_x();
}

void Asgs::meet_x() {
  delassus_.body_velocities(x_, w_);
  objective_ = objective_of_x();
}

}  // namespace scree
