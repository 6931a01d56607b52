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

void set(Lanes3& lanes, std::size_t k, const Vec3& v) { lanes.set(k, v); }

}  // namespace

/// Contacts on their way through the law.
struct BallContacts::Work {
  ContactBatch batch;
  std::array<std::uint32_t, kLanes> pair;  // of each contact
  std::array<char, kLanes> is_new;
  alignas(64) Lane distance2, radius_a, radius_b, mass_a, mass_b, arm_a, arm_b, acting;
  Lanes3 apart, spin_a, spin_b;
  ContactTally tally;
};

/// Raw columns first, one contact after the other; then arithmetic, all contacts side by side.
void BallContacts::gather(const Slots& slots, const Evaluation& e, Work& w) const {
  ContactBatch& batch = w.batch;
  const std::size_t count = batch.count;
  for (std::size_t k = 0; k < count; ++k) {
    const Pair pair = pairs_[w.pair[k]];
    const Twist &ta = slots.twist[pair.a], &tb = slots.twist[pair.b];
    const Inertia &ia = slots.inertia[pair.a], &ib = slots.inertia[pair.b];
    batch.velocity.set(k, tb.linear - ta.linear);
    set(w.spin_a, k, ta.angular);
    set(w.spin_b, k, tb.angular);
    w.mass_a[k] = ia.mass, w.mass_b[k] = ib.mass;
    batch.materials[k] = static_cast<std::uint32_t>(ia.material * e.materials + ib.material);
    w.is_new[k] = (flags_[w.pair[k]] & kTouching) == 0;
  }
  const std::size_t history = history_, stride = stride_;
  for (std::size_t k = 0; k < count; ++k) {
    const double* const record = records_.data() + stride * w.pair[k];
    for (std::size_t j = 0; j < history; ++j) batch.history[j][k] = record[j];
  }
  const double sunk = e.at_contact_point ? 0.5 : 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double distance = std::sqrt(w.distance2[k]), inverse = 1.0 / distance;
    const double nx = inverse * w.apart.x[k], ny = inverse * w.apart.y[k], nz = inverse * w.apart.z[k];
    batch.normal.x[k] = nx, batch.normal.y[k] = ny, batch.normal.z[k] = nz;
    const double ra = w.radius_a[k], rb = w.radius_b[k], overlap = ra + rb - distance;
    batch.overlap[k] = overlap;
    batch.radius[k] = ra * rb / (ra + rb);
    const double ma = w.mass_a[k], mb = w.mass_b[k];
    // Of one body that forces do not move, whose mass is written as zero: that of the other.
    batch.mass[k] = ma == 0.0 || mb == 0.0 ? ma + mb : ma * mb / (ma + mb);
    const double arm_a = ra - sunk * overlap, arm_b = rb - sunk * overlap;
    w.arm_a[k] = arm_a, w.arm_b[k] = arm_b;
    const double sx = arm_a * w.spin_a.x[k] + arm_b * w.spin_b.x[k], sy = arm_a * w.spin_a.y[k] + arm_b * w.spin_b.y[k],
                 sz = arm_a * w.spin_a.z[k] + arm_b * w.spin_b.z[k];
    batch.velocity.x[k] -= sy * nz - sz * ny;
    batch.velocity.y[k] -= sz * nx - sx * nz;
    batch.velocity.z[k] -= sx * ny - sy * nx;
    const double approach = -(nx * batch.velocity.x[k] + ny * batch.velocity.y[k] + nz * batch.velocity.z[k]);
    const bool is_new = w.is_new[k] != 0;
    const double since = is_new ? time_since(overlap, approach, e.h) : 0.0;
    batch.ahead[k] = e.ahead(is_new, since);
    w.acting[k] = acting_part(e, is_new, since, overlap, approach);
  }
  if (!e.rolls) return;
  for (std::size_t k = 0; k < count; ++k) set(batch.spin, k, w.spin_b[k] - w.spin_a[k]);
}

