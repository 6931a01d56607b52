#include "pgs.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/ccp/sweep/stall_watch.hpp"
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
  const bool finite = project_guess(problem, gamma);
  guess_.assign(gamma.begin(), gamma.end());
  if (!finite) return false;

  delassus_.bind(problem, context.executor);
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  contacts_.bind(problem, {options_.coloured, options_.scalar_step, options_.relaxation});
  contacts_.set_impulses(gamma);
  contacts_.set_velocities(w_);
  blocks_.bind(problem, contacts_, {options_.scalar_step, options_.relaxation});
  blocks_.set_impulses(gamma);
  return true;
}

void Pgs::sweep(const Executor* executor) {
  blocks_.sweep(false);
  contacts_.with_layout([&](const auto& layout) {
    contacts_.for_chunks(false, executor, [&](std::size_t, std::size_t first, std::size_t last) {
      sweep::for_groups(layout, first, last, false, [&](std::size_t k) { layout.update(k); });
    });
  });
}

double Pgs::residual(std::span<double> gamma) {
  contacts_.impulses(gamma);
  blocks_.impulses(gamma);
  contacts_.velocities(w_);
  return ccp_residual(delassus_, gamma, w_, partial_);
}

// The velocities were summed up update by update: an answer is judged from the impulses alone.
double Pgs::refreshed_residual(std::span<double> gamma) {
  delassus_.body_velocities(gamma, w_);
  contacts_.set_velocities(w_);
  blocks_.set_impulses(gamma);
  return ccp_residual(delassus_, gamma, w_, partial_);
}

SolveSummary Pgs::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "pgs: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!prepare(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, residual(gamma)};
  StallWatch watch{problem.r};
  while (summary.residual > context.tolerance && summary.iterations < context.max_iterations) {
    sweep(context.executor);
    const int k = ++summary.iterations;
    // Sparse flows and warm starts are done after a sweep or two: look at the powers of two as well.
    const bool look = k % options_.check_interval == 0 || k == context.max_iterations ||
                      (k < options_.check_interval && (k & (k - 1)) == 0);
    if (look) {
      summary.residual = residual(gamma);
      if (summary.residual <= context.tolerance || k == context.max_iterations) {
        summary.residual = refreshed_residual(gamma);
      }
    }
    if (context.on_iteration) context.on_iteration({k, look ? summary.residual : residual(gamma)});
    if (look && summary.residual > context.tolerance && watch.stalled(k, summary.residual)) {
      summary.status = SolveStatus::stalled;
      summary.residual = refreshed_residual(gamma);
      break;
    }
  }
  if (summary.residual <= context.tolerance) summary.status = SolveStatus::converged;
  if (!std::isfinite(summary.residual)) {
    std::copy(guess_.begin(), guess_.end(), gamma.begin());
    summary.status = SolveStatus::numerical_failure;
  }
  return summary;
}

void Pgs::release_workspace() {
  delassus_ = {};
  contacts_ = {};
  blocks_ = {};
  release(w_, partial_, guess_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Pgs>("pgs", "Block projected Gauss-Seidel: robust, monotone, cheap per sweep.",
                                            scree::Pgs::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("pgs", "1.0.0", &list)};
