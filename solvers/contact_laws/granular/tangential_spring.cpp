#include "granular/tangential_spring.hpp"

#include <cmath>

namespace scree::granular {
namespace {

/// Below this part of its square, a spring has no direction in the new tangent plane: the contact has turned by 90 degrees.
constexpr double kUpright = 1e-12;

template <bool kRescaled>
void move_springs(ContactBatch& __restrict batch, const ContactLanes& __restrict lanes, const Lane& __restrict friction,
                  [[maybe_unused]] const Lane* __restrict rescale) {
  Lane& hx = batch.history[0];
  Lane& hy = batch.history[1];
  Lane& hz = batch.history[2];
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double approach = lanes.approach[k];
    const double vx = batch.velocity.x[k] + approach * nx;
    const double vy = batch.velocity.y[k] + approach * ny;
    const double vz = batch.velocity.z[k] + approach * nz;

    // The kept spring in the tangent plane of now.
    const double upright = hx[k] * nx + hy[k] * ny + hz[k] * nz;
    const double px = hx[k] - upright * nx, py = hy[k] - upright * ny, pz = hz[k] - upright * nz;
    const double kept = hx[k] * hx[k] + hy[k] * hy[k] + hz[k] * hz[k];
    const double flat = px * px + py * py + pz * pz;
    double turn = flat > kUpright * kept ? std::sqrt(kept / flat) : 0.0;
    if constexpr (kRescaled) turn *= (*rescale)[k];

    const double ahead = lanes.tangent_stiffness[k] * batch.ahead[k];
    double sx = turn * px + ahead * vx, sy = turn * py + ahead * vy, sz = turn * pz + ahead * vz;
    const double damping = lanes.tangent_damping[k];
    double fx = sx + damping * vx, fy = sy + damping * vy, fz = sz + damping * vz;
    const double pull = std::sqrt(fx * fx + fy * fy + fz * fz), limit = friction[k] * lanes.load[k];
    const bool slides = pull > limit;
    const double cut = slides ? limit / pull : 1.0;
    fx *= cut, fy *= cut, fz *= cut;
    sx = slides ? fx - damping * vx : sx;
    sy = slides ? fy - damping * vy : sy;
    sz = slides ? fz - damping * vz : sz;

    const double lead = lanes.tangent_stiffness[k] * batch.lead;
    hx[k] = sx + lead * vx, hy[k] = sy + lead * vy, hz[k] = sz + lead * vz;
    batch.force.x[k] = lanes.normal[k] * nx - fx;
    batch.force.y[k] = lanes.normal[k] * ny - fy;
    batch.force.z[k] = lanes.normal[k] * nz - fz;
  }
}

}  // namespace

void add_tangential_spring(ContactBatch& batch, const ContactLanes& lanes, const Lane& friction, const Lane* rescale) {
  if (rescale != nullptr) {
    move_springs<true>(batch, lanes, friction, rescale);
  } else {
    move_springs<false>(batch, lanes, friction, nullptr);
  }
}

}  // namespace scree::granular
