#include "ball_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scree/math/contact_frame.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kChunk = Verlet::kChunk;
constexpr std::size_t kLanes = ContactBatch::kMost;
constexpr std::size_t kPrefetch = 12;

using Lane = ContactBatch::Lane;
using Lanes3 = ContactBatch::Lanes3;

}  // namespace

/// Contacts on their way through the law.
struct BallContacts::Work {
  ContactBatch batch;
  std::array<std::uint32_t, kLanes> pair;     // of each contact
  std::array<std::uint32_t, 2 * kLanes> hit;  // pairs that touch, and wait for a full batch
  std::size_t waiting = 0;
  alignas(64) Lane radius_a, radius_b, arm_a, arm_b, inverse_mass, is_new, leaving, acting;
  Lanes3 apart, rim;  // rim: sum of arm times angular velocity [m/s]
  ContactTally tally;
};

/// Distances and normals, all contacts side by side.
void BallContacts::measure(const Slots& slots, const Evaluation& e, Work& w) const {
  ContactBatch& batch = w.batch;
  const Place* const place = slots.place.data();
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Place &a = place[pairs_[w.pair[k]].a], &b = place[pairs_[w.pair[k]].b];
    w.apart.set(k, b.position - a.position);
    w.radius_a[k] = a.radius, w.radius_b[k] = b.radius;
  }
  const double sunk = e.at_contact_point ? 0.5 : 0.0;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double x = w.apart.x[k], y = w.apart.y[k], z = w.apart.z[k];
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

/// What lies in memory body by body and pair by pair, contact after contact.
void BallContacts::gather(const Slots& slots, const Evaluation& e, Work& w) const {
  ContactBatch& batch = w.batch;
  const Pair* const pairs = pairs_.data();
  const Moving* const moving = slots.moving.data();
  const std::uint8_t* const all_flags = flags_.data();
  const std::size_t materials = e.materials, count = batch.count;
  for (std::size_t k = 0; k < count; ++k) {
    const Pair pair = pairs[w.pair[k]];
    const Moving &a = moving[pair.a], &b = moving[pair.b];
    batch.velocity.set(k, b.linear - a.linear);
    w.rim.set(k, w.arm_a[k] * a.angular + w.arm_b[k] * b.angular);
    w.inverse_mass[k] = a.inverse_mass + b.inverse_mass;
    batch.materials[k] = static_cast<std::uint32_t>(a.material * materials + b.material);
    const std::uint8_t flags = all_flags[w.pair[k]];
    w.is_new[k] = (flags & kTouching) == 0 ? 1.0 : 0.0;
    w.leaving[k] = (flags & kLeaving) == 0 ? 0.0 : 1.0;
  }
  for (std::size_t k = 0; rolls_ && k < count; ++k) {
    const Pair pair = pairs[w.pair[k]];
    batch.spin.set(k, moving[pair.b].angular - moving[pair.a].angular);
  }
  const std::size_t history = history_, stride = stride_;
  const double* const records = records_.data();
  if (history == 3) {  // a tangential spring: most laws
    for (std::size_t k = 0; k < count; ++k) {
      const double* const record = records + stride * w.pair[k];
      batch.history[0][k] = record[0], batch.history[1][k] = record[1], batch.history[2][k] = record[2];
    }
    return;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double* const record = records + stride * w.pair[k];
    for (std::size_t j = 0; j < history; ++j) batch.history[j][k] = record[j];
  }
}

/// Velocities of the surfaces, and how the contact goes with the step; all contacts side by side.
void BallContacts::combine(const Evaluation& e, Work& w) {
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
}

