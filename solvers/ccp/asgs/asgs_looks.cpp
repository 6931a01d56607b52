// Looks of asgs at the residual, and what follows from them.
#include <algorithm>

#include "asgs.hpp"
#include "scree/ccp/judge.hpp"

namespace scree {
namespace {

/// A look costs two sweeps. With the residual above the tolerance by this factor, so many times the interval goes without one, but at
/// most half of the sweeps made.
constexpr double kFar = 10.0;
constexpr int kFarFactor = 3;
/// Single contacts end the solve at this share of the tolerance, in at most so many passes. If they do not, there must be this share
/// of sweeps more before they try again.
constexpr double kTarget = 0.9;
constexpr int kPasses = 2;
constexpr double kPatience = 0.25;

}  // namespace

// The velocities were summed up update by update: the residual is that of the impulses alone.
double Asgs::residual(std::span<double> gamma) {
  contacts_.impulses(gamma);
  blocks_.impulses(gamma);
  delassus_.body_velocities(gamma, w_);
  return ccp_residual(delassus_, gamma, w_, partial_);
}

// Gives the bodies and rows of x the velocities w_ that its impulses have, without what rounding added, and those of x_old
// the same correction, so that the momentum stays.
void Asgs::refresh() {
  const std::span<sweep::Body> bodies = contacts_.bodies();
  if (conjugate_) {
    std::copy(bodies.begin(), bodies.end(), old_.begin());  // free for this
    contacts_.set_velocities(w_);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      steps_.correct(k, bodies[k].linear - old_[k].linear, bodies[k].angular - old_[k].angular);
    }
  } else {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      old_[k].linear -= bodies[k].linear;
      old_[k].angular -= bodies[k].angular;
    }
    contacts_.set_velocities(w_);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      old_[k].linear += bodies[k].linear;
      old_[k].angular += bodies[k].angular;
    }
  }
  block_momentum_.refresh(blocks_, x_);
  objective_ = objective();
}

// Keeps x if it is the best so far.
void Asgs::look(SolveSummary& summary) {
  const double now = residual(x_);
  refresh();
  if (now < summary.residual) {
    summary.residual = now;
    std::copy(x_.begin(), x_.end(), x_best_.begin());
  }
}

// Sweeps to the next look.
int Asgs::look_distance(const SolveSummary& summary, double tolerance) const {
  if (summary.iterations < options_.check_interval) return summary.iterations;
  const int far = summary.residual > kFar * tolerance ? kFarFactor * options_.check_interval : 0;
  return std::max(options_.check_interval, std::min(far, summary.iterations / 2));
}

bool Asgs::may_finish(const SolveContext& context, const SolveSummary& summary) const {
  return options_.relaxed && delassus_.problem().matrix.empty() && summary.iterations >= next_finish_ &&
         summary.residual > context.tolerance && summary.iterations < context.max_iterations;
}

// Updates those units of x that miss the tolerance; the sweeps go on from where they were if that is not enough.
void Asgs::finish(const SolveContext& context, SolveSummary& summary) {
  const std::size_t units = delassus_.problem().units();
  const auto passes = static_cast<std::size_t>(std::min(kPasses, context.max_iterations - summary.iterations));
  const Southwell::Outcome outcome = southwell_.relax(x_, w_, kTarget * context.tolerance, passes * units);
  if (outcome.visits == 0) return;
  const int last = summary.iterations + static_cast<int>((outcome.visits + units - 1) / units);
  delassus_.body_velocities(x_, w_);
  const double now = ccp_residual(delassus_, x_, w_, partial_);
  if (now < summary.residual) {
    summary.residual = now;
    std::copy(x_.begin(), x_.end(), x_best_.begin());
  }
  while (summary.iterations < last) {
    ++summary.iterations;
    if (context.on_iteration)
      context.on_iteration({summary.iterations, summary.iterations < last ? -1.0 : summary.residual});
  }
  next_finish_ = static_cast<int>((1.0 + kPatience) * summary.iterations);
}

}  // namespace scree
