#include "asgs.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/ccp/sweep/stall_watch.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

/// Objectives closer than this share of their size are equal: they are sums of many terms of both signs.
constexpr double kRounding = 1e-13;

double sum_of(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// The inverse of a symmetric positive semi-definite matrix; of a singular one, an inverse on its range.
Mat3 inertia_of(Mat3 j) {
  const double trace = j.row0.x + j.row1.y + j.row2.z;
  if (!(trace > 0.0)) return {};
  const auto determinant = [&] { return dot(j.row0, cross(j.row1, j.row2)); };
  if (determinant() < 1e-24 * trace * trace * trace) {
    const double little = 1e-12 * trace;
    j = j + Mat3::diagonal({little, little, little});
  }
  const double scale = 1.0 / determinant();
  return {scale * cross(j.row1, j.row2), scale * cross(j.row2, j.row0), scale * cross(j.row0, j.row1)};
}

}  // namespace

Asgs::Asgs(const Options& options)
    : Asgs{AsgsOptions{.accelerated = options.boolean("accelerated"),
                       .restart = options.boolean("restart"),
                       .conjugate = options.boolean("conjugate"),
                       .relaxed = options.boolean("relaxed"),
                       .single = options.boolean("single"),
                       .coloured = options.text("order") == "coloured",
                       .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Asgs::parameters() {
  return {
      Parameter::boolean("accelerated", "Nesterov's momentum between the sweeps; false: plain symmetric Gauss-Seidel")
          .by_default(true),
      Parameter::boolean("restart", "drop the momentum when it points against the step").by_default(true),
      Parameter::boolean("conjugate", "begin with conjugate steps in place of Nesterov's, until they fail")
          .by_default(true),
      Parameter::boolean("relaxed", "end with updates of those contacts alone that still miss the tolerance")
          .by_default(true),
      Parameter::boolean("single", "begin in single precision where a problem allows it").by_default(true),
      Parameter::choice("order", {"serial", "coloured"},
                        "order of the contacts in a sweep; coloured lets several threads work, with another result")
          .by_default("serial"),
      Parameter::integer("check_interval", "sweeps between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

bool Asgs::prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  if (!project_guess(problem, gamma)) return false;
  delassus_.bind(problem, context.executor);
  southwell_.bind(delassus_);
  w_.resize(problem.bodies());
  objective_ = delassus_.objective(gamma);
  delassus_.body_velocities(gamma, w_);
  x_.assign(gamma.begin(), gamma.end());
  x_best_ = x_;
  undone_ = 0;
  failures_ = 0;
  next_finish_ = 0;
  return std::isfinite(objective_);
}

// Sweeps in double precision, which begin at x_, whose bodies have the velocities w_.
void Asgs::prepare_sweeps(const CcpProblem& problem) {
  contacts_.bind(problem, {.coloured = options_.coloured});
  contacts_.set_impulses(x_);
  contacts_.set_velocities(w_);
  blocks_.bind(problem, contacts_, {});
  blocks_.set_impulses(x_);
  block_momentum_.start(blocks_);
  history_.assign(contacts_.groups(), History{});
  contacts_.with_layout([&](const auto& layout) {
    for (std::size_t k = 0; k < history_.size(); ++k) history_[k].x_old = layout.impulse(k);
  });
  old_.assign(contacts_.bodies().begin(), contacts_.bodies().end());
  sums_.assign(contacts_.chunks(), AsgsSums{});
  prepare_inertias(problem);
  against_ = 0.0;
  theta_ = 1.0, beta_ = 0.0;
  linear_ = objective_ - kinetic_energy() - block_momentum_.sums(blocks_).linear;
  conjugate_ = takes_conjugate_steps(problem) && failures_ < kFailures;
  if (conjugate_) {
    for (std::size_t k = 0; k < history_.size(); ++k) history_[k].y = history_[k].x_old;
    steps_.start(contacts_.bodies(), linear_ + block_momentum_.sums(blocks_).linear);
  }
}

void Asgs::prepare_inertias(const CcpProblem& problem) {
  inertia_.resize(contacts_.isotropic() ? 0 : problem.bodies());
  for (std::size_t k = 0; k < inertia_.size(); ++k) inertia_[k] = inertia_of(problem.inverse_inertia[k]);
}

// Bodies and blocks go from x to y; x becomes x_old. (Contacts do so one by one, in the forward sweep.)
void Asgs::extrapolate() {
  block_momentum_.extrapolate(blocks_, beta_);
  const std::span<sweep::Body> bodies = contacts_.bodies();
  const double beta = beta_;
  delassus_.for_chunks(bodies.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      // Lanes 3 are constants of the body: their differences are zero.
      const sweep::Body now = bodies[k];
      bodies[k].linear = now.linear + beta * (now.linear - old_[k].linear);
      bodies[k].angular = now.angular + beta * (now.angular - old_[k].angular);
      old_[k] = now;
    }
  });
}

// `start` gives the impulses from which a group starts, and keeps them.
template <class Start>
void Asgs::forward(const Start& start, const Executor* executor) {
  contacts_.with_layout([&](const auto& layout) {
    contacts_.for_chunks(false, executor, [&](std::size_t, std::size_t first, std::size_t last) {
      sweep::for_groups(layout, first, last, false, [&](std::size_t k) {
        Lanes3& g = layout.impulse(k);
        const Lanes3 y = start(history_[k], {g.x, g.y, g.z});
        sweep::store(g, y);
        layout.update(k);
      });
    });
  });
}

void Asgs::backward(const Executor* executor) {
  contacts_.with_layout([&](const auto& layout) {
    contacts_.for_chunks(true, executor, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Lanes against{}, linear{};
      sweep::for_groups(layout, first, last, true, [&](std::size_t k) {
        layout.update(k);
        const Lanes3& g = layout.impulse(k);
        against += layout.metric_product(k, history_[k].y - g, g - history_[k].x_old);
        linear += layout.linear(k);
      });
      sums_[chunk] = {sum_of(against), sum_of(linear)};
    });
  });
}

// From x to the next iterate. The objective is known after both sweeps only.
void Asgs::advance(bool both, const Executor* executor) {
  if (conjugate_) {
    if (steps_.step().far()) keep_x();
    steps_.go(contacts_.bodies(), delassus_);
    block_momentum_.take_conjugate_step(blocks_, steps_.a(), steps_.b());
    blocks_.sweep(false);
    const Lanes a = Lanes{} + steps_.a(), b = Lanes{} + steps_.b();
    forward(
        [a, b](History& history, const Lanes3& z) {
          const Lanes3 y{history.y.x, history.y.y, history.y.z};
          const Lanes3 next = y + a * (z - y) + b * (y - history.x_old);
          sweep::store(history.y, next);
          sweep::store(history.x_old, y);
          return next;
        },
        executor);
  } else {
    extrapolate();
    blocks_.sweep(false);
    const Lanes momentum = Lanes{} + beta_;
    forward(
        [momentum](History& history, const Lanes3& x) {
          const Lanes3 next = x + momentum * (x - history.x_old);
          sweep::store(history.y, next);
          sweep::store(history.x_old, x);
          return next;
        },
        executor);
  }
  if (!both) return;
  backward(executor);
  blocks_.sweep(true);
  const AsgsSums of_blocks = block_momentum_.sums(blocks_);
  against_ = of_blocks.against;
  linear_old_ = linear_;
  linear_ = 0.0;
  for (const AsgsSums& s : sums_) against_ += s.against, linear_ += s.linear;
  const double rows = linear_ + of_blocks.linear;
  objective_ = (conjugate_ ? steps_.measure(contacts_.bodies(), inertia_, delassus_) : kinetic_energy()) + rows;
}

double Asgs::objective() { return kinetic_energy() + block_momentum_.sums(blocks_).linear + linear_; }

// Where the next pair starts.
void Asgs::plan(bool uphill) {
  if (conjugate_) {
    const bool good = !uphill && steps_.choose(linear_ + block_momentum_.sums(blocks_).linear);
    if (good) return;
    steps_.plain();
    conjugate_ = !uphill && ++failures_ < kFailures;
    return;  // momentum starts from none
  }
  plan_momentum(against_ > 0.0);
  if (uphill) theta_ = 1.0, beta_ = 0.0;
}

// Nesterov's next step; none after one that went `against` the momentum.
void Asgs::plan_momentum(bool against) {
  const double next = 0.5 * theta_ * (std::sqrt(theta_ * theta_ + 4.0) - theta_);
  beta_ = options_.accelerated ? theta_ * (1.0 - theta_) / (theta_ * theta_ + next) : 0.0;
  theta_ = next;
  if (options_.restart && against) theta_ = 1.0, beta_ = 0.0;
}

// Whether the last pair ended uphill, or its step did not what it promised; `before` is the objective that it began with.
bool Asgs::failed(double before) const {
  const double rounding = kRounding * std::abs(before);
  return !(objective_ <= before + rounding) || (conjugate_ && !steps_.step().delivers(before - objective_, rounding));
}

// After a pair that failed; `before` is the objective that it began with.
void Asgs::go_back(double before) {
  if (conjugate_) {
    return_to(steps_.step().far() ? x_kept_ : x_best_);
    ++undone_;
  } else if (beta_ > 0.0) {
    undo();
    objective_ = before;
  }
}

void Asgs::keep_x() {
  x_kept_.resize(x_.size());
  contacts_.impulses(x_kept_);
  blocks_.impulses(x_kept_);
}

// What was best at the looks, and what was kept, lies below the start: all pairs before this one went downhill.
void Asgs::return_to(std::span<const double> x) {
  contacts_.set_impulses(x);
  delassus_.body_velocities(x, w_);
  contacts_.set_velocities(w_);
  blocks_.set_impulses(x);
  objective_ = delassus_.objective(x);
  linear_ = objective_ - kinetic_energy() - block_momentum_.sums(blocks_).linear;
}

// Back to where the last pair came from.
void Asgs::undo() {
  contacts_.with_layout([&](const auto& layout) {
    for (std::size_t k = 0; k < history_.size(); ++k) layout.impulse(k) = history_[k].x_old;
  });
  std::copy(old_.begin(), old_.end(), contacts_.bodies().begin());
  block_momentum_.undo(blocks_);
  linear_ = linear_old_;
  ++undone_;
}

// 1/2 w^T M w of the bodies' velocities.
double Asgs::kinetic_energy() {
  const std::span<const sweep::Body> bodies = contacts_.bodies();
  const std::size_t n = w_.size();
  partial_.assign(Executor::chunk_count(n, DelassusOperator::kGrain), 0.0);
  delassus_.for_chunks(n, [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      const Lanes &v = bodies[k].linear, &w = bodies[k].angular;
      if (v[3] > 0.0) sum += (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / v[3];
      const Vec3 angular{w[0], w[1], w[2]};
      if (!inertia_.empty()) {
        sum += dot(angular, inertia_[k] * angular);
      } else if (w[3] > 0.0) {
        sum += squared_norm(angular) / w[3];
      }
    }
    partial_[first / DelassusOperator::kGrain] = 0.5 * sum;
  });
  double total = 0.0;
  for (const double p : partial_) total += p;
  return total;
}

SolveSummary Asgs::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "asgs: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  const double guess_residual = ccp_residual(delassus_, gamma, w_, partial_);
  // Any sweep beats the guess, whose residual may be small by accident far away.
  SolveSummary summary{SolveStatus::iteration_limit, 0, std::numeric_limits<double>::infinity()};
  if (guess_residual <= context.tolerance) summary.residual = guess_residual;
  if (summary.residual > context.tolerance) descend_single(context, summary);
  // After pairs in single precision, one sweep more is not worth a beginning.
  const bool done = summary.iterations > 0 && summary.iterations + 2 > context.max_iterations;
  if (summary.residual > context.tolerance && !done) descend(context, summary);
  std::copy(x_best_.begin(), x_best_.end(), gamma.begin());
  if (std::isinf(summary.residual)) summary.residual = guess_residual;  // no sweep was made
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
}

