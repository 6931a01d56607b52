#include "scree/ccp/packed/confirmation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/release.hpp"

namespace scree::packed {
namespace {

/// Traces [1/kg] and velocities [m/s] with whose squares and products the passes can work.
constexpr double kLeast = 1e-30, kMost = 1e30;
/// Share of the tolerance that rounding may have.
constexpr double kShare = 1e-3;

}  // namespace

void Confirmation::start(const DelassusOperator& delassus, std::span<const double> guess, double tolerance,
                         const Executor* executor) {
  executor_ = executor;
  tolerance_ = tolerance;
  double least = kMost, most = kLeast, speed = 0.0;
  bool ordinary = true;
  for (const double trace : delassus.traces()) {
    if (trace == 0.0) continue;
    ordinary = ordinary && trace > kLeast && trace < kMost;
    least = std::min(least, trace);
    most = std::max(most, trace);
  }
  for (const double r : delassus.problem().r) speed = std::max(speed, std::abs(r));
  const double rounding = std::numeric_limits<double>::epsilon() * speed * (most / least);
  needed_ = !(ordinary && speed < kMost && rounding < kShare * tolerance);
  if (needed_) guess_.assign(guess.begin(), guess.end());
}

double Confirmation::residual(const PackedProblem& packed, const Impulses& x, double seen) {
  if (!needed_ || seen > tolerance_) return seen;
  gamma_ = guess_;
  packed.unpack(x, gamma_);
  return judge_.residual(packed.problem(), gamma_, executor_);
}

double Confirmation::residual(const CcpProblem& problem, std::span<const double> gamma, double seen) {
  return needed_ && seen <= tolerance_ ? judge_.residual(problem, gamma, executor_) : seen;
}

void Confirmation::release_memory() {
  judge_ = {};
  release(guess_, gamma_);
}

}  // namespace scree::packed
