// What BallContacts does with a batch of contacts of two balls, four at a time, and with one of any kind.
#include <algorithm>
#include <cmath>

#include "ball_contacts.hpp"
#include "ball_work.hpp"

namespace scree::dem {
/// Distances and normals.
void BallContacts::measure(const Slots& slots, const Evaluation& e, BallWork& w) const {
  ContactBatch& batch = w.batch;
  const Place* const place = slots.place.data();
  const std::size_t count = padded(batch.count);
  for (std::size_t k = 0; k < count; k += 4) {
    set_columns(w.apart[k], w.apart[k + 1], w.apart[k + 2], w.apart[k + 3], k, batch.normal);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Pair& pair = pairs_[w.hit[k]];
    w.radius_a[k] = place[pair.a].radius;
    w.radius_b[k] = place[pair.b].radius;
  }
  const double sunk = e.at_contact_point ? 0.5 : 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = batch.normal.x[k], y = batch.normal.y[k], z = batch.normal.z[k];
    const double distance = std::sqrt(x * x + y * y + z * z);
    // Of two balls with one centre any normal will do.
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    batch.normal.x[k] = inverse * x, batch.normal.y[k] = inverse * y;
    batch.normal.z[k] = distance > 0.0 ? inverse * z : 1.0;
    const double a = w.radius_a[k], b = w.radius_b[k], overlap = a + b - distance;
    w.overlap[k] = overlap;
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
      angular[j] = w.arm_a[k] * spin_a + w.arm_b[k] * spin_b;
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
  const Lanes* const records = list_.records.data() + stride_ * w.first;
  const std::uint8_t* const all_flags = list_.flags.data() + w.first;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::uint8_t flags = all_flags[w.hit[k]];
    w.is_new[k] = (flags & kTouching) == 0 ? 1.0 : 0.0;
    w.leaving[k] = (flags & kLeaving) == 0 ? 0.0 : 1.0;
  }
  for (std::size_t first = 0; first < batch.count; first += 4) {
    for (std::size_t q = 0; q < springs_; ++q) {
      std::array<Lanes, 4> of;
      for (std::size_t j = 0; j < 4; ++j) of[j] = records[stride_ * w.hit[first + j] + q];
      transpose(of[0], of[1], of[2], of[3]);
      for (std::size_t j = 0; j < 4 && 4 * q + j < history_; ++j) set_lanes_at(of[j], batch.history[4 * q + j], first);
      if (q + 1 == springs_) set_lanes_at(of[3], w.work, first);
    }
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
    const Acting acting = timing.of({w.is_new[k], w.leaving[k]}, w.overlap[k], -(nx * vx + ny * vy + nz * vz));
    batch.overlap[k] = w.overlap[k] + acting.shift;
    batch.ahead[k] = acting.ahead;
    w.acting[k] = acting.part;
    w.leaving[k] = acting.leaving;
  }
  e.law->forces(batch);
  const double time = kick_time(e);
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double nx = batch.normal.x[k], ny = batch.normal.y[k], nz = batch.normal.z[k];
    const double fx = w.acting[k] * batch.force.x[k], fy = w.acting[k] * batch.force.y[k],
                 fz = w.acting[k] * batch.force.z[k];
    batch.force.x[k] = fx, batch.force.y[k] = fy, batch.force.z[k] = fz;
    w.lever.x[k] = ny * fz - nz * fy, w.lever.y[k] = nz * fx - nx * fz, w.lever.z[k] = nx * fy - ny * fx;
    w.work[k] -= time * (fx * batch.velocity.x[k] + fy * batch.velocity.y[k] + fz * batch.velocity.z[k]);
  }
  for (std::size_t k = 0; rolls_ && k < batch.count; ++k) {
    batch.torque.x[k] *= w.acting[k], batch.torque.y[k] *= w.acting[k], batch.torque.z[k] *= w.acting[k];
    w.work[k] -= time * dot(batch.torque[k], batch.spin[k]);
  }
}

