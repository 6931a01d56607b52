#include "interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/block_cone.hpp"

namespace scree {
namespace {

constexpr int kRefinements = 2;
constexpr int kPatience = 12;
/// Where iterates are close to the answer and to the boundary, steps across it finish the work.
constexpr second_order::PenaltyOptions kFinish{.first = 1e4, .growth = 3.0, .most = 1e6};
constexpr double kShortestStep = 1e-9;
constexpr double kMoreRegularisation = 100.0, kMostRegularisation = 1e-2;

}  // namespace

InteriorPoint::InteriorPoint(const Options& options)
    : InteriorPoint{InteriorPointOptions{.step_fraction = options.number("step_fraction"),
                                         .regularisation = options.number("regularisation")}} {}

std::vector<Parameter> InteriorPoint::parameters() {
  return {
      Parameter::number("step_fraction", "1", "part of the way to the boundary of the cones that a step may go")
          .by_default(0.99)
          .at_least(0.5)
          .at_most(0.9999),
      Parameter::number("regularisation", "1",
                        "proximal term of the Newton matrix, in terms of each contact's own mass")
          .by_default(1e-9)
          .at_least(1e-14)
          .at_most(1e-2),
  };
}

void InteriorPoint::prepare(const CcpProblem& problem, std::span<const double> gamma) {
  problem_ = &problem;
  regularisation_ = options_.regularisation;
  system_.bind(problem);
  weight_.assign(best_.traces().begin(), best_.traces().end());
  for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] /= system_.units()[i].rows;
  for (std::vector<double>* const v : {&change_, &u_, &mismatch_, &rhs_, &left_, &correction_}) {
    v->assign(problem.rows(), 0.0);
  }
  state_.assign(system_.state_size(), 0.0);
  root_.assign(system_.block_numbers(), 0.0);
  c_.assign(system_.block_numbers(), 0.0);
  gamma_.assign(gamma.begin(), gamma.end());
  guess_ = gamma_;
}

// A centred point: impulses that change velocities by about those of r.
void InteriorPoint::start_inside() {
  double sum = 0.0, logs = 0.0, count = 0.0;
  for (const double r : problem_->r) sum += r * r;
  const double speed = sum > 0.0 ? std::sqrt(sum / static_cast<double>(problem_->r.size())) : 1.0;
  std::vector<double>& scale = candidate_;
  scale.assign(weight_.size(), 0.0);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    if (weight_[i] == 0.0) continue;
    scale[i] = speed / weight_[i];
    logs += std::log(weight_[i]);
    count += 1.0;
  }
  barrier_.build(system_.units(), scale, gamma_);
  const double mu = count > 0.0 ? speed * speed * std::exp(-logs / count) : 1.0;
  const std::size_t cones = barrier_.cones.size();
  for (std::vector<Vec3>* const v : {&l_, &ds_, &dz_, &rho_}) v->assign(cones, Vec3{});
  scaling_.assign(cones, {});
  for (std::size_t k = 0; k < cones; ++k) {
    const double s = barrier_.cones[k].of(gamma_).x;
    scaling_[k] = second_order::Scaling({s, 0.0, 0.0}, {mu / s, 0.0, 0.0});
    l_[k] = {std::sqrt(mu), 0.0, 0.0};
  }
}

// u and u - G^T z.
void InteriorPoint::gradient() {
  system_.state_of(gamma_, state_);
  system_.velocities(state_, u_);
  for (std::size_t k = 0; k < u_.size(); ++k) {
    u_[k] += problem_->r[k] + (problem_->compliance.empty() ? 0.0 : problem_->compliance[k] * gamma_[k]);
  }
  std::ranges::fill(mismatch_, 0.0);
  for (std::size_t k = 0; k < l_.size(); ++k) {
    barrier_.cones[k].add_transposed(scaling_[k].over(l_[k]), mismatch_);
  }
  for (std::size_t k = 0; k < u_.size(); ++k) mismatch_[k] = u_[k] - mismatch_[k];
}

