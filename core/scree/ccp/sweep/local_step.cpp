#include "scree/ccp/sweep/local_step.hpp"

#include <algorithm>

namespace scree::sweep {

namespace {

/// diag(normal, tangent, tangent), an upper bound of the block.
struct Majoriser {
  double normal = 0.0;
  double tangent = 0.0;
};

// The tangential part is bounded by its largest eigenvalue. A coupling c between normal and tangent is bounded by
// 2 x c y <= k c x^2 + c y^2 / k; k = sqrt(normal / tangent) raises both in the same proportion.
Majoriser majorise(const Mat3& a, double friction) {
  const double normal = a.row0.x;
  const double half_sum = 0.5 * (a.row1.y + a.row2.z), half_difference = 0.5 * (a.row1.y - a.row2.z);
  const double tangent = half_sum + std::sqrt(half_difference * half_difference + a.row1.z * a.row1.z);
  if (friction == 0.0) return {normal, tangent};  // tangential impulses stay zero: there is no coupling
  const double coupling = std::sqrt(a.row0.y * a.row0.y + a.row0.z * a.row0.z);
  const double product = normal * tangent;
  const double factor = product > 0.0 ? 1.0 + coupling / std::sqrt(product) : 1.0;
  return {factor * normal, factor * tangent};
}

LocalStep step_of(double d_n, double d_t, double friction, double omega) {
  if (!(d_n > 0.0) || !(d_t > 0.0)) return {0.0, 0.0, cone_weights(1.0, 1.0, friction)};
  return {omega / d_n, omega / d_t, cone_weights(d_n, d_t, friction)};
}

}  // namespace

LocalStep scalar_step(const Mat3& a, double friction, double omega) {
  const Majoriser d = majorise(a, friction);
  const double mean = (a.row0.x + a.row1.y + a.row2.z) / 3.0;
  // The mean may lie below half the largest eigenvalue (long bodies): steps would then overshoot and diverge.
  const double stiffness = std::max(mean / omega, 0.55 * std::max(d.normal, friction > 0.0 ? d.tangent : 0.0));
  return step_of(stiffness, stiffness, friction, 1.0);
}

LocalStep block_step(const Mat3& a, double friction, double omega) {
  const Majoriser d = majorise(a, friction);
  return step_of(d.normal, d.tangent, friction, omega);
}

}  // namespace scree::sweep
