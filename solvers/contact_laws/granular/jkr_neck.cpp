#include "granular/jkr_neck.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::granular {
namespace {

constexpr double kPi = std::numbers::pi;
/// Newton's method from above on a convex function: as many rounds as the worst overlap needs to the last bit.
constexpr int kRounds = 7;

/// s >= 1 with s^4 - 4 s = x, x >= -3.
inline double neck_size(double x) {
  // Both are upper bounds: the first near the break, the other for deep contacts.
  double s = std::min(1.0 + std::sqrt((x + 3.0) * (1.0 / 6.0)), std::sqrt(std::sqrt(std::max(x, 0.0))) + 1.5875);
  for (int round = 0; round < kRounds; ++round) {
    const double cube = s * s * s;
    s -= (cube * s - 4.0 * s - x) / std::max(4.0 * cube - 4.0, 1e-12);
  }
  return std::max(s, 1.0);
}

}  // namespace

double neck_radius(double adhesion, double modulus, double radius) {
  return std::cbrt(kPi * adhesion * radius * radius / (8.0 * modulus));
}

double neck_reach(double adhesion, double modulus, double radius) {
  const double c = neck_radius(adhesion, modulus, radius);
  return 3.0 * c * c / radius;
}

void find_necks(ContactBatch& __restrict batch, const Lane& __restrict adhesion, const Lane& __restrict modulus,
                std::size_t slot, ContactLanes& __restrict lanes) {
  alignas(64) Lane unit;
  for (std::size_t k = 0; k < batch.count; ++k) unit[k] = neck_radius(adhesion[k], modulus[k], batch.radius[k]);
  Lane& bond = batch.history[slot];
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double radius = batch.radius[k], overlap = batch.overlap[k], c = unit[k];
    const bool sticky = c > 0.0;
    const double depth = overlap * radius / (sticky ? c * c : 1.0);
    const bool holds = (overlap >= 0.0) | ((bond[k] > 0.0) & sticky & (depth >= -3.0));
    const double s = neck_size(std::max(depth, -3.0)), cube = s * s * s;
    const double hertz = std::sqrt(radius * std::max(overlap, 0.0));
    const double a = sticky ? c * s * s : hertz;
    const double force = sticky ? 0.5 * kPi * adhesion[k] * radius * (cube * cube * (1.0 / 3.0) - 2.0 * cube)
                                : 4.0 / 3.0 * modulus[k] * hertz * std::max(overlap, 0.0);
    lanes.contact_radius[k] = holds ? a : 0.0;
    lanes.normal[k] = holds ? force : 0.0;
    bond[k] = holds ? 1.0 : 0.0;
  }
}

}  // namespace scree::granular