// The rows of the Newton matrix's diagonal block of a unit; fixed rows stay out.
second_order::SmallRoot InteriorPoint::root_of(std::size_t i) const {
  const CcpBlock& unit = system_.units()[i];
  second_order::SmallRoot root(unit.rows);
  for (std::size_t row = 0; row < unit.rows; ++row) {
    const std::size_t k = unit.first_row + row;
    const double e = problem_->compliance.empty() ? 0.0 : problem_->compliance[k];
    second_order::SmallRoot::Row x{};
    x[row] = barrier_.fixed[k] ? 1.0 : std::sqrt(regularisation_ * weight_[i] + e);
    root.add(x);
  }
  for (std::uint32_t k = barrier_.first[i]; k < barrier_.first[i + 1]; ++k) {
    const second_order::Cone& cone = barrier_.cones[k];
    // W^-1 G, row by row: W is symmetric.
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 unit_vector;
      unit_vector[axis] = 1.0;
      const Vec3 row = scaling_[k].over(unit_vector);
      second_order::SmallRoot::Row x{};
      x[cone.row[0] - unit.first_row] = cone.factor * row.x;
      if (cone.row[1] != second_order::kNone) x[cone.row[1] - unit.first_row] = row.y;
      if (cone.row[2] != second_order::kNone) x[cone.row[2] - unit.first_row] = row.z;
      root.add(x);
    }
  }
  return root;
}

bool InteriorPoint::factor() {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const std::size_t rows = system_.units()[i].rows, at = system_.block_at(i), first = system_.units()[i].first_row;
    const second_order::SmallRoot root = root_of(i);
    root.store(std::span{root_}.subspan(at, rows * rows));
    root.store_inverse(std::span{c_}.subspan(at, rows * rows));
    for (std::size_t row = 0; row < rows; ++row) {
      if (barrier_.fixed[first + row]) c_[at + row * (rows + 1)] = 0.0;
    }
  }
  return system_.factor(c_);
}

// left_ += (E + regularisation + G^T W^-2 G) change_.
void InteriorPoint::add_barrier_product() {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const std::size_t rows = system_.units()[i].rows, first = system_.units()[i].first_row;
    const double* const r = root_.data() + system_.block_at(i);
    for (std::size_t row = 0; row < rows; ++row) {
      double product = 0.0;
      for (std::size_t column = row; column < rows; ++column)
        product += r[column * rows + row] * change_[first + column];
      for (std::size_t column = row; column < rows; ++column) left_[first + column] += r[column * rows + row] * product;
    }
  }
}

// change_ = (N + E + G^T W^-2 G)^-1 rhs_, refined.
void InteriorPoint::solve_newton() {
  const auto skip_fixed = [&](std::vector<double>& x) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (barrier_.fixed[k]) x[k] = 0.0;
    }
  };
  skip_fixed(rhs_);
  system_.solve_regularised(rhs_, change_);
  for (int pass = 0; pass < kRefinements; ++pass) {
    system_.state_of(change_, state_);
    system_.velocities(state_, left_);
    add_barrier_product();
    for (std::size_t k = 0; k < left_.size(); ++k) left_[k] = rhs_[k] - left_[k];
    skip_fixed(left_);
    system_.solve_regularised(left_, correction_);
    for (std::size_t k = 0; k < left_.size(); ++k) change_[k] += correction_[k];
  }
}

// The greatest step, up to `most`, that stays within the cones: judged where both points are l.
double InteriorPoint::step_length(double most) const {
  double alpha = most;
  for (std::size_t k = 0; k < l_.size(); ++k) {
    alpha = second_order::step_to_boundary(l_[k], ds_[k], alpha);
    alpha = second_order::step_to_boundary(l_[k], dz_[k], alpha);
  }
  return alpha;
}

// rho: l o (W^-1 ds + W dz) = target e - l o l - (W^-1 ds_a) o (W dz_a).
void InteriorPoint::set_target(bool corrector, double target) {
  for (std::size_t k = 0; k < l_.size(); ++k) {
    rho_[k] = -l_[k];
    if (!corrector) continue;
    const Vec3 second = second_order::jordan_product(ds_[k], dz_[k]);
    rho_[k] += second_order::jordan_quotient(l_[k], Vec3{target, 0.0, 0.0} - second);
  }
}

