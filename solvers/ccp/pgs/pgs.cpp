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
  bodies_.resize(problem.bodies());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k] = {w_[k], problem.inverse_mass[k], problem.inverse_inertia[k]};
  }
  steps_.resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    const Mat3 block = diagonal_block(problem, i);
    const double friction = problem.contacts[i].friction;
    steps_[i] = options_.scalar_step ? pgs::scalar_step(block, friction, options_.relaxation)
                                     : pgs::block_step(block, friction, options_.relaxation);
  }
  if (options_.coloured) colouring_.build(problem);
  return true;
}

template <bool compliant>
void Pgs::sweep_range(const CcpProblem& problem, std::size_t first, std::size_t last, std::span<double> gamma) {
  const CcpContact* const contacts = problem.contacts.data();
  const pgs::LocalStep* const steps = steps_.data();
  pgs::Body* const bodies = bodies_.data();
  for (std::size_t i = first; i < last; ++i) {
    const CcpContact& c = contacts[i];
    Vec3 g = load_block(gamma, i);
    const Vec3 e = compliant ? load_block(problem.compliance, i) : Vec3{};
    pgs::update<compliant>(c, steps[i], load_block(problem.r, i), e, bodies[c.a], bodies[c.b], g);
    store_block(gamma, i, g);
  }
}

void Pgs::sweep(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  const auto range = [&](std::size_t first, std::size_t last) {
    if (problem.compliance.empty()) {
      sweep_range<false>(problem, first, last, gamma);
    } else {
      sweep_range<true>(problem, first, last, gamma);
    }
  };
  if (!options_.coloured) {
    range(0, problem.blocks());
    return;
  }
  const auto& chunks = colouring_.chunks();
  const auto& first = colouring_.first();
  const auto run_chunks = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      const std::size_t begin = chunks[k] * pgs::Colouring::kChunkLength;
      range(begin, std::min(begin + pgs::Colouring::kChunkLength, problem.blocks()));
    }
  };
  for (std::size_t colour = 0; colour + 1 < first.size(); ++colour) {
    const std::size_t begin = first[colour], count = first[colour + 1] - begin;
    if (context.executor == nullptr || context.executor->threads() == 1) {
      run_chunks(begin, begin + count);
    } else {
      context.executor->for_chunks(count, 1, [&](std::size_t a, std::size_t b) { run_chunks(begin + a, begin + b); });
    }
  }
  run_chunks(first.back(), chunks.size());
}

double Pgs::residual(std::span<const double> gamma) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) w_[k] = bodies_[k].velocity;
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
    sweep(problem, context, gamma);
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
