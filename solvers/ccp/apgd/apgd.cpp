#include "apgd.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

namespace {

constexpr std::size_t kGrain = DelassusOperator::kGrain;

double total(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

// p + beta (p - old).
apgd::Motion beyond(const apgd::Motion& p, const apgd::Motion& old, double beta) {
  return {p.linear + beta * (p.linear - old.linear), p.angular + beta * (p.angular - old.angular)};
}

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

apgd::Motion Apgd::InverseMass::times(const apgd::Motion& p) const {
  const double m = column[0][3];
  const Lanes angular = p.angular[0] * column[0] + p.angular[1] * column[1] + p.angular[2] * column[2];
  return {m * p.linear, Lanes{angular[0], angular[1], angular[2], 0.0}};
}

template <class Body>
void Apgd::for_runs(const Body& body) const {
  static_assert(kGrain % 4 == 0);
  delassus_.for_chunks(delassus_.problem().contacts.size(),
                       [&](std::size_t first, std::size_t last) { body(first, last, first / 4); });
}

// Fills group `at` of the run of contacts first .. last.
void Apgd::prepare_group(std::size_t first, std::size_t last, std::size_t at, double mean,
                         std::span<const double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  const std::size_t quarter = (last - first + 3) / 4;
  apgd::Group& group = groups_[at];
  group = apgd::Group{};
  group.m_n = group.m_t = Lanes{} + 1.0;
  const auto sink = static_cast<std::uint32_t>(delassus_.partition().first_slot().back() + first / kGrain);
  group.a.fill(sink);
  group.b.fill(sink);
  x_[at] = Lanes3{};
  scale_[at] = Lanes{};
  const auto put = [](Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; };
  for (int k = 0; k < 4; ++k) {
    const auto lane = static_cast<std::size_t>(k);
    const std::size_t i = first + lane * quarter + (at - first / 4);
    if (i >= last) break;
    const CcpContact& c = problem.contacts[i];
    put(x_[at], k, load_block(gamma, i));
    group.friction[k] = c.friction;
    const Mat3 block = diagonal_block(problem, i);
    const double d_n = options_.scaled ? block.row0.x : mean;
    const double d_t = options_.scaled ? 0.5 * (block.row1.y + block.row2.z) : mean;
    // Rows that no body can follow keep their impulse: it changes nothing.
    if (!(d_n > 0.0) || !(d_t > 0.0)) continue;
    put(group.normal, k, c.normal);
    put(group.tangent1, k, c.tangent1);
    put(group.arm_a, k, c.arm_a);
    put(group.arm_b, k, c.arm_b);
    put(group.r, k, load_block(problem.r, i));
    group.m_n[k] = 1.0 / d_n, group.m_t[k] = 1.0 / d_t;
    group.a[lane] = delassus_.partition().slots()[i].a;
    group.b[lane] = delassus_.partition().slots()[i].b;
    const double trace = delassus_.traces()[i];
    scale_[at][k] = trace > 0.0 ? 3.0 / trace : 0.0;
    if (!problem.compliance.empty()) put(compliance_[at], k, load_block(problem.compliance, i));
  }
}

void Apgd::prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma) {
  delassus_.bind(problem, context.executor);
  double mean = 0.0;
  for (const double trace : delassus_.traces()) mean += trace;
  mean /= 3.0 * static_cast<double>(problem.contacts.size());
  const std::size_t groups = (problem.contacts.size() + 3) / 4;
  groups_.resize(groups);
  scale_.resize(groups);
  x_.resize(groups);
  x_new_.resize(groups);
  compliance_.assign(problem.compliance.empty() ? 0 : groups, Lanes3{});
  for_runs([&](std::size_t first, std::size_t last, std::size_t group) {
    for (std::size_t at = group; at < group + (last - first + 3) / 4; ++at) {
      prepare_group(first, last, at, mean, gamma);
    }
  });
  x_old_ = x_;
  x_best_ = x_;
  const std::size_t n = problem.bodies(), slots = delassus_.partition().slot_count();
  inverse_mass_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Mat3& j = problem.inverse_inertia[k];
    inverse_mass_[k] = {{Lanes{j.row0.x, j.row1.x, j.row2.x, problem.inverse_mass[k]},
                         Lanes{j.row0.y, j.row1.y, j.row2.y, 0.0}, Lanes{j.row0.z, j.row1.z, j.row2.z, 0.0}}};
  }
  p_.assign(n, apgd::Motion{});
  p_old_.assign(n, apgd::Motion{});
  p_new_.resize(n);
  slot_sums_.assign(slots, apgd::Motion{});
  slot_motion_.assign(slots, apgd::Motion{});
  step_ = 1.0;
  start_objective();
}