void Asgs::descend(const SolveContext& context, SolveSummary& summary) {
  const CcpProblem& problem = delassus_.problem();
  if (problem.contacts.size() >= kManyRecords) single_ = {};  // its memory is that of a third of the sweeps to come
  prepare_sweeps(problem);
  StallWatch watch{problem.r};
  int next_look = summary.iterations + 2;
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    const double before = objective_;
    const bool both = summary.iterations + 2 <= context.max_iterations;
    if (!both) beta_ = 0.0, steps_.plain();  // a single sweep is no step that momentum could follow
    advance(both, context.executor);
    const int first = summary.iterations + 1;
    summary.iterations += both ? 2 : 1;
    const bool uphill = both && failed(before);
    if (uphill) go_back(before);
    const bool looking = summary.iterations >= next_look || summary.iterations == context.max_iterations;
    if (looking) {
      look(summary);
      next_look = summary.iterations + look_distance(summary, context.tolerance);
    }
    if (context.on_iteration) {
      if (both) context.on_iteration({first, -1.0});
      // Watched: what the best iterate would be worth if it were looked at now.
      const double best = looking ? summary.residual : std::min(summary.residual, residual(x_));
      context.on_iteration({summary.iterations, best});
    }
    if (looking && may_finish(context, summary)) finish(context, summary);
    if (looking && watch.stalled(summary.iterations, summary.residual)) {
      summary.status = SolveStatus::stalled;
      break;
    }
    plan(uphill);
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Asgs>(
      "asgs", "Accelerated symmetric Gauss-Seidel: fewest passes over the contacts on deep piles.",
      scree::Asgs::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("asgs", "1.0.0", &list)};
