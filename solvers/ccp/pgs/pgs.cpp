#include "pgs.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

Pgs::Pgs(const Options& options)
    : Pgs{PgsOptions{.relaxation = options.number("relaxation"),
                     .scalar_step = options.text("local_step") == "scalar",
                     .coloured = options.text("order") == "coloured",
                     .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Pgs::parameters() {
  return {
      Parameter::number("relaxation", "1", "factor on every local step; above 1 over-relaxes")
          .by_default(1.0)
          .above(0.0)
          .at_most(1.9),
      Parameter::choice("local_step", {"block", "scalar"},
                        "step of a contact from its 3 x 3 block, or one length for its three rows")
          .by_default("block"),
      Parameter::choice("order", {"serial", "coloured"},
                        "order of the contacts in a sweep; coloured lets several threads work, with another result")
          .by_default("serial"),
      Parameter::integer("check_interval", "sweeps between two computations of the residual")
          .by_default(10)
          .at_least(1.0),
  };
}

bool Pgs::prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  const std::size_t m = problem.blocks();
  bool finite = true;
  for (const double value : problem.r) finite = finite && std::isfinite(value);
  for (std::size_t i = 0; i < m; ++i) {
    const Vec3 g = load_block(gamma, i);
    store_block(gamma, i, is_finite(g) ? project_cone3(g, problem.contacts[i].friction) : Vec3{});
  }
  guess_.assign(gamma.begin(), gamma.end());
  if (!finite) return false;

  delassus_.bind(problem, context.executor);
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  prepare_bodies(problem);
  grouping_.build(problem, options_.coloured ? pgs::Colouring::kChunkLength : m);
  prepare_groups(problem, gamma);
  if (options_.coloured) colouring_.build(problem);
  return true;
}

// One body more than there are: empty lanes refer to it. It is immovable.
void Pgs::prepare_bodies(const CcpProblem& problem) {
  const std::size_t n = problem.bodies();
  const auto is_isotropic = [](const Mat3& j) { return j == Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x}); };
  const bool isotropic = std::all_of(problem.inverse_inertia.begin(), problem.inverse_inertia.end(), is_isotropic);
  bodies_.assign(n + 1, pgs::Body{});
  inertias_.assign(isotropic ? 0 : n + 1, pgs::Inertia{});
  for (std::size_t k = 0; k < n; ++k) {
    const auto& [v, w] = w_[k];
    const Mat3& j = problem.inverse_inertia[k];
    bodies_[k].linear = Lanes{v.x, v.y, v.z, problem.inverse_mass[k]};
    bodies_[k].angular = Lanes{w.x, w.y, w.z, isotropic ? j.row0.x : 0.0};
    if (isotropic) continue;
    inertias_[k].column[0] = Lanes{j.row0.x, j.row1.x, j.row2.x, 0.0};
    inertias_[k].column[1] = Lanes{j.row0.y, j.row1.y, j.row2.y, 0.0};
    inertias_[k].column[2] = Lanes{j.row0.z, j.row1.z, j.row2.z, 0.0};
  }
}

void Pgs::prepare_groups(const CcpProblem& problem, std::span<const double> gamma) {
  const auto put = [](Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; };
  const auto nothing = static_cast<std::uint32_t>(problem.bodies());
  groups_.resize(grouping_.groups.size());
  compliance_.assign(problem.compliance.empty() ? 0 : groups_.size(), Lanes3{});
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    pgs::Group& group = groups_[at];
    group = pgs::Group{};
    group.a.fill(nothing);
    group.b.fill(nothing);
    for (int k = 0; k < 4; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      const std::uint32_t i = grouping_.groups[at][lane];
      if (i == pgs::kNoContact) continue;
      const CcpContact& c = problem.contacts[i];
      const Mat3 block = diagonal_block(problem, i);
      const pgs::LocalStep step = options_.scalar_step ? pgs::scalar_step(block, c.friction, options_.relaxation)
                                                       : pgs::block_step(block, c.friction, options_.relaxation);
      put(group.normal, k, c.normal);
      put(group.tangent1, k, c.tangent1);
      put(group.arm_a, k, c.arm_a);
      put(group.arm_b, k, c.arm_b);
      put(group.g, k, load_block(gamma, i));
      put(group.r, k, load_block(problem.r, i));
      group.step_n[k] = step.normal, group.step_t[k] = step.tangent;
      group.along[k] = step.weights.along, group.across[k] = step.weights.across, group.friction[k] = c.friction;
      group.a[lane] = c.a, group.b[lane] = c.b;
      if (!problem.compliance.empty()) put(compliance_[at], k, load_block(problem.compliance, i));
    }
  }
}

