#include "granular/rolling_resistance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace scree::granular {
namespace {

constexpr double kStiffness = 2.25;            ///< of rolling over that of the normal, times the arm squared
constexpr double kRollingInertia = 7.0 / 5.0;  ///< of a ball about a point of its surface, in m R^2
constexpr double kSpinningInertia = 2.0 / 5.0;
constexpr double kUpright = 1e-12;  ///< part of a square that the tangent plane must keep
/// Part of an angular velocity below which its components are what rounding leaves, and have no direction.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Elastic and plastic: stiffness, dashpot and limit of each lane.
struct Springs {
  alignas(64) Lane stiffness, damping, limit;
};

void find_springs(const ContactBatch& __restrict batch, const ContactLanes& __restrict lanes,
                  const Lane& __restrict arm, double inertia, double damping, Springs& __restrict out) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double stiffness = kStiffness * lanes.stiffness[k] * arm[k] * arm[k];
    out.stiffness[k] = stiffness;
    out.damping[k] = 2.0 * damping * std::sqrt(inertia * batch.mass[k] * batch.radius[k] * batch.radius[k] * stiffness);
    out.limit[k] = arm[k] * lanes.load[k];
  }
}

void roll_rigidly(ContactBatch& __restrict batch, const ContactLanes& __restrict lanes, const Lane& __restrict arm) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double sx = batch.spin.x[k], sy = batch.spin.y[k], sz = batch.spin.z[k], wn = sx * nx + sy * ny + sz * nz;
    const double px = sx - wn * nx, py = sy - wn * ny, pz = sz - wn * nz;
    // Where bodies spin on the spot, rounding leaves a part along the normal, which the division would make large.
    const double left = px * nx + py * ny + pz * nz;
    const double wx = px - left * nx, wy = py - left * ny, wz = pz - left * nz;
    const double speed = std::sqrt(wx * wx + wy * wy + wz * wz), whole = std::sqrt(sx * sx + sy * sy + sz * sz);
    const double factor = speed > kRounding * whole ? -arm[k] * lanes.load[k] / speed : 0.0;
    batch.torque.x[k] = factor * wx, batch.torque.y[k] = factor * wy, batch.torque.z[k] = factor * wz;
  }
}

/// What a contact keeps, in lanes of its own: the compiler then knows that nothing else lies there.
struct Kept {
  alignas(64) Lane x, y, z;
};

void move_moments(ContactBatch& __restrict batch, const Springs& __restrict springs, Kept& __restrict kept_moment) {
  Lane& hx = kept_moment.x;
  Lane& hy = kept_moment.y;
  Lane& hz = kept_moment.z;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double wn = batch.spin.x[k] * nx + batch.spin.y[k] * ny + batch.spin.z[k] * nz;
    const double wx = batch.spin.x[k] - wn * nx, wy = batch.spin.y[k] - wn * ny, wz = batch.spin.z[k] - wn * nz;
    const double upright = hx[k] * nx + hy[k] * ny + hz[k] * nz;
    const double px = hx[k] - upright * nx, py = hy[k] - upright * ny, pz = hz[k] - upright * nz;
    const double kept = hx[k] * hx[k] + hy[k] * hy[k] + hz[k] * hz[k];
    const double flat = px * px + py * py + pz * pz;
    const double turn = flat > kUpright * kept ? std::sqrt(kept / flat) : 0.0;

    const double ahead = springs.stiffness[k] * batch.ahead[k];
    double mx = turn * px + ahead * wx, my = turn * py + ahead * wy, mz = turn * pz + ahead * wz;
    const double moment = std::sqrt(mx * mx + my * my + mz * mz), limit = springs.limit[k];
    const bool yields = moment >= limit;
    const double stay = yields ? (moment > 0.0 ? limit / moment : 0.0) : 1.0;
    mx *= stay, my *= stay, mz *= stay;
    const double damping = yields ? 0.0 : springs.damping[k], lead = springs.stiffness[k] * batch.lead;
    const double tx = mx + damping * wx, ty = my + damping * wy, tz = mz + damping * wz;
    const double whole = std::sqrt(tx * tx + ty * ty + tz * tz), cut = whole > limit ? -limit / whole : -1.0;
    batch.torque.x[k] = cut * tx, batch.torque.y[k] = cut * ty, batch.torque.z[k] = cut * tz;
    hx[k] = mx + lead * wx, hy[k] = my + lead * wy, hz[k] = mz + lead * wz;
  }
}

void roll_elastically(ContactBatch& batch, const Springs& springs, std::size_t first) {
  Kept kept{batch.history[first], batch.history[first + 1], batch.history[first + 2]};
  move_moments(batch, springs, kept);
  batch.history[first] = kept.x, batch.history[first + 1] = kept.y, batch.history[first + 2] = kept.z;
}

/// Adds a moment about the normal to the torque.
void add_moments(ContactBatch& __restrict batch, const Lane& __restrict moment) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    batch.torque.x[k] += moment[k] * batch.normal.x[k];
    batch.torque.y[k] += moment[k] * batch.normal.y[k];
    batch.torque.z[k] += moment[k] * batch.normal.z[k];
  }
}