// Body sums and objective of the guess: those of a "pass" that ends there.
void Apgd::start_objective() {
  double potential = 0.0;
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    const apgd::Group& group = groups_[at];
    apgd::add_impulses(group, cross(group.normal, group.tangent1), x_[at], slot_sums_.data());
    Lanes sum = dot(group.r, x_[at]);
    if (!compliance_.empty()) sum += 0.5 * dot(x_[at], apgd::hadamard(compliance_[at], x_[at]));
    potential += total(sum);
  }
  const double kinetic = body_pass(0.0, 0.0).quadratic;
  p_ = p_new_;
  p_old_ = p_;
  objective_ = 0.5 * kinetic + potential;
  spread_ = -1.0;
}

// slot_motion_ = M^-1 p(y) of each slot's body.
void Apgd::spread_velocities(double beta) {
  const std::span<const std::uint32_t> first_slot = delassus_.partition().first_slot();
  delassus_.for_chunks(p_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const apgd::Motion w = inverse_mass_[k].times(beyond(p_[k], p_old_[k], beta));
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) slot_motion_[s] = w;
    }
  });
  spread_ = beta;
}

template <bool compliant>
apgd::LaneSums Apgd::contact_range(std::size_t first, std::size_t last, double beta) {
  apgd::LaneSums sums;
  for (std::size_t at = first; at < last; ++at) {
    x_new_[at] = apgd::step<compliant>(groups_[at], compliant ? &compliance_[at] : nullptr, x_[at], x_old_[at], beta,
                                       step_, slot_motion_.data(), slot_sums_.data(), sums);
  }
  return sums;
}

// x_new_ and its sums in slot_sums_, from x_, x_old_ and slot_motion_ = velocities of y.
Apgd::Sums Apgd::contact_pass(double beta) {
  partial_.resize(Executor::chunk_count(delassus_.problem().contacts.size(), kGrain));
  for_runs([&](std::size_t first, std::size_t last, std::size_t group) {
    const std::size_t end = group + (last - first + 3) / 4;
    const apgd::LaneSums s =
        compliance_.empty() ? contact_range<false>(group, end, beta) : contact_range<true>(group, end, beta);
    partial_[first / kGrain] = {total(s.distance), total(s.uphill), total(s.linear), total(s.curvature),
                                total(s.quadratic)};
  });
  Sums sums;
  for (const Sums& s : partial_) sums += s;
  return sums;
}

// p_new_ from slot_sums_, which are cleared; its part of the quadratic forms; and the velocities of the y that follows when
// the step is accepted and the momentum kept.
Apgd::Sums Apgd::body_pass(double beta, double beta_next) {
  const std::span<const std::uint32_t> first_slot = delassus_.partition().first_slot();
  partial_.resize(Executor::chunk_count(p_.size(), kGrain));
  delassus_.for_chunks(p_.size(), [&](std::size_t first, std::size_t last) {
    Lanes quadratic{}, curvature{};
    for (std::size_t k = first; k < last; ++k) {
      apgd::Motion sum{};
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) {
        sum += slot_sums_[s];
        slot_sums_[s] = apgd::Motion{};
      }
      p_new_[k] = sum;
      const InverseMass& inverse = inverse_mass_[k];
      const apgd::Motion v = inverse.times(sum), y = beyond(p_[k], p_old_[k], beta);
      quadratic += sum.linear * v.linear + sum.angular * v.angular;
      const apgd::Motion d{sum.linear - y.linear, sum.angular - y.angular}, e = inverse.times(d);
      curvature += d.linear * e.linear + d.angular * e.angular;
      const apgd::Motion w = inverse.times(beyond(sum, p_[k], beta_next));
      for (std::uint32_t s = first_slot[k]; s < first_slot[k + 1]; ++s) slot_motion_[s] = w;
    }
    partial_[first / kGrain] = {0.0, 0.0, 0.0, total(curvature), total(quadratic)};
  });
  // What was added for immovable bodies.
  std::fill(slot_sums_.begin() + static_cast<std::ptrdiff_t>(first_slot.back()), slot_sums_.end(), apgd::Motion{});
  Sums sums;
  for (const Sums& s : partial_) sums += s;
  return sums;
}

