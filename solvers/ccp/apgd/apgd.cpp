#include "apgd.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

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
      Parameter::integer("check_interval", "iterations between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

Apgd::Sums& Apgd::Sums::operator+=(const Sums& o) {
  distance += o.distance;
  uphill += o.uphill;
  linear += o.linear;
  curvature += o.curvature;
  quadratic += o.quadratic;
  return *this;
}

bool Apgd::prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  const std::size_t m = problem.blocks();
  bool finite = true;
  for (const double value : problem.r) finite = finite && std::isfinite(value);
  for (std::size_t i = 0; i < m; ++i) {
    const Vec3 g = load_block(gamma, i);
    store_block(gamma, i, is_finite(g) ? project_cone3(g, problem.contacts[i].friction) : Vec3{});
  }
  if (!finite) return false;

  delassus_.bind(problem, context.executor);
  metric_.resize(m);
  double mean = 0.0;
  for (const double trace : delassus_.traces()) mean += trace;
  mean /= 3.0 * static_cast<double>(m);
  for (std::size_t i = 0; i < m; ++i) {
    const Mat3 block = diagonal_block(problem, i);
    const double d_n = options_.scaled ? block.row0.x : mean;
    const double d_t = options_.scaled ? 0.5 * (block.row1.y + block.row2.z) : mean;
    // Rows that no body can follow keep their impulse: it changes nothing.
    metric_[i] = d_n > 0.0 && d_t > 0.0
                     ? Metric{1.0 / d_n, 1.0 / d_t, cone_weights(d_n, d_t, problem.contacts[i].friction)}
                     : Metric{0.0, 0.0, cone_weights(1.0, 1.0, problem.contacts[i].friction)};
  }
  x_.assign(gamma.begin(), gamma.end());
  x_old_ = x_;
  x_best_ = x_;
  x_new_.resize(x_.size());
  const std::size_t n = problem.bodies();
  p_.resize(n);
  p_new_.resize(n);
  w_.resize(n);
  slots_.resize(delassus_.partition().slot_count());
  step_ = 1.0;

  // Body sums and objective of the guess: those of a "pass" that ends there.
  const bool compliant = !problem.compliance.empty();
  std::fill(slots_.begin(), slots_.end(), Twist{});
  double linear = 0.0, elastic = 0.0;
  for (std::size_t i = 0; i < m; ++i) {
    const SlotPair slot = delassus_.partition().slots()[i];
    const Vec3 x = load_block(x_, i);
    add_impulse(problem.contacts[i], x, slots_[slot.a], slots_[slot.b]);
    linear += dot(load_block(problem.r, i), x);
    if (compliant) elastic += dot(x, hadamard(load_block(problem.compliance, i), x));
  }
  std::fill(p_.begin(), p_.end(), Twist{});
  p_old_ = p_;
  const double kinetic = body_pass(0.0).quadratic;
  p_ = p_new_;
  p_old_ = p_;
  objective_ = 0.5 * (kinetic + elastic) + linear;
  return true;
}

// w_ = M^-1 p(y).
void Apgd::momentum_velocities(double beta) {
  const CcpProblem& problem = delassus_.problem();
  delassus_.for_chunks(problem.bodies(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const Twist y{p_[k].linear + beta * (p_[k].linear - p_old_[k].linear),
                    p_[k].angular + beta * (p_[k].angular - p_old_[k].angular)};
      w_[k] = apply_inverse_mass(problem, k, y);
    }
  });
}

template <bool compliant>
Apgd::Sums Apgd::contact_range(std::size_t first, std::size_t last, double beta, double step) {
  const CcpProblem& problem = delassus_.problem();
  const CcpContact* const contacts = problem.contacts.data();
  const SlotPair* const slots = delassus_.partition().slots().data();
  Sums sums;
  for (std::size_t i = first; i < last; ++i) {
    const CcpContact& c = contacts[i];
    const Metric& metric = metric_[i];
    const Vec3 x = load_block(x_, i), r = load_block(problem.r, i);
    const Vec3 y = x + beta * (x - load_block(x_old_, i));
    Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]) + r;
    Vec3 e;
    if constexpr (compliant) {
      e = load_block(problem.compliance, i);
      u += hadamard(e, y);
    }
    const double s_n = step * metric.normal, s_t = step * metric.tangent;
    const Vec3 next = project_cone3({y.x - s_n * u.x, y.y - s_t * u.y, y.z - s_t * u.z}, c.friction, metric.weights);
    store_block(x_new_, i, next);
    add_impulse(c, next, slots_[slots[i].a], slots_[slots[i].b]);
    if (metric.normal == 0.0) continue;
    const Vec3 d = next - y;
    const double d_n = 1.0 / metric.normal, d_t = 1.0 / metric.tangent;
    const Vec3 scaled{d_n * d.x, d_t * d.y, d_t * d.z};
    sums.distance += dot(d, scaled);
    sums.uphill -= dot(scaled, next - x);
    sums.linear += dot(r, next);
    if constexpr (compliant) {
      sums.curvature += dot(d, hadamard(e, d));
      sums.quadratic += dot(next, hadamard(e, next));
    }
  }
  return sums;
}

