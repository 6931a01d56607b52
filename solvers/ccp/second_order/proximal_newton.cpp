#include "proximal_newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scree/ccp/block_cone.hpp"
#include "small_root.hpp"

namespace scree::second_order {
namespace {

/// Part of an outer step that the inner problem may leave unsolved.
constexpr double kInnerAccuracy = 0.1;
/// The line search ends where the slope has fallen to this part; trials at most.
constexpr double kSlopeLeft = 0.3;
constexpr int kTrials = 30;
/// Rounding errors of velocities, times the penalty, shall stay this part of the tolerance; but the penalty not below the least.
constexpr double kRoundingShare = 0.1, kLeastPenalty = 10.0;
/// Iterations without a better residual until it is said to stall.
constexpr int kPatience = 60;
/// What is tried from the best answer when all else has stalled: stiff at once, slowly stiffer, soft, beyond what rounding should allow.
constexpr std::array<PenaltyOptions, 4> kInsistence{
    {{1e4, 3.0, 1e6}, {10.0, 3.0, 1e5}, {0.1, 2.0, 1e4}, {1e6, 10.0, 1e11, false}}};

double dot_product(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

// The state that belongs to the centre.
void ProximalNewton::restart() {
  system_->state_of(centre_, z_);
  system_->velocities(z_, u_);
  for (std::size_t k = 0; k < u_.size(); ++k) {
    v_[k] = compliance(k) * centre_[k];
    u_[k] += v_[k] + problem_->r[k];
  }
}

// p_ for the state moved by step times the direction.
void ProximalNewton::project(double step) {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    if (weight_[i] == 0.0) continue;
    const CcpBlock& unit = system_->units()[i];
    for (std::size_t k = unit.first_row; k < unit.first_row + unit.rows; ++k) {
      a_[k] = p_[k] = centre_[k] - sigma_ / weight_[i] * (u_[k] + step * du_[k]);
    }
    project_block(unit, std::span{p_}.subspan(unit.first_row, unit.rows));
  }
}

// phi'(step) along the direction.
double ProximalNewton::slope(double step, double constant, double linear) {
  project(step);
  return constant + step * linear - dot_product(du_, p_);
}

// (z, v) . (dz, dv) in phi's quadratic part [J].
double ProximalNewton::state_product(std::span<const double> z, std::span<const double> v) const {
  // With a matrix the velocities of dz are what du holds beside dv.
  double sum = system_->inner(z, dz_, rows_);
  for (std::size_t k = 0; !problem_->compliance.empty() && k < v.size(); ++k) {
    if (compliance(k) > 0.0) sum += v[k] * dv_[k] / compliance(k);
  }
  return sum;
}

// The length of the step, near the zero of the slope, which only grows.
double ProximalNewton::search(double slope_at_zero) {
  const double constant = state_product(z_, v_), linear = state_product(dz_, dv_);
  double low = 0.0, high = 1.0, at_low = slope_at_zero;
  double at_high = slope(1.0, constant, linear);
  if (at_high <= kSlopeLeft * std::abs(slope_at_zero)) return 1.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double share = std::clamp(at_low / (at_low - at_high), 0.05, 0.95);
    const double step = low + share * (high - low);
    const double now = slope(step, constant, linear);
    if (std::abs(now) <= kSlopeLeft * std::abs(slope_at_zero)) return step;
    if (now < 0.0) {
      low = step, at_low = now;
    } else {
      high = step, at_high = now;
    }
  }
  project(low);
  return low;
}

// C of B' = (B^-1 + E)^-1 from C of B: C R^-1 with R^T R = I + C^T E C.
void ProximalNewton::soften(std::size_t i, std::span<double> c) const {
  const std::size_t n = system_->units()[i].rows, first = system_->units()[i].first_row;
  SmallRoot root(n);
  for (std::size_t row = 0; row < n; ++row) {
    SmallRoot::Row one{}, soft{};
    one[row] = 1.0;
    for (std::size_t j = 0; j < n; ++j) soft[j] = std::sqrt(compliance(first + row)) * c[j * n + row];
    root.add(one);
    root.add(soft);
  }
  std::array<double, CcpBlock::kMostRows * CcpBlock::kMostRows> inverse, old;
  root.store_inverse(std::span{inverse}.first(n * n));
  std::ranges::copy(c, old.begin());
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t row = 0; row < n; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k <= j; ++k) sum += old[k * n + row] * inverse[j * n + k];
      c[j * n + row] = sum;
    }
  }
}

// Roots of B' where p_ and a_ are.
void ProximalNewton::differentiate() {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    if (weight_[i] == 0.0) continue;
    const CcpBlock& unit = system_->units()[i];
    const double t = weight_[i] / sigma_;
    const std::span<double> root = std::span{c_}.subspan(system_->block_at(i), std::size_t{unit.rows} * unit.rows);
    direct::projection_derivative(unit, {t, t, t, t}, std::span{a_}.subspan(unit.first_row, unit.rows),
                                  std::span{p_}.subspan(unit.first_row, unit.rows), root);
    if (!problem_->compliance.empty()) soften(i, root);
  }
}

// out = B' x.
void ProximalNewton::apply_roots(std::span<const double> x, std::span<double> out) const {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const std::size_t n = system_->units()[i].rows, first = system_->units()[i].first_row;
    const double* const c = c_.data() + system_->block_at(i);
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(first), n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      const double along = dot_product({c + j * n, n}, x.subspan(first, n));
      for (std::size_t row = 0; row < n; ++row) out[first + row] += c[j * n + row] * along;
    }
  }
}

