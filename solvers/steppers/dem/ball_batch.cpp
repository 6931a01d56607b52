// What BallContacts does with a batch of contacts of two balls, four at a time, and with one of any kind.
#include <algorithm>
#include <cmath>

#include "ball_contacts.hpp"
#include "ball_work.hpp"

namespace scree::dem {
namespace {

constexpr Lanes kAway{-1.0, -1.0, -1.0, 1.0};  // from a to b, and the sum of what comes fourth

}  // namespace

/// Distances and normals.
void BallContacts::measure(const Slots& slots, const Evaluation& e, BallWork& w) const {
  ContactBatch& batch = w.batch;
  const Place* const place = slots.place.data();
  for (std::size_t k = 0; k < batch.count; k += 4) {
    set_columns(w.apart[k], w.apart[k + 1], w.apart[k + 2], w.apart[k + 3], k, batch.normal);
  }
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Pair& pair = pairs_[w.hit[k]];
    w.radius_a[k] = place[pair.a].radius;
    w.radius_b[k] = place[pair.b].radius;
  }
  const double sunk = e.at_contact_point ? 0.5 : 0.0;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double x = batch.normal.x[k], y = batch.normal.y[k], z = batch.normal.z[k];
    const double distance = std::sqrt(x * x + y * y + z * z);
    // Of two balls with one centre any normal will do.
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    batch.normal.x[k] = inverse * x, batch.normal.y[k] = inverse * y;
    batch.normal.z[k] = distance > 0.0 ? inverse * z : 1.0;
    const double a = w.radius_a[k], b = w.radius_b[k], overlap = a + b - distance;
    batch.overlap[k] = overlap;
    batch.radius[k] = a * b / (a + b);
    w.arm_a[k] = a - sunk * overlap;
    w.arm_b[k] = b - sunk * overlap;
  }
}

/// What lies in memory body by body.
void BallContacts::gather(const Slots& slots, const Evaluation& e, BallWork& w) const {
  ContactBatch& batch = w.batch;
  const Moving* const moving = slots.moving.data();
  std::array<Lanes, 4> linear, angular, spin;
  for (std::size_t first = 0; first < batch.count; first += 4) {
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t k = first + j;
      const Pair& pair = pairs_[w.hit[k]];
      const Moving &a = moving[pair.a], &b = moving[pair.b];
      const Lanes spin_a = four_of(a, 1), spin_b = four_of(b, 1);
      linear[j] = four_of(b) + kAway * four_of(a);
      angular[j] = splat(w.arm_a[k]) * spin_a + splat(w.arm_b[k]) * spin_b;
      spin[j] = spin_b - spin_a;
    }
    const Lanes inverse_mass = set_columns(linear[0], linear[1], linear[2], linear[3], first, batch.velocity);
    set_lanes_at(inverse_mass, w.inverse_mass, first);
    set_columns(angular[0], angular[1], angular[2], angular[3], first, w.rim);
    if (rolls_) set_columns(spin[0], spin[1], spin[2], spin[3], first, batch.spin);
  }
  for (std::size_t k = 0; e.materials > 1 && k < batch.count; ++k) {
    const Pair& pair = pairs_[w.hit[k]];
    batch.materials[k] = static_cast<std::uint32_t>(slots.material[pair.a] * e.materials + slots.material[pair.b]);
  }
}

/// What contacts keep, pair by pair.
void BallContacts::recall(BallWork& w) const {
  ContactBatch& batch = w.batch;
  const double* const records = records_.data() + stride_ * w.first;
  const std::uint8_t* const all_flags = flags_.data() + w.first;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::uint8_t flags = all_flags[w.hit[k]];
    w.is_new[k] = (flags & kTouching) == 0 ? 1.0 : 0.0;
    w.leaving[k] = (flags & kLeaving) == 0 ? 0.0 : 1.0;
    const double* const record = records + stride_ * w.hit[k];
    for (std::size_t j = 0; j < history_; ++j) batch.history[j][k] = record[j];
  }
}