// x_new_ and its sums in slots_, from x_, x_old_ and w_ = velocities of y.
Apgd::Sums Apgd::contact_pass(double beta, double step) {
  const std::size_t m = delassus_.problem().blocks();
  const bool compliant = !delassus_.problem().compliance.empty();
  delassus_.for_chunks(slots_.size(), [&](std::size_t first, std::size_t last) {
    std::fill(slots_.data() + first, slots_.data() + last, Twist{});
  });
  partial_.resize(Executor::chunk_count(m, DelassusOperator::kGrain));
  delassus_.for_chunks(m, [&](std::size_t first, std::size_t last) {
    partial_[first / DelassusOperator::kGrain] =
        compliant ? contact_range<true>(first, last, beta, step) : contact_range<false>(first, last, beta, step);
  });
  Sums sums;
  for (const Sums& s : partial_) sums += s;
  return sums;
}

// p_new_ from slots_; its part of the quadratic forms.
Apgd::Sums Apgd::body_pass(double beta) {
  const CcpProblem& problem = delassus_.problem();
  const std::span<const std::uint32_t> first_slot = delassus_.partition().first_slot();
  partial_.resize(Executor::chunk_count(problem.bodies(), DelassusOperator::kGrain));
  delassus_.for_chunks(problem.bodies(), [&](std::size_t first, std::size_t last) {
    Sums sums;
    for (std::size_t k = first; k < last; ++k) {
      Twist sum;
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) sum += slots_[s];
      p_new_[k] = sum;
      const Twist w = apply_inverse_mass(problem, k, sum);
      sums.quadratic += dot(sum.linear, w.linear) + dot(sum.angular, w.angular);
      const Twist d{sum.linear - p_[k].linear - beta * (p_[k].linear - p_old_[k].linear),
                    sum.angular - p_[k].angular - beta * (p_[k].angular - p_old_[k].angular)};
      const Twist v = apply_inverse_mass(problem, k, d);
      sums.curvature += dot(d.linear, v.linear) + dot(d.angular, v.angular);
    }
    partial_[first / DelassusOperator::kGrain] = sums;
  });
  Sums sums;
  for (const Sums& s : partial_) sums += s;
  return sums;
}

// One accepted step from y; each try is a pass over the contacts. False when the passes ran out before.
bool Apgd::descend(double beta, const SolveContext& context, SolveSummary& summary) {
  momentum_velocities(beta);
  while (summary.iterations < context.max_iterations) {
    ++summary.iterations;
    Sums sums = contact_pass(beta, step_);
    sums += body_pass(beta);
    // Differences made of the last bits of the sums tell nothing: no reason to shrink the step.
    const double rounding = 1e-28 * std::abs(sums.quadratic);
    if (step_ * sums.curvature > sums.distance + rounding) {
      step_ = std::min(0.9 * step_, 0.98 * sums.distance / sums.curvature);
      if (!(step_ > 0.0)) return false;
      if (context.on_iteration) context.on_iteration({summary.iterations, -1.0});
      continue;
    }
    objective_ = 0.5 * sums.quadratic + sums.linear;
    uphill_ = sums.uphill;
    x_old_.swap(x_);
    x_.swap(x_new_);
    p_old_.swap(p_);
    p_.swap(p_new_);
    return true;
  }
  return false;
}

double Apgd::residual() {
  momentum_velocities(0.0);
  return ccp_residual(delassus_, x_, w_, residual_partial_);
}

// The residual of x_; keeps it when it is the best so far and not above the start.
void Apgd::look(const SolveContext&, SolveSummary& summary, double start) {
  const double now = residual();
  if (now < summary.residual && objective_ <= start) {
    summary.residual = now;
    std::copy(x_.begin(), x_.end(), x_best_.begin());
  }
}

SolveSummary Apgd::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "apgd: gamma needs three numbers a contact");
  if (problem.blocks() == 0) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  const double start = objective_ + 1e-14 * std::abs(objective_);  // up to rounding
  SolveSummary summary{SolveStatus::iteration_limit, 0, residual()};
  const double guess_residual = summary.residual;
  // Any step downhill beats the guess, whose residual may be small by accident far away.
  summary.residual = guess_residual <= context.tolerance ? guess_residual : std::numeric_limits<double>::infinity();
  double theta = 1.0, beta = 0.0;
  int next_look = 1;
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    const bool accepted = descend(beta, context, summary);
    const bool last = summary.iterations >= context.max_iterations || !accepted;
    const bool looking = summary.iterations >= next_look || last;
    if (looking) {
      look(context, summary, start);
      next_look = summary.iterations < options_.check_interval ? 2 * summary.iterations
                                                               : summary.iterations + options_.check_interval;
    }
    if (context.on_iteration) context.on_iteration({summary.iterations, looking ? summary.residual : -1.0});
    if (!accepted) break;
    const double theta_next = 0.5 * theta * (std::sqrt(theta * theta + 4.0) - theta);
    beta = theta * (1.0 - theta) / (theta * theta + theta_next);
    theta = theta_next;
    if (options_.restart && uphill_ > 0.0) theta = 1.0, beta = 0.0;
    step_ *= options_.growth;
  }
  std::copy(x_best_.begin(), x_best_.end(), gamma.begin());
  if (std::isinf(summary.residual)) summary.residual = guess_residual;  // the guess was not improved on
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
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