template <bool isotropic, bool compliant>
void Pgs::sweep_groups(std::size_t first, std::size_t last) {
  for (std::size_t k = first; k < last; ++k) {
    pgs::update<isotropic, compliant>(groups_[k], compliant ? &compliance_[k] : nullptr, bodies_.data(),
                                      inertias_.data());
  }
}

void Pgs::sweep(const SolveContext& context) {
  const bool isotropic = inertias_.empty(), compliant = !compliance_.empty();
  const auto chunk = [&](std::size_t index) {
    const std::size_t first = grouping_.first[index], last = grouping_.first[index + 1];
    if (isotropic && !compliant) sweep_groups<true, false>(first, last);
    if (isotropic && compliant) sweep_groups<true, true>(first, last);
    if (!isotropic && !compliant) sweep_groups<false, false>(first, last);
    if (!isotropic && compliant) sweep_groups<false, true>(first, last);
  };
  if (!options_.coloured) {
    chunk(0);
    return;
  }
  const auto& chunks = colouring_.chunks();
  const auto& first = colouring_.first();
  const auto run_chunks = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) chunk(chunks[k]);
  };
  for (std::size_t colour = 0; colour + 1 < first.size(); ++colour) {
    const std::size_t begin = first[colour], count = first[colour + 1] - begin;
    if (count == 1 || context.executor == nullptr || context.executor->threads() == 1) {
      run_chunks(begin, begin + count);
    } else {
      context.executor->for_chunks(count, 1, [&](std::size_t a, std::size_t b) { run_chunks(begin + a, begin + b); });
    }
  }
  run_chunks(first.back(), chunks.size());
}

double Pgs::residual(std::span<double> gamma) {
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    const Lanes3& g = groups_[at].g;
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i != pgs::kNoContact) store_block(gamma, i, {g.x[k], g.y[k], g.z[k]});
    }
  }
  for (std::size_t k = 0; k < w_.size(); ++k) {
    const pgs::Body& body = bodies_[k];
    w_[k] = {{body.linear[0], body.linear[1], body.linear[2]}, {body.angular[0], body.angular[1], body.angular[2]}};
  }
  return ccp_residual(delassus_, gamma, w_, partial_);
}

SolveSummary Pgs::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "pgs: gamma needs three numbers a contact");
  if (problem.blocks() == 0) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, residual(gamma)};
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    sweep(context);
    const int k = ++summary.iterations;
    // Sparse flows and warm starts are done after a sweep or two: look at the powers of two as well.
    const bool look = k % options_.check_interval == 0 || k == context.max_iterations ||
                      (k < options_.check_interval && (k & (k - 1)) == 0);
    if (look) summary.residual = residual(gamma);
    if (context.on_iteration) context.on_iteration({k, look ? summary.residual : -1.0});
  }
  // The velocities were summed up update by update; the answer is judged from the impulses alone.
  delassus_.body_velocities(gamma, w_);
  summary.residual = ccp_residual(delassus_, gamma, w_, partial_);
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
  plugins.add<scree::CcpSolver, scree::Pgs>("pgs", "Block projected Gauss-Seidel: robust, monotone, cheap per sweep.",
                                            scree::Pgs::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("pgs", "1.0.0", &list)};