void BallContacts::scatter(Slots& slots, const Evaluation& e, std::size_t chunk, Work& w) {
  const ContactBatch& batch = w.batch;
  const double time = kick_time(e);
  const Pair* const pairs = pairs_.data();
  Wrench *const ghosts = ghosts_.data() + ghost_begin_[chunk], *const wrenches = slots.wrench.data();
  double* const records = records_.data();
  const std::size_t history = history_, stride = stride_, count = batch.count;
  const auto first = static_cast<Slot>(chunk * kChunk);
  for (std::size_t k = 0; k < count; ++k) {
    const Pair pair = pairs[w.pair[k]];
    const Vec3 force = w.acting[k] * batch.force[k];
    const Vec3 lever = cross(batch.normal[k], force);
    Wrench& on_a = pair.a - first < kChunk ? wrenches[pair.a] : ghosts[pair.ghost];
    Wrench& on_b = pair.b - first < kChunk ? wrenches[pair.b] : ghosts[pair.ghost];
    on_a.force -= force;
    on_a.torque -= w.arm_a[k] * lever;
    on_b.force += force;
    on_b.torque -= w.arm_b[k] * lever;
    double* const record = records + stride * w.pair[k];
    for (std::size_t j = 0; j < history; ++j) record[j] = batch.history[j][k];
    double* const impulse = record + history;
    impulse[0] += time * force.x, impulse[1] += time * force.y, impulse[2] += time * force.z;
    if (!rolls_) continue;
    const Vec3 torque = w.acting[k] * batch.torque[k];
    on_a.torque -= torque;
    on_b.torque += torque;
    impulse[3] += time * torque.x, impulse[4] += time * torque.y, impulse[5] += time * torque.z;
  }
  note(e, w);
}

/// That they touch, since when, and, at the end of the step, by how much.
void BallContacts::note(const Evaluation& e, Work& w) {
  const ContactBatch& batch = w.batch;
  std::uint8_t* const all_flags = flags_.data();
  Vec3* const before = before_.data();
  for (std::size_t k = 0; k < batch.count; ++k) {
    std::uint8_t& flags = all_flags[w.pair[k]];
    if ((flags & kTouched) == 0) before[w.pair[k]] = batch.velocity[k];
    flags = static_cast<std::uint8_t>(kTouching | kTouched | (w.leaving[k] != 0.0 ? kLeaving : 0));
  }
  double greatest = w.tally.greatest_overlap;
  for (std::size_t k = 0; k < batch.count; ++k) greatest = std::max(greatest, batch.overlap[k]);
  w.tally.greatest_overlap = greatest;
  for (std::size_t k = 0; e.stage == Stage::last && k < batch.count; ++k) {
    if (batch.overlap[k] > 0.0) w.tally.add(batch.overlap[k], std::min(w.radius_a[k], w.radius_b[k]));
  }
}

/// The surfaces are apart: the next contact is a new one.
void BallContacts::let_go(std::size_t pair) {
  flags_[pair] = static_cast<std::uint8_t>(flags_[pair] & kTouched);
  std::fill_n(records_.begin() + static_cast<std::ptrdiff_t>(stride_ * pair), history_, 0.0);
}

ContactTally BallContacts::evaluate_chunk(Slots& slots, const Evaluation& e, std::size_t chunk) {
  const std::size_t first = chunk * kChunk, last = std::min(first + kChunk, slots.size());
  std::fill(slots.wrench.begin() + static_cast<std::ptrdiff_t>(first),
            slots.wrench.begin() + static_cast<std::ptrdiff_t>(last), Wrench{});
  std::fill(ghosts_.begin() + ghost_begin_[chunk], ghosts_.begin() + ghost_begin_[chunk + 1], Wrench{});
  Work w;
  ContactBatch& batch = w.batch;
  batch.count = 0;
  batch.lead = 0.5 * e.h;
  const std::size_t end = chunk_begin_[chunk + 1];
  for (std::size_t k = chunk_begin_[chunk]; k < end; k += kLanes) {
    // Whether a pair touches cannot be foreseen: it is written down in any case, and counted when it does.
    std::array<std::uint32_t, kLanes> gone;
    const std::size_t parted = look_at(slots, e, k, std::min(k + kLanes, end), w, gone);
    for (std::size_t g = 0; g < parted; ++g) let_go(gone[g]);
    // As many as fit; the rest waits for the next ones.
    while (w.waiting >= kLanes || (k + kLanes >= end && w.waiting > 0)) {
      batch.count = std::min(w.waiting, kLanes);
      for (std::size_t j = 0; j < batch.count; ++j) w.pair[j] = w.hit[j];
      w.waiting -= batch.count;
      for (std::size_t j = 0; j < w.waiting; ++j) w.hit[j] = w.hit[j + batch.count];
      measure(slots, e, w);
      gather(slots, e, w);
      combine(e, w);
      e.law->forces(batch);
      scatter(slots, e, chunk, w);
    }
  }
  return w.tally;
}