double spin_of(const ContactBatch& batch, std::size_t k) {
  return batch.spin.x[k] * batch.normal.x[k] + batch.spin.y[k] * batch.normal.y[k] +
         batch.spin.z[k] * batch.normal.z[k];
}

}  // namespace

RollingResistance::Model RollingResistance::model_of(const std::string& word) {
  if (word == "constant_directional") return Model::constant_directional;
  return word == "elastic_plastic" ? Model::elastic_plastic : Model::none;
}

RollingResistance::RollingResistance(const Options& options)
    : rolling_{model_of(options.text("rolling"))},
      spinning_{model_of(options.text("spinning"))},
      damping_{options.number("rolling_damping")} {}

std::vector<Parameter> RollingResistance::parameters() {
  const std::vector<std::string> models{"none", "constant_directional", "elastic_plastic"};
  return {
      Parameter::choice("rolling", models,
                        "resistance to rolling, with the pair's rolling_friction: a moment of constant size against "
                        "it, or a spring with a dashpot that yields at that moment, so that bodies come to rest")
          .by_default("none"),
      Parameter::choice("spinning", models, "the same about the normal, with the pair's spinning_friction")
          .by_default("none"),
      Parameter::number("rolling_damping", "1",
                        "damping ratio of elastic_plastic rolling and spinning, of a ball on a wall")
          .at_least(0.0)
          .by_default(0.3)};
}

void RollingResistance::setup(const Materials& materials) {
  rolling_arm_.clear(), spinning_arm_.clear();
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = 0; b < materials.size(); ++b) {
      rolling_arm_.push_back(rolling_ == Model::none ? 0.0 : materials.pair(a, b).rolling_friction);
      spinning_arm_.push_back(spinning_ == Model::none ? 0.0 : materials.pair(a, b).spinning_friction);
    }
  }
}

std::size_t RollingResistance::history_size() const {
  return (rolling_ == Model::elastic_plastic ? 3U : 0U) + (spinning_ == Model::elastic_plastic ? 1U : 0U);
}

std::optional<UnreadValue> RollingResistance::unread(const ContactMaterial& pair) const {
  const auto of = [](const char* key, const std::string& option) {
    return UnreadValue{key, "with " + option + " = \"none\" does not read it; set " + option +
                                " to \"elastic_plastic\" or \"constant_directional\", or the value to 0"};
  };
  if (pair.rolling_friction > 0.0 && rolling_ == Model::none) return of("rolling_friction", "rolling");
  if (pair.spinning_friction > 0.0 && spinning_ == Model::none) return of("spinning_friction", "spinning");
  return {};
}

double RollingResistance::rate(std::size_t pair, double radius) const {
  // A ball whose centre does not follow turns about it, not about the point of contact.
  const auto of = [&](Model model, const PairColumn& arm, double inertia) {
    if (model != Model::elastic_plastic) return 0.0;
    const double d = 2.0 * damping_ * std::sqrt(kStiffness * inertia) / kSpinningInertia;
    return arm[pair] / radius * (std::sqrt(kStiffness / kSpinningInertia + d * d) + d);
  };
  return std::max(of(rolling_, rolling_arm_, kRollingInertia), of(spinning_, spinning_arm_, kSpinningInertia));
}

void RollingResistance::roll(ContactBatch& batch, const ContactLanes& lanes, std::size_t first) const {
  alignas(64) Lane arm;
  spread(rolling_arm_, batch, arm);
  if (rolling_ == Model::constant_directional) return roll_rigidly(batch, lanes, arm);
  Springs springs;
  find_springs(batch, lanes, arm, kRollingInertia, damping_, springs);
  roll_elastically(batch, springs, first);
}

void RollingResistance::spin(ContactBatch& batch, const ContactLanes& lanes, std::size_t slot) const {
  alignas(64) Lane arm, moment;
  spread(spinning_arm_, batch, arm);
  if (spinning_ == Model::constant_directional) {
    for (std::size_t k = 0; k < batch.count; ++k) {
      const double w = spin_of(batch, k);
      moment[k] = std::abs(w) > kRounding * norm(batch.spin[k]) ? -std::copysign(arm[k] * lanes.load[k], w) : 0.0;
    }
    return add_moments(batch, moment);
  }
  Springs springs;
  find_springs(batch, lanes, arm, kSpinningInertia, damping_, springs);
  Lane& kept = batch.history[slot];
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double w = spin_of(batch, k), limit = springs.limit[k];
    const double spring = std::clamp(kept[k] + springs.stiffness[k] * batch.ahead[k] * w, -limit, limit);
    const double whole = spring + (std::abs(spring) < limit ? springs.damping[k] * w : 0.0);
    moment[k] = -std::clamp(whole, -limit, limit);
    kept[k] = spring + springs.stiffness[k] * batch.lead * w;
  }
  add_moments(batch, moment);
}

void RollingResistance::add(ContactBatch& batch, const ContactLanes& lanes, std::size_t first) const {
  if (!acts()) return;
  if (rolling_ != Model::none) {
    roll(batch, lanes, first);
  } else {
    for (std::size_t k = 0; k < batch.count; ++k) batch.torque.set(k, {});
  }
  if (spinning_ != Model::none) spin(batch, lanes, first + (rolling_ == Model::elastic_plastic ? 3U : 0U));
}

}  // namespace scree::granular
