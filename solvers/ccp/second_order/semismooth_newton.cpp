#include "semismooth_newton.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"

namespace scree {

SemismoothNewton::SemismoothNewton(const Options& options)
    : SemismoothNewton{second_order::PenaltyOptions{.first = options.number("first_penalty"),
                                                    .growth = options.number("penalty_growth"),
                                                    .most = options.number("most_penalty")}} {}

std::vector<Parameter> SemismoothNewton::parameters() {
  return {
      Parameter::number("first_penalty", "1", "stiffness of the first outer step, in terms of each contact's own mass")
          .by_default(10.0)
          .at_least(1e-3)
          .at_most(1e8),
      Parameter::number("penalty_growth", "1", "factor on it from one outer step to the next")
          .by_default(10.0)
          .at_least(1.0)
          .at_most(1e4),
      Parameter::number("most_penalty", "1", "its limit; rounding errors grow with it")
          .by_default(1e5)
          .at_least(1e-3)
          .at_most(1e8),
  };
}

SolveSummary SemismoothNewton::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "semismooth_newton: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!best_.start(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, 0.0};
  if (!best_.done()) {
    system_.bind(problem);
    start_.assign(gamma.begin(), gamma.end());
    // Outer steps stay near where they start.
    if (best_.guess_is_above_zero()) std::ranges::fill(start_, 0.0);
    newton_.run(system_, problem, options_, context, start_, best_, summary);
    newton_.insist(system_, problem, context, best_, summary);
  }
  best_.conclude(summary);
  return summary;
}

void SemismoothNewton::release_workspace() {
  system_ = {};
  best_ = {};
  newton_ = {};
  release(start_);
}

}  // namespace scree
