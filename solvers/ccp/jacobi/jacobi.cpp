#include "jacobi.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/ccp/sweep/stall_watch.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

Jacobi::Jacobi(const Options& options)
    : Jacobi{JacobiOptions{.relaxation = options.number("relaxation"),
                           .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Jacobi::parameters() {
  return {
      Parameter::number("relaxation", "1", "factor on every step; below 2 the objective falls with every iteration")
          .by_default(1.8)
          .above(0.0)
          .at_most(1.9),
      Parameter::integer("check_interval", "iterations between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

bool Jacobi::prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  const bool finite = project_guess(problem, gamma);
  guess_.assign(gamma.begin(), gamma.end());
  if (!finite) return false;
  delassus_.bind(problem, context.executor);
  w_.resize(problem.bodies());
  slots_.resize(delassus_.partition().slot_count());
  delassus_.body_velocities(gamma, w_);
  prepare_steps(problem);
  return true;
}

void Jacobi::prepare_steps(const CcpProblem& problem) {
  units_of_.assign(problem.bodies(), 0.0);
  neighbours_of_.clear();
  for (const CcpContact& c : problem.contacts) ++units_of_[c.a], ++units_of_[c.b];
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    const CcpBlock& block = problem.blocks[k];
    if (!problem.matrix.empty()) {
      neighbours_of_.push_back(problem.matrix.first[k + 1] - problem.matrix.first[k]);
      continue;
    }
    ++units_of_[block.a];
    if (block.b != block.a) ++units_of_[block.b];
  }
  block_steps_.bind(problem, {.relaxation = options_.relaxation}, units_of_, neighbours_of_);
  steps_.resize(problem.contacts.size());
  delassus_.for_chunks(problem.contacts.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      // The block of a problem in which both bodies are as much lighter as they have contacts.
      CcpContact contact = problem.contacts[i];
      const double a = units_of_[contact.a], b = units_of_[contact.b];
      const auto lighter = [](double c, const Mat3& j) { return Mat3{c * j.row0, c * j.row1, c * j.row2}; };
      const std::array<double, 2> mass{a * problem.inverse_mass[contact.a], b * problem.inverse_mass[contact.b]};
      const std::array<Mat3, 2> inertia{lighter(a, problem.inverse_inertia[contact.a]),
                                        lighter(b, problem.inverse_inertia[contact.b])};
      contact.a = 0, contact.b = 1;
      const std::span<const double> compliance =
          problem.compliance.empty() ? std::span<const double>{} : problem.compliance.subspan(3 * i, 3);
      const CcpProblem alone{mass, inertia, {&contact, 1}, problem.r.subspan(3 * i, 3), compliance};
      steps_[i] = sweep::block_step(diagonal_block(alone, 0), contact.friction, options_.relaxation);
    }
  });
}

void Jacobi::advance_contact(std::size_t i, std::span<double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  const SlotPair slot = delassus_.partition().slots()[i];
  const CcpContact& c = problem.contacts[i];
  const Vec3 g = load_block(gamma, i);
  Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]) + load_block(problem.r, i);
  if (!problem.compliance.empty()) u += hadamard(load_block(problem.compliance, i), g);
  const sweep::LocalStep& s = steps_[i];
  const Vec3 trial{g.x - s.normal * u.x, g.y - s.tangent * u.y, g.z - s.tangent * u.z};
  const Vec3 next = project_cone3(trial, c.friction, s.weights);
  store_block(gamma, i, next);
  add_impulse(c, next, slots_[slot.a], slots_[slot.b]);
}

void Jacobi::advance_block(std::size_t k, std::span<const double> before, std::span<double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  const CcpBlock& block = problem.blocks[k];
  const std::span<double> g = rows_of(problem, block, gamma);
  const std::span<const double> r = rows_of(problem, block, problem.r);
  BlockVector u;
  delassus_.block_velocity(k, w_, before, u);
  for (std::size_t i = 0; i < g.size(); ++i) u[i] += r[i];
  block_steps_.advance(k, {u.data(), g.size()}, g);
  if (slots_.empty()) return;  // a matrix
  const SlotPair slot = delassus_.partition().slots()[problem.contacts.size() + k];
  add_impulse(jacobian_of(problem, block), g, slots_[slot.a], slots_[slot.b]);
}

// One step of all contacts and blocks, and the body velocities that belong to it.
void Jacobi::iterate(std::span<double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  std::span<const double> before = gamma;
  if (!problem.matrix.empty()) {
    before_.assign(gamma.begin(), gamma.end());
    before = before_;
  }
  delassus_.for_chunks(slots_.size(), [&](std::size_t first, std::size_t last) {
    std::fill(slots_.data() + first, slots_.data() + last, Twist{});
  });
  delassus_.for_chunks(problem.units(), [&](std::size_t first, std::size_t last) {
    delassus_.for_units(
        first, last, [&](std::size_t i) { advance_contact(i, gamma); },
        [&](std::size_t k) { advance_block(k, before, gamma); });
  });
  if (problem.matrix.empty()) delassus_.reduce_slots(slots_, w_);
}

SolveSummary Jacobi::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "jacobi: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, ccp_residual(delassus_, gamma, w_, partial_)};
  StallWatch watch{problem.r};
  int next_look = 1;
  bool stalled = false;
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations && !stalled) {
    iterate(gamma);
    const int k = ++summary.iterations;
    const bool looking = k >= next_look || k == context.max_iterations;
    if (looking) {
      summary.residual = ccp_residual(delassus_, gamma, w_, partial_);
      next_look = k < options_.check_interval ? 2 * k : k + options_.check_interval;
      stalled = watch.stalled(k, summary.residual);
    }
    if (context.on_iteration) context.on_iteration({k, looking ? summary.residual : -1.0});
  }
  if (stalled) summary.status = SolveStatus::stalled;
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  if (!std::isfinite(summary.residual)) {
    std::copy(guess_.begin(), guess_.end(), gamma.begin());
    summary.status = SolveStatus::numerical_failure;
  }
  return summary;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Jacobi>(
      "jacobi", "Block projected Jacobi: monotone, the simplest parallel method, and slow.",
      scree::Jacobi::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("jacobi", "1.0.0", &list)};