/// Adds the pairs of first .. last - 1 that touch to w.hit, and writes those that do no longer to `gone`; returns how many.
std::size_t BallContacts::look_at(const Slots& slots, const Evaluation& e, std::size_t first, std::size_t last, Work& w,
                                  std::array<std::uint32_t, kLanes>& gone) const {
  const Place* const place = slots.place.data();
  const Moving* const moving = slots.moving.data();
  const Pair* const pairs = pairs_.data();
  const std::uint8_t* const flags = flags_.data();
  const double reach = e.reach;
  const std::size_t end = pairs_.size() - 1;
  std::size_t hits = w.waiting, parted = 0;
  for (std::size_t k = first; k < last; ++k) {
    const Slot soon = pairs[std::min(k + kPrefetch, end)].b;
    __builtin_prefetch(&place[soon]);
    __builtin_prefetch(&moving[soon]);
    const Place &a = place[pairs[k].a], &b = place[pairs[k].b];
    const double radii = a.radius + b.radius + reach;
    const unsigned touch = squared_norm(b.position - a.position) < radii * radii ? 1 : 0;
    w.hit[hits] = gone[parted] = static_cast<std::uint32_t>(k);
    hits += touch;
    parted += (1 - touch) & (flags[k] & kTouching);
  }
  w.waiting = hits;
  return parted;
}

ContactTally BallContacts::evaluate(Slots& slots, const Evaluation& e, const Executor& executor) {
  const std::size_t chunks = Executor::chunk_count(slots.size(), kChunk);
  tally_.assign(chunks, ContactTally{});
  executor.for_chunks(chunks, 1,
                      [&](std::size_t chunk, std::size_t) { tally_[chunk] = evaluate_chunk(slots, e, chunk); });
  executor.for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t) {
    for (std::size_t k = incoming_begin_[chunk]; k < incoming_begin_[chunk + 1]; ++k) {
      slots.wrench[incoming_[k].slot] += ghosts_[incoming_[k].ghost];
    }
  });
  ContactTally sum;
  for (const ContactTally& tally : tally_) sum += tally;
  return sum;
}

void BallContacts::begin_step() {
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if ((flags_[k] & kTouched) == 0) continue;
    flags_[k] = static_cast<std::uint8_t>(flags_[k] & kTouching);
    std::fill_n(records_.begin() + static_cast<std::ptrdiff_t>(stride_ * k + history_), stride_ - history_, 0.0);
  }
}

void BallContacts::report(const Slots& slots, ContactRecords& out) const {
  for (std::size_t p = 0; p < neighbours_.size(); ++p) {
    const std::uint32_t at = place_[p];
    if ((flags_[at] & kTouched) == 0) continue;
    const Pair pair = pairs_[at];
    const Place &a = slots.place[pair.a], &b = slots.place[pair.b];
    const Moving &ma = slots.moving[pair.a], &mb = slots.moving[pair.b];
    const Vec3 apart = b.position - a.position;
    const double distance = norm(apart), gap = distance - a.radius - b.radius;
    const Vec3 n = (1.0 / distance) * apart;
    const ContactFrame frame = contact_frame(n);
    const Vec3 after = mb.linear - ma.linear - cross(a.radius * ma.angular + b.radius * mb.angular, n);
    const double* const record = records_.data() + stride_ * at + history_;
    const Vec3 impulse{record[0], record[1], record[2]};
    if (impulse == Vec3{} && gap > 0.0) continue;  // within reach of a law, but not held
    out.contact.push_back(
        {neighbours_[p].a, neighbours_[p].b, 0, 0, 0, a.position + (a.radius + 0.5 * gap) * n, n, gap});
    out.impulse.push_back(to_contact(frame, impulse));
    if (rolls_) out.angular_impulse.push_back(to_contact(frame, {record[3], record[4], record[5]}));
    out.before.push_back(to_contact(frame, before_[at]));
    out.after.push_back(to_contact(frame, after));
  }
}

std::size_t BallContacts::memory() const {
  return pairs_.capacity() * sizeof(Pair) + neighbours_.capacity() * sizeof(BodyPair) +
         place_.capacity() * sizeof(std::uint32_t) + records_.capacity() * sizeof(double) + flags_.capacity() +
         before_.capacity() * sizeof(Vec3) + ghosts_.capacity() * sizeof(Wrench) +
         incoming_.capacity() * sizeof(Incoming);
}

}  // namespace scree::dem