void BallContacts::scatter(Slots& slots, const Evaluation& e, std::size_t chunk, Work& w) {
  const ContactBatch& batch = w.batch;
  const double time = kick_time(e);
  Wrench* const ghosts = ghosts_.data() + ghost_begin_[chunk];
  const auto first = static_cast<Slot>(chunk * kChunk);
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::uint32_t at = w.pair[k];
    const Pair pair = pairs_[at];
    const Vec3 force = w.acting[k] * batch.force[k];
    const Vec3 lever = cross(batch.normal[k], force);
    Wrench& on_a = pair.a - first < kChunk ? slots.wrench[pair.a] : ghosts[pair.ghost];
    Wrench& on_b = pair.b - first < kChunk ? slots.wrench[pair.b] : ghosts[pair.ghost];
    on_a.force -= force;
    on_b.force += force;
    on_a.torque -= w.arm_a[k] * lever;
    on_b.torque -= w.arm_b[k] * lever;
    double* const record = records_.data() + stride_ * at;
    for (std::size_t j = 0; j < history_; ++j) record[j] = batch.history[j][k];
    double* const impulse = record + history_;
    impulse[0] += time * force.x, impulse[1] += time * force.y, impulse[2] += time * force.z;
    if (rolls_) {
      const Vec3 torque = w.acting[k] * batch.torque[k];
      on_a.torque -= torque;
      on_b.torque += torque;
      impulse[3] += time * torque.x, impulse[4] += time * torque.y, impulse[5] += time * torque.z;
    }
    if ((flags_[at] & kTouched) == 0) before_[at] = batch.velocity[k];
    flags_[at] = kTouching | kTouched;
    if (e.stage != Stage::last || batch.overlap[k] <= 0.0) continue;
    const double smaller = w.mass_a[k] == 0.0   ? w.radius_b[k]
                           : w.mass_b[k] == 0.0 ? w.radius_a[k]
                                                : std::min(w.radius_a[k], w.radius_b[k]);
    w.tally.add(batch.overlap[k], smaller);
  }
}

/// The surfaces are apart: the next contact is a new one.
void BallContacts::let_go(std::size_t pair) {
  flags_[pair] = static_cast<std::uint8_t>(flags_[pair] & ~kTouching);
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
  const auto flush = [&] {
    gather(slots, e, w);
    e.law->forces(batch);
    scatter(slots, e, chunk, w);
    batch.count = 0;
  };
  const std::size_t end = chunk_begin_[chunk + 1];
  const Place* const place = slots.place.data();
  for (std::size_t k = chunk_begin_[chunk]; k < end; ++k) {
    if (k + kPrefetch < end) __builtin_prefetch(&place[pairs_[k + kPrefetch].b]);
    const Pair pair = pairs_[k];
    const Place &a = place[pair.a], &b = place[pair.b];
    const Vec3 apart = b.position - a.position;
    const double distance2 = squared_norm(apart), radii = a.radius + b.radius + e.reach;
    if (!(distance2 < radii * radii)) {
      if ((flags_[k] & kTouching) != 0) let_go(k);
      continue;
    }
    const std::size_t lane = batch.count;
    w.pair[lane] = static_cast<std::uint32_t>(k);
    w.distance2[lane] = distance2;
    w.apart.set(lane, apart);
    w.radius_a[lane] = a.radius, w.radius_b[lane] = b.radius;
    if (++batch.count == kLanes) flush();
  }
  if (batch.count > 0) flush();
  return w.tally;
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
    const Twist &ta = slots.twist[pair.a], &tb = slots.twist[pair.b];
    const Vec3 apart = b.position - a.position;
    const double distance = norm(apart), gap = distance - a.radius - b.radius;
    const Vec3 n = (1.0 / distance) * apart;
    const ContactFrame frame = contact_frame(n);
    const Vec3 after = tb.linear - ta.linear - cross(a.radius * ta.angular + b.radius * tb.angular, n);
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
