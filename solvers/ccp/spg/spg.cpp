#include "spg.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

/// Safeguards of the spectral step [1], in units where the diagonal of N is one.
constexpr double kShortest = 1e-8, kLongest = 1e8;
/// Looks after which the body velocities are made anew: they gather the rounding of all steps.
constexpr int kLooksToRefresh = 10;

SpgOptions::Scaling scaling_of(std::string_view name) {
  return name == "block"     ? SpgOptions::Scaling::block
         : name == "contact" ? SpgOptions::Scaling::contact
                             : SpgOptions::Scaling::none;
}

SpgOptions::Step step_of(std::string_view name) {
  return name == "bb1" ? SpgOptions::Step::bb1 : name == "bb2" ? SpgOptions::Step::bb2 : SpgOptions::Step::alternating;
}

}  // namespace

Spg::Spg(const Options& options)
    : Spg{SpgOptions{.scaling = scaling_of(options.text("scaling")),
                     .step = step_of(options.text("step")),
                     .memory = static_cast<int>(options.integer("memory")),
                     .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Spg::parameters() {
  return {
      Parameter::choice("scaling", {"block", "contact", "none"},
                        "measure each contact in its own two masses (normal, tangents), in their mean, or all in one")
          .by_default("block"),
      Parameter::choice("step", {"bb1", "bb2", "alternating"},
                        "spectral step of Barzilai and Borwein: the long one, the short one, or one after the other")
          .by_default("alternating"),
      Parameter::integer("memory", "iterates that the line search compares with; 1 makes it monotone")
          .by_default(10)
          .at_least(1.0)
          .at_most(1000.0),
      Parameter::integer("check_interval", "iterations between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

Spg::Sums& Spg::Sums::operator+=(const Sums& o) {
  slope += o.slope;
  distance += o.distance;
  curvature += o.curvature;
  return *this;
}

bool Spg::prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  if (!project_guess(problem, gamma)) return false;
  delassus_.bind(problem, context.executor);
  prepare_metric(problem);
  x_.assign(gamma.begin(), gamma.end());
  x_best_ = x_;
  d_.assign(x_.size(), 0.0);
  w_.resize(problem.bodies());
  v_.resize(problem.bodies());
  slots_.resize(delassus_.partition().slot_count());
  search_.start(options_.memory);
  alpha_ = 1.0;
  looks_ = 0;
  refresh();
  return true;
}

void Spg::prepare_metric(const CcpProblem& problem) {
  const std::size_t m = problem.contacts.size();
  metric_.resize(m);
  double mean = 0.0;
  for (const double trace : delassus_.traces()) mean += trace;
  mean /= 3.0 * static_cast<double>(m);
  for (std::size_t i = 0; i < m; ++i) {
    double d_n = mean, d_t = mean;
    if (options_.scaling == SpgOptions::Scaling::contact) d_n = d_t = delassus_.traces()[i] / 3.0;
    if (options_.scaling == SpgOptions::Scaling::block) {
      const Mat3 block = diagonal_block(problem, i);
      d_n = block.row0.x, d_t = 0.5 * (block.row1.y + block.row2.z);
    }
    const double mu = problem.contacts[i].friction;
    // Rows that no body can follow keep their impulse: it changes nothing.
    const bool movable = d_n > 0.0 && d_t > 0.0;
    metric_[i] = movable ? Metric{1.0 / d_n, 1.0 / d_t, cone_weights(d_n, d_t, mu)}
                         : Metric{0.0, 0.0, cone_weights(1.0, 1.0, mu)};
  }
}

template <bool compliant>
Spg::Sums Spg::contact_range(std::size_t first, std::size_t last) {
  const CcpProblem& problem = delassus_.problem();
  const CcpContact* const contacts = problem.contacts.data();
  const SlotPair* const slots = delassus_.partition().slots().data();
  Sums sums;
  for (std::size_t i = first; i < last; ++i) {
    const CcpContact& c = contacts[i];
    const Metric& metric = metric_[i];
    const Vec3 x = load_block(x_, i) + pending_ * load_block(d_, i);
    store_block(x_, i, x);
    Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]) + load_block(problem.r, i);
    Vec3 e;
    if constexpr (compliant) {
      e = load_block(problem.compliance, i);
      u += hadamard(e, x);
    }
    const double s_n = alpha_ * metric.normal, s_t = alpha_ * metric.tangent;
    const Vec3 next = project_cone3({x.x - s_n * u.x, x.y - s_t * u.y, x.z - s_t * u.z}, c.friction, metric.weights);
    const Vec3 d = next - x;
    store_block(d_, i, d);
    add_impulse(c, d, slots_[slots[i].a], slots_[slots[i].b]);
    if (metric.normal == 0.0) continue;
    sums.slope += dot(u, d);
    sums.distance += d.x * d.x / metric.normal + (d.y * d.y + d.z * d.z) / metric.tangent;
    if constexpr (compliant) sums.curvature += dot(d, hadamard(e, d));
  }
  return sums;
}

// Moves x by what is pending; makes d and its sums in slots_ from w.
Spg::Sums Spg::contact_pass() {
  const std::size_t m = delassus_.problem().contacts.size();
  const bool compliant = !delassus_.problem().compliance.empty();
  delassus_.for_chunks(slots_.size(), [&](std::size_t first, std::size_t last) {
    std::fill(slots_.data() + first, slots_.data() + last, Twist{});
  });
  sums_.resize(Executor::chunk_count(m, DelassusOperator::kGrain));
  delassus_.for_chunks(m, [&](std::size_t first, std::size_t last) {
    sums_[first / DelassusOperator::kGrain] =
        compliant ? contact_range<true>(first, last) : contact_range<false>(first, last);
  });
  pending_ = 0.0;
  Sums sums;
  for (const Sums& s : sums_) sums += s;
  return sums;
}

// v from slots_; returns v^T M v [J].
double Spg::body_pass() {
  const CcpProblem& problem = delassus_.problem();
  const std::span<const std::uint32_t> first_slot = delassus_.partition().first_slot();
  partial_.resize(Executor::chunk_count(problem.bodies(), DelassusOperator::kGrain));
  delassus_.for_chunks(problem.bodies(), [&](std::size_t first, std::size_t last) {
    double energy = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      Twist sum;
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) sum += slots_[s];
      v_[k] = apply_inverse_mass(problem, k, sum);
      energy += dot(sum.linear, v_[k].linear) + dot(sum.angular, v_[k].angular);
    }
    partial_[first / DelassusOperator::kGrain] = energy;
  });
  double total = 0.0;
  for (const double p : partial_) total += p;
  return total;
}