void InteriorPoint::make_directions() {
  for (std::size_t k = 0; k < rhs_.size(); ++k) rhs_[k] = -mismatch_[k];
  for (std::size_t k = 0; k < l_.size(); ++k) {
    barrier_.cones[k].add_transposed(scaling_[k].over(rho_[k]), rhs_);
  }
  solve_newton();
  for (std::size_t k = 0; k < l_.size(); ++k) {
    ds_[k] = scaling_[k].over(barrier_.cones[k].direction(change_));
    dz_[k] = rho_[k] - ds_[k];
  }
}

bool InteriorPoint::iterate() {
  while (!factor()) {
    // N is given with rounding errors of its own: a matrix that is indefinite by those takes a larger regularisation.
    regularisation_ *= kMoreRegularisation;
    if (!(regularisation_ < kMostRegularisation)) return false;
  }
  double mu = 0.0;
  for (const Vec3& l : l_) mu += squared_norm(l);
  mu /= std::max(1.0, static_cast<double>(l_.size()));
  set_target(false, 0.0);
  make_directions();
  const double predicted = step_length(1.0);
  const double left = 1.0 - predicted;
  set_target(true, left * left * left * mu);
  make_directions();
  const double step = std::min(1.0, options_.step_fraction * step_length(1.0 / options_.step_fraction));
  if (!(step > kShortestStep)) return false;
  return advance(step);
}

// Moves everything along. False when a point left its cone, by rounding.
bool InteriorPoint::advance(double step) {
  for (std::size_t k = 0; k < l_.size(); ++k) {
    const Vec3 s = l_[k] + step * ds_[k], z = l_[k] + step * dz_[k];
    if (!(s.x > 0.0 && z.x > 0.0 && second_order::determinant(s) > 0.0 && second_order::determinant(z) > 0.0))
      return false;
    const second_order::Scaling next(s, z);
    const second_order::Scaling both = scaling_[k].followed_by(next);
    // Turned by the product of the scalings, which keeps its lengths: those are known better than the direction.
    const Vec3 exact = next.times(z), turned = both.over(scaling_[k].times(s));
    const double length = std::hypot(exact.y, exact.z), about = std::hypot(turned.y, turned.z);
    const double scale = about > 0.0 ? length / about : 0.0;
    l_[k] = {exact.x, scale * turned.y, scale * turned.z};
    scaling_[k] = both;
  }
  for (std::size_t k = 0; k < gamma_.size(); ++k) gamma_[k] += step * change_[k];
  gradient();
  return true;
}

// The iterations, until the answer is good enough or they lead nowhere.
void InteriorPoint::approach(const SolveContext& context, SolveSummary& summary) {
  start_inside();
  gradient();
  int last_progress = 0;
  while (!best_.done() && summary.iterations < context.max_iterations) {
    const bool moved = iterate();
    const int k = ++summary.iterations;
    candidate_ = gamma_;
    for (const CcpBlock& unit : system_.units()) {
      project_block(unit, std::span{candidate_}.subspan(unit.first_row, unit.rows));  // inside but for rounding
    }
    const double before = best_.residual(), now = best_.offer(candidate_);
    if (best_.residual() < before) last_progress = k;
    if (context.on_iteration) context.on_iteration({k, now});
    if (!moved || k - last_progress > kPatience) return;
  }
}

SolveSummary InteriorPoint::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "interior_point: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!best_.start(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, 0.0};
  if (!best_.done()) {
    prepare(problem, gamma);
    approach(context, summary);
    newton_.run(system_, problem, kFinish, context, gamma, best_, summary);
    // What lies too badly for that is now and then near to be had from the guess.
    if (!best_.done()) newton_.run(system_, problem, {}, context, guess_, best_, summary);
    newton_.insist(system_, problem, context, best_, summary);
  }
  best_.conclude(summary);
  return summary;
}

void InteriorPoint::release_workspace() {
  system_ = {};
  best_ = {};
  newton_ = {};
  barrier_ = {};
  release(weight_, gamma_, guess_, change_, candidate_, u_, mismatch_, l_, ds_, dz_, rho_, scaling_, root_, c_, rhs_,
          left_, correction_, state_);
}

}  // namespace scree