// One accepted step from y; each try is a pass over the contacts. False when the passes ran out before.
bool Apgd::descend(double beta, double beta_next, const SolveContext& context, SolveSummary& summary) {
  while (summary.iterations < context.max_iterations) {
    ++summary.iterations;
    if (spread_ != beta) spread_velocities(beta);
    Sums sums = contact_pass(beta);
    sums += body_pass(beta, beta_next);
    // Differences made of the last bits of the sums tell nothing: no reason to shrink the step.
    const double rounding = 1e-28 * std::abs(sums.quadratic);
    if (step_ * sums.curvature > sums.distance + rounding) {
      spread_ = -1.0;
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
    spread_ = beta_next;
    return true;
  }
  return false;
}

double Apgd::residual_range(std::size_t first, std::size_t last) const {
  const Lanes one = Lanes{} + 1.0, infinite = Lanes{} + std::numeric_limits<double>::infinity();
  Lanes worst{};
  for (std::size_t at = first; at < last; ++at) {
    const apgd::Group& group = groups_[at];
    const Lanes& s = scale_[at];
    Lanes3 u = apgd::contact_velocity(group, cross(group.normal, group.tangent1), slot_motion_.data());
    if (!compliance_.empty()) u = u + apgd::hadamard(compliance_[at], x_[at]);
    const Lanes3 d = x_[at] - apgd::project(x_[at] - s * u, one, one, group.friction);
    const Lanes raw = root(dot(d, d)) / s;
    const Lanes error = raw < infinite ? raw : infinite;
    worst = (s > Lanes{}) & (error > worst) ? error : worst;
  }
  return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

// ccp_residual() of x_.
double Apgd::residual() {
  if (spread_ != 0.0) spread_velocities(0.0);
  residual_partial_.resize(Executor::chunk_count(delassus_.problem().contacts.size(), kGrain));
  for_runs([&](std::size_t first, std::size_t last, std::size_t group) {
    residual_partial_[first / kGrain] = residual_range(group, group + (last - first + 3) / 4);
  });
  return *std::max_element(residual_partial_.begin(), residual_partial_.end());
}

// The residual of x_; keeps it when it is the best so far and not above the start.
void Apgd::look(SolveSummary& summary, double start) {
  const double now = residual();
  if (now < summary.residual && objective_ <= start) {
    summary.residual = now;
    std::copy(x_.begin(), x_.end(), x_best_.begin());
  }
}

void Apgd::unpack(std::span<double> gamma) const {
  for_runs([&](std::size_t first, std::size_t last, std::size_t group) {
    const std::size_t quarter = (last - first + 3) / 4;
    for (std::size_t i = first; i < last; ++i) {
      const Lanes3& x = x_best_[group + (i - first) % quarter];
      const auto k = static_cast<int>((i - first) / quarter);
      store_block(gamma, i, {x.x[k], x.y[k], x.z[k]});
    }
  });
}

SolveSummary Apgd::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "apgd: gamma needs three numbers a contact");
  if (problem.contacts.size() == 0) return {};
  if (!project_guess(problem, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  prepare(problem, context, gamma);
  const double start = objective_ + 1e-14 * std::abs(objective_);  // up to rounding
  SolveSummary summary{SolveStatus::iteration_limit, 0, residual()};
  const double guess_residual = summary.residual;
  // Any step downhill beats the guess, whose residual may be small by accident far away.
  summary.residual = guess_residual <= context.tolerance ? guess_residual : std::numeric_limits<double>::infinity();
  double theta = 1.0, beta = 0.0;
  int next_look = 1;
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    const double theta_next = 0.5 * theta * (std::sqrt(theta * theta + 4.0) - theta);
    const double beta_next = theta * (1.0 - theta) / (theta * theta + theta_next);
    const bool accepted = descend(beta, beta_next, context, summary);
    const bool last = summary.iterations >= context.max_iterations || !accepted;
    const bool looking = summary.iterations >= next_look || last;
    if (looking) {
      look(summary, start);
      next_look = summary.iterations < options_.check_interval ? 2 * summary.iterations
                                                               : summary.iterations + options_.check_interval;
    }
    if (context.on_iteration) {  // watched: what the best iterate would be worth if it were looked at now
      const double best = looking ? summary.residual : std::min(summary.residual, residual());
      context.on_iteration({summary.iterations, best});
    }
    if (!accepted) break;
    theta = theta_next, beta = beta_next;
    if (options_.restart && uphill_ > 0.0) theta = 1.0, beta = 0.0;
    step_ *= options_.growth;
  }
  unpack(gamma);
  if (std::isinf(summary.residual)) summary.residual = guess_residual;  // the guess was not improved on
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  return summary;
}

void Apgd::release_workspace() {
  delassus_ = {};
  release(groups_, compliance_, scale_, x_, x_old_, x_best_, x_new_, inverse_mass_);
  release(p_, p_old_, p_new_, slot_sums_, slot_motion_);
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