// False when there is no way down.
bool ProximalNewton::newton_step() {
  differentiate();
  if (!system_->factor(c_)) return false;
  const bool compliant = !problem_->compliance.empty();
  if (compliant) {
    apply_roots(w_, rows_);
    system_->state_of(rows_, state_);
    for (std::size_t k = 0; k < q_.size(); ++k) state_[k] = q_[k] - state_[k];
  }
  system_->newton_direction(compliant ? state_ : q_, dz_);
  system_->velocities(dz_, rows_);
  if (compliant) {
    for (std::size_t k = 0; k < du_.size(); ++k) du_[k] = rows_[k] - w_[k];
    apply_roots(du_, dv_);
    for (std::size_t k = 0; k < dv_.size(); ++k) dv_[k] = -w_[k] - compliance(k) * dv_[k];
  }
  for (std::size_t k = 0; k < du_.size(); ++k) du_[k] = rows_[k] + dv_[k];
  const double slope_at_zero = state_product(q_, w_);
  if (!(slope_at_zero < 0.0)) return false;
  const double step = search(slope_at_zero);
  for (std::size_t k = 0; k < z_.size(); ++k) z_[k] += step * dz_[k];
  for (std::size_t k = 0; k < u_.size(); ++k) {
    u_[k] += step * du_[k];
    v_[k] += step * dv_[k];
  }
  std::ranges::fill(du_, 0.0);
  return step > 0.0;
}

// Whether p_ solves the inner problem well enough. Makes the mismatches.
bool ProximalNewton::is_solved(double tolerance) {
  system_->state_of(p_, q_);
  for (std::size_t k = 0; k < q_.size(); ++k) q_[k] = z_[k] - q_[k];
  for (std::size_t k = 0; k < w_.size(); ++k) w_[k] = v_[k] - compliance(k) * p_[k];
  system_->velocities(q_, rows_);
  double inner = 0.0, outer = 0.0;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_->units()[i];
    double in = 0.0, out = 0.0;
    for (std::size_t k = unit.first_row; k < unit.first_row + unit.rows; ++k) {
      in += (rows_[k] + w_[k]) * (rows_[k] + w_[k]);
      out += (p_[k] - centre_[k]) * (p_[k] - centre_[k]);
    }
    inner = std::max(inner, std::sqrt(in));
    outer = std::max(outer, std::sqrt(out) * weight_[i] / sigma_);
  }
  return inner <= std::max(kInnerAccuracy * outer, 0.1 * tolerance);
}

// The largest penalty whose rounding errors the tolerance allows.
double ProximalNewton::bounded(double sigma, double tolerance) const {
  double speed = 0.0;
  for (const double r : problem_->r) speed = std::max(speed, std::abs(r));
  const double rounding = speed * std::numeric_limits<double>::epsilon();
  return rounding > 0.0 ? std::min(sigma, std::max(kLeastPenalty, kRoundingShare * tolerance / rounding)) : sigma;
}

void ProximalNewton::run(direct::DirectSystem& system, const CcpProblem& problem, const PenaltyOptions& options,
                         const SolveContext& context, std::span<const double> start, direct::BestAnswer& best,
                         SolveSummary& summary) {
  system_ = &system;
  problem_ = &problem;
  weight_.assign(best.traces().begin(), best.traces().end());
  for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] /= system.units()[i].rows;
  for (std::vector<double>* const x : {&v_, &w_, &dv_, &u_, &du_, &a_, &rows_}) x->assign(problem.rows(), 0.0);
  for (std::vector<double>* const x : {&z_, &q_, &dz_, &state_}) x->assign(system.state_size(), 0.0);
  c_.assign(system.block_numbers(), 0.0);
  centre_.assign(start.begin(), start.end());
  p_ = centre_;
  sigma_ = options.bounded ? bounded(options.first, context.tolerance) : options.first;
  const double most = options.bounded ? bounded(options.most, context.tolerance) : options.most;
  restart();
  project(0.0);
  int last_progress = summary.iterations;
  double least = std::numeric_limits<double>::infinity();
  while (!best.done() && summary.iterations < context.max_iterations) {
    if (is_solved(context.tolerance)) {
      centre_ = p_;
      sigma_ = std::min(options.growth * sigma_, most);
      restart();
      project(0.0);
      is_solved(context.tolerance);
    }
    const bool moved = newton_step();
    const int k = ++summary.iterations;
    const double now = best.offer(p_);
    if (now < least)
      least = now, last_progress = k;  // of this run, which may come from farther away than the best answer
    if (context.on_iteration) context.on_iteration({k, now});
    if (!moved || k - last_progress > kPatience) {
      summary.status = SolveStatus::stalled;
      return;
    }
  }
}

void ProximalNewton::insist(direct::DirectSystem& system, const CcpProblem& problem, const SolveContext& context,
                            direct::BestAnswer& best, SolveSummary& summary) {
  for (const PenaltyOptions& options : kInsistence) {
    double before = std::numeric_limits<double>::infinity();
    while (!best.done() && best.residual() < 0.5 * before && summary.iterations < context.max_iterations) {
      before = best.residual();
      run(system, problem, options, context, best.gamma(), best, summary);
    }
  }
}

}  // namespace scree::second_order