/// Velocities of the surfaces, how the contacts go with the step, and the forces.
void BallContacts::apply_law(const Evaluation& e, BallWork& w) const {
  ContactBatch& batch = w.batch;
  const ContactTiming timing{e};
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double rx = w.rim.x[k], ry = w.rim.y[k], rz = w.rim.z[k];
    const double vx = batch.velocity.x[k] - (ry * nz - rz * ny), vy = batch.velocity.y[k] - (rz * nx - rx * nz),
                 vz = batch.velocity.z[k] - (rx * ny - ry * nx);
    batch.velocity.x[k] = vx, batch.velocity.y[k] = vy, batch.velocity.z[k] = vz;
    batch.mass[k] = 1.0 / w.inverse_mass[k];
    const Acting acting = timing.of({w.is_new[k], w.leaving[k]}, batch.overlap[k], -(nx * vx + ny * vy + nz * vz));
    batch.ahead[k] = acting.ahead;
    w.acting[k] = acting.part;
    w.leaving[k] = acting.leaving;
  }
  e.law->forces(batch);
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double fx = w.acting[k] * batch.force.x[k], fy = w.acting[k] * batch.force.y[k],
                 fz = w.acting[k] * batch.force.z[k];
    batch.force.x[k] = fx, batch.force.y[k] = fy, batch.force.z[k] = fz;
    w.lever.x[k] = ny * fz - nz * fy, w.lever.y[k] = nz * fx - nx * fz, w.lever.z[k] = nx * fy - ny * fx;
  }
  for (std::size_t k = 0; rolls_ && k < batch.count; ++k) {
    batch.torque.x[k] *= w.acting[k], batch.torque.y[k] *= w.acting[k], batch.torque.z[k] *= w.acting[k];
  }
}

/// Adds the forces to what acts on the bodies.
void BallContacts::scatter(Slots& slots, BallWork& w) const {
  const ContactBatch& batch = w.batch;
  Wrench* const wrench = slots.wrench.data();
  for (std::size_t first = 0; first < batch.count; first += 4) {
    const std::array<Lanes, 4> force = rows(batch.force, first), lever = rows(w.lever, first);
    std::array<Lanes, 4> torque{};
    if (rolls_) torque = rows(batch.torque, first);
    for (std::size_t j = 0; j < std::min<std::size_t>(4, batch.count - first); ++j) {
      const Pair& pair = pairs_[w.hit[first + j]];
      Wrench &on_a = wrench[pair.to_a], &on_b = wrench[pair.to_b];
      set_four(four_of(on_a) - force[j], on_a);
      set_four(four_of(on_a, 1) - splat(w.arm_a[first + j]) * lever[j] - torque[j], on_a, 1);
      set_four(four_of(on_b) + force[j], on_b);
      set_four(four_of(on_b, 1) - splat(w.arm_b[first + j]) * lever[j] + torque[j], on_b, 1);
    }
  }
}

/// Writes down what the contacts keep: springs, impulses, that they touch, since when, and, at the end of the step, by how much.
void BallContacts::keep(const Evaluation& e, BallWork& w) {
  const ContactBatch& batch = w.batch;
  const double time = kick_time(e);
  double* const records = records_.data() + stride_ * w.first;
  std::uint8_t* const all_flags = flags_.data() + w.first;
  Vec3* const before = before_.data() + w.first;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::size_t pair = w.hit[k];
    double* const record = records + stride_ * pair;
    for (std::size_t j = 0; j < history_; ++j) record[j] = batch.history[j][k];
    double* const impulse = record + history_;
    impulse[0] += time * batch.force.x[k], impulse[1] += time * batch.force.y[k], impulse[2] += time * batch.force.z[k];
    std::uint8_t& flags = all_flags[pair];
    if ((flags & kTouched) == 0) before[pair] = batch.velocity[k];
    flags = static_cast<std::uint8_t>(kTouching | kTouched | (w.leaving[k] != 0.0 ? kLeaving : 0));
    if (!rolls_) continue;
    impulse[3] += time * batch.torque.x[k], impulse[4] += time * batch.torque.y[k],
        impulse[5] += time * batch.torque.z[k];
  }
  double greatest = w.tally.greatest_overlap;
  for (std::size_t k = 0; k < batch.count; ++k) greatest = std::max(greatest, batch.overlap[k]);
  w.tally.greatest_overlap = greatest;
  for (std::size_t k = 0; e.stage == Stage::last && k < batch.count; ++k) {
    if (batch.overlap[k] > 0.0) w.tally.add(batch.overlap[k], std::min(w.radius_a[k], w.radius_b[k]));
  }
}

/// The surfaces are apart: the next contact is a new one.
void BallContacts::let_go(const BallWork& w) {
  for (std::size_t g = 0; g < w.parted; ++g) {
    const std::size_t pair = w.first + w.gone[g];
    flags_[pair] = static_cast<std::uint8_t>(flags_[pair] & kTouched);
    std::fill_n(records_.begin() + static_cast<std::ptrdiff_t>(stride_ * pair), history_, 0.0);
  }
}

}  // namespace scree::dem