// (N d)^T D^-1 (N d) [J].
double Spg::product_norm() {
  const CcpProblem& problem = delassus_.problem();
  partial_.resize(Executor::chunk_count(problem.contacts.size(), DelassusOperator::kGrain));
  delassus_.for_chunks(problem.contacts.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const CcpContact& c = problem.contacts[i];
      Vec3 y = relative_velocity(c, v_[c.a], v_[c.b]);
      if (!problem.compliance.empty()) y += hadamard(load_block(problem.compliance, i), load_block(d_, i));
      sum += metric_[i].normal * y.x * y.x + metric_[i].tangent * (y.y * y.y + y.z * y.z);
    }
    partial_[first / DelassusOperator::kGrain] = sum;
  });
  double total = 0.0;
  for (const double p : partial_) total += p;
  return total;
}

// One step; x follows in the next pass or in finish_step(). False when there is no direction downhill.
bool Spg::iterate(int iteration) {
  Sums sums = contact_pass();
  // A projection's slope is at least this steep. Near the answer u^T d itself drowns in the rounding of x: d is of the order
  // of the residual, but known to the last bits of x only, and u is of any size.
  sums.slope = std::min(sums.slope, -sums.distance / alpha_);
  if (!(sums.slope < 0.0)) {
    if (fresh_) return false;
    refresh();  // rounding of the velocities may hide the way down
    return true;
  }
  sums.curvature += body_pass();
  pending_ = search_.step(sums.slope, sums.curvature);
  delassus_.for_chunks(w_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      w_[k].linear += pending_ * v_[k].linear;
      w_[k].angular += pending_ * v_[k].angular;
    }
  });
  fresh_ = false;
  const bool second =
      options_.step == SpgOptions::Step::bb2 || (options_.step == SpgOptions::Step::alternating && iteration % 2 == 0);
  const double ratio = second ? sums.curvature / product_norm() : sums.distance / sums.curvature;
  alpha_ = std::isfinite(ratio) ? std::clamp(ratio, kShortest, kLongest) : kLongest;
  return true;
}

void Spg::finish_step() {
  delassus_.for_chunks(x_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) x_[k] += pending_ * d_[k];
  });
  pending_ = 0.0;
}

// w from x alone.
void Spg::refresh() {
  finish_step();
  delassus_.body_velocities(x_, w_);
  fresh_ = true;
}

// The residual of x [m/s]; x is kept when it is the best so far and not above the start.
double Spg::look(SolveSummary& summary, double tolerance) {
  finish_step();
  if (++looks_ % kLooksToRefresh == 0) refresh();
  double now = ccp_residual(delassus_, x_, w_, partial_);
  if (now <= tolerance && !fresh_) {
    refresh();  // the answer is judged from the impulses alone
    now = ccp_residual(delassus_, x_, w_, partial_);
  }
  if (now < summary.residual && search_.change() <= 0.0) {
    summary.residual = now;
    std::copy(x_.begin(), x_.end(), x_best_.begin());
  }
  return now;
}

SolveSummary Spg::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "spg: gamma needs three numbers a contact");
  if (problem.contacts.size() == 0) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  const double guess_residual = ccp_residual(delassus_, x_, w_, partial_);
  // Any step downhill beats the guess, whose residual may be small by accident far away.
  SolveSummary summary{SolveStatus::iteration_limit, 0, std::numeric_limits<double>::infinity()};
  if (guess_residual <= context.tolerance) summary.residual = guess_residual;
  int next_look = 1;
  bool moving = true;
  while (moving && summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    const int k = ++summary.iterations;
    moving = iterate(k);
    const bool looking = k >= next_look || k == context.max_iterations || !moving;
    if (looking) {
      look(summary, context.tolerance);
      next_look = k < options_.check_interval ? 2 * k : k + options_.check_interval;
    }
    if (context.on_iteration) context.on_iteration({k, looking ? summary.residual : -1.0});
  }
  if (!moving) summary.status = SolveStatus::stalled;
  // Judged from the impulses alone, as the caller would.
  x_.swap(x_best_);
  refresh();
  summary.residual = std::isinf(summary.residual) ? guess_residual : ccp_residual(delassus_, x_, w_, partial_);
  std::copy(x_.begin(), x_.end(), gamma.begin());
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Spg>("spg", "Spectral projected gradient: one light pass an iteration.",
                                            scree::Spg::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("spg", "1.0.0", &list)};