template <bool kRolls>
void BallContacts::scatter(Slots& slots, const BallWork& w) const {
  const ContactBatch& batch = w.batch;
  Wrench* const wrench = slots.wrench.data();
  for (std::size_t first = 0; first < batch.count; first += 4) {
    const std::array<Lanes, 4> force = rows(batch.force, first), lever = rows(w.lever, first);
    [[maybe_unused]] std::array<Lanes, 4> torque;
    if constexpr (kRolls) torque = rows(batch.torque, first);
    for (std::size_t j = 0; j < std::min<std::size_t>(4, batch.count - first); ++j) {
      const Pair& pair = pairs_[w.hit[first + j]];
      Wrench &on_a = wrench[pair.a], &on_b = wrench[pair.to_b];
      Lanes turn_a = -w.arm_a[first + j] * lever[j], turn_b = -w.arm_b[first + j] * lever[j];
      if constexpr (kRolls) turn_a -= torque[j], turn_b += torque[j];
      set_four(four_of(on_a) - force[j], on_a);
      set_four(four_of(on_a, 1) + turn_a, on_a, 1);
      set_four(four_of(on_b) + force[j], on_b);
      set_four(four_of(on_b, 1) + turn_b, on_b, 1);
    }
  }
}

/// Adds the forces to what acts on the bodies.
void BallContacts::scatter(Slots& slots, const BallWork& w) const {
  rolls_ ? scatter<true>(slots, w) : scatter<false>(slots, w);
}

/// Springs, work and impulses, pair by pair.
void BallContacts::write_records(double time, const BallWork& w) {
  const ContactBatch& batch = w.batch;
  Lanes* const records = list_.records.data() + stride_ * w.first;
  for (std::size_t first = 0; first < batch.count; first += 4) {
    const std::size_t most = std::min<std::size_t>(4, batch.count - first);
    for (std::size_t q = 0; q < springs_; ++q) {
      std::array<Lanes, 4> of{};
      for (std::size_t j = 0; j < 4 && 4 * q + j < history_; ++j) of[j] = lanes_at(batch.history[4 * q + j], first);
      if (q + 1 == springs_) of[3] = lanes_at(w.work, first);
      transpose(of[0], of[1], of[2], of[3]);
      for (std::size_t j = 0; j < most; ++j) records[stride_ * w.hit[first + j] + q] = of[j];
    }
    const std::array<Lanes, 4> force = rows(batch.force, first);
    for (std::size_t j = 0; j < most; ++j) records[stride_ * w.hit[first + j] + springs_] += time * force[j];
    for (std::size_t j = 0; rolls_ && j < most; ++j) {
      const Vec3 moment = time * batch.torque[first + j];
      records[stride_ * w.hit[first + j] + springs_ + 1] += Lanes{moment.x, moment.y, moment.z, 0.0};
    }
  }
}

/// Writes down what the contacts keep, that they touch, since when, and, at the end of the step, by how much.
void BallContacts::keep(const Evaluation& e, BallWork& w) {
  const ContactBatch& batch = w.batch;
  write_records(kick_time(e), w);
  std::uint8_t* const all_flags = list_.flags.data() + w.first;
  Vec3* const before = list_.before.data() + w.first;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::size_t pair = w.hit[k];
    std::uint8_t& flags = all_flags[pair];
    // A contact of a law with a reach may be within it only.
    const bool held = e.reach == 0.0 || w.overlap[k] >= 0.0 || batch.force[k] != Vec3{};
    if (held && (flags & kTouched) == 0) before[pair] = batch.velocity[k];
    flags = static_cast<std::uint8_t>(kTouching | (held ? kTouched : flags & kTouched) |
                                      (w.leaving[k] != 0.0 ? kLeaving : 0));
  }
  for (std::size_t first = 0; first < batch.count; first += 4) {
    const Lanes overlap = lanes_at(w.overlap, first);
    w.greatest = overlap > w.greatest ? overlap : w.greatest;
  }
  for (std::size_t k = 0; e.stage == Stage::last && k < batch.count; ++k) {
    if (w.overlap[k] > 0.0) w.tally.add(w.overlap[k], std::min(w.radius_a[k], w.radius_b[k]));
  }
}

/// The surfaces are apart: the next contact is a new one.
void BallContacts::let_go(const BallWork& w) {
  for (std::size_t g = 0; g < w.parted; ++g) {
    const std::size_t pair = w.first + w.gone[g];
    list_.flags[pair] = static_cast<std::uint8_t>(list_.flags[pair] & kTouched);
    for (std::size_t q = 0; q < springs_; ++q) {
      Lanes& springs = list_.records[stride_ * pair + q];
      springs = q + 1 < springs_ ? Lanes{} : Lanes{0.0, 0.0, 0.0, springs[3]};
    }
  }
}

}  // namespace scree::dem
