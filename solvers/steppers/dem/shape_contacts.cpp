#include "shape_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "scree/math/contact_frame.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/state/state_io.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kLanes = ContactBatch::kMost;
/// A contact that goes on under another name turns by less than this from one sub-step to the next: 60 degrees.
constexpr double kSameWay = 0.5;
/// Contact laws leave a factor of five between the stable step of one contact and theirs, for a body that many hold. That is
/// enough where contacts lie all around, as those of balls. Faces push along one direction, and turn bodies: a hull between eight
/// others needs 5.3 with dashpots beyond critical, and shook. So many points more share the mass, as far as the step is concerned.
constexpr std::size_t kCrowd = 2;

auto pair_of(const ContactKey& key) { return std::tie(key.a, key.b, key.primitive_a, key.primitive_b); }

/// Radius of curvature where a body is touched, as far as a contact law asks for it [m]: of walls infinite.
double radius_of(const Slots& slots, const BodyView& bodies, BodyIndex i) {
  const double ball = slots.place[slots.slot_of[i]].radius;
  if (ball > 0.0) return ball;
  return bodies.motion[i] == Motion::dynamic ? bodies.radius[i] : std::numeric_limits<double>::infinity();
}

}  // namespace

/// Some of the active contacts on their way through the law.
struct ShapeContacts::Work {
  ContactBatch batch;
  std::size_t first = 0;  // of them
  std::array<double, kLanes> acting, overlap;
  std::array<bool, kLanes> leaving;
  std::array<Arms, kLanes> arms;
  std::array<double, kLanes> smaller;
  std::array<Vec3, kLanes> slip;
  ContactTally tally;
};

void ShapeContacts::begin_step(const BodyView& bodies) {
  std::erase_if(entries_, [&](const Entry& e) {
    return !e.touching || !std::ranges::binary_search(bodies.id, e.key.a) ||
           !std::ranges::binary_search(bodies.id, e.key.b);
  });
  const auto index = [&](BodyId id) {
    return static_cast<BodyIndex>(std::ranges::lower_bound(bodies.id, id) - bodies.id.begin());
  };
  active_.clear();
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    Entry& e = entries_[k];
    e.impulse = e.moment = {};
    e.work = 0.0;
    e.contact.a = index(e.key.a), e.contact.b = index(e.key.b);
    active_.push_back(k);  // all that is left touches
  }
}

/// Most sub-steps find the contacts of the one before, and nothing is to be matched.
bool ShapeContacts::is_as_before(const BodyView& bodies, std::span<const Contact> found) {
  if (found.size() != active_.size()) return false;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Entry& entry = entries_[active_[k]];
    if (!entry.touching || entry.key != contact_key(bodies, found[k])) return false;
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    Entry& entry = entries_[active_[k]];
    entry.contact = found[k];
    entry.is_new = false;
  }
  return true;
}

/// One walk through the entries and the contacts found now, both sorted by key.
void ShapeContacts::match(const BodyView& bodies, std::span<const Contact> found) {
  if (is_as_before(bodies, found)) return;
  merged_.clear();
  active_.clear();
  std::size_t old = 0, group = 0;
  const auto take = [&](const Entry& entry) {
    if (!merged_.empty() && pair_of(merged_.back().key) != pair_of(entry.key)) {
      inherit(group, merged_.size());
      group = merged_.size();
    }
    merged_.push_back(entry);
  };
  const auto end_old = [&] {
    // What touched until now keeps its history until inherit() has looked at it.
    Entry entry = entries_[old++];
    entry.is_new = entry.touching;  // just ended
    entry.touching = false;
    take(entry);
  };
  for (const Contact& c : found) {
    const ContactKey key = contact_key(bodies, c);
    while (old < entries_.size() && entries_[old].key < key) end_old();
    if (old < entries_.size() && entries_[old].key == key) {
      Entry entry = entries_[old++];
      entry.is_new = !entry.touching;
      entry.touching = true;
      entry.contact = c;
      take(entry);
    } else {
      Entry entry;
      entry.key = key;
      entry.contact = c;
      entry.touching = true;
      take(entry);
    }
  }
  while (old < entries_.size()) end_old();
  inherit(group, merged_.size());
  std::swap(entries_, merged_);
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].touching) active_.push_back(k);
  }
}

/// Among the entries of one pair of primitives: a new contact goes on where one that has just ended left off.
void ShapeContacts::inherit(std::size_t first, std::size_t last) {
  for (std::size_t k = first; k < last; ++k) {
    Entry& born = merged_[k];
    if (!born.touching || !born.is_new) continue;
    Entry* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = first; j < last; ++j) {
      Entry& ended = merged_[j];
      if (ended.touching || !ended.is_new || dot(ended.contact.normal, born.contact.normal) < kSameWay) continue;
      const double distance = squared_norm(ended.contact.point - born.contact.point);
      if (distance < least) least = distance, nearest = &ended;
    }
    if (nearest == nullptr) {
      born.history = {};
      continue;
    }
    born.history = nearest->history;
    born.before = nearest->before;
    born.leaving = nearest->leaving;
    born.is_new = false;
    nearest->is_new = false;
  }
  for (std::size_t k = first; k < last; ++k) {
    if (merged_[k].touching) continue;
    merged_[k].is_new = false;
    merged_[k].history = {};
  }
}

ShapeContacts::Arms ShapeContacts::arms(const Slots& slots, const Contact& c, bool at_contact_point) {
  // The undeformed surfaces lie half the overlap beyond the point between them.
  const Vec3 sunk = (at_contact_point ? 0.0 : -0.5 * c.gap) * c.normal;
  return {c.point + sunk - slots.place[slots.slot_of[c.a]].position,
          c.point - sunk - slots.place[slots.slot_of[c.b]].position};
}

/// What surfaces that move against their bodies add to the velocity of b's surface relative to a's [m/s]. A belt moves in its own
/// plane and does not push.
Vec3 ShapeContacts::belt_slip(const BodyView& bodies, const Contact& c, const Arms& arms) {
  if (bodies.surface_motion.empty()) return {};
  const Twist a = surface_motion(bodies, c.a), b = surface_motion(bodies, c.b);
  const Vec3 slip = b.linear + cross(b.angular, arms.b) - a.linear - cross(a.angular, arms.a);
  return slip - dot(slip, c.normal) * c.normal;
}

Vec3 ShapeContacts::surface_velocity(const Slots& slots, const BodyView& bodies, const Contact& c, const Arms& arms) {
  const Moving &a = slots.moving[slots.slot_of[c.a]], &b = slots.moving[slots.slot_of[c.b]];
  return b.linear + cross(b.angular, arms.b) - a.linear - cross(a.angular, arms.a) + belt_slip(bodies, c, arms);
}

/// Active contacts are in order of bodies: those of a pair lie together.
void ShapeContacts::share_mass(const Slots& slots) {
  share_.resize(active_.size());
  for (std::size_t first = 0; first < active_.size();) {
    const Contact& c = entries_[active_[first]].contact;
    std::size_t last = first + 1;
    const auto same = [&](const Contact& o) { return o.a == c.a && o.b == c.b; };
    while (last < active_.size() && same(entries_[active_[last]].contact)) ++last;
    const bool ball = slots.place[slots.slot_of[c.a]].radius > 0.0 || slots.place[slots.slot_of[c.b]].radius > 0.0;
    most_points_ = std::max(most_points_, ball ? last - first : kCrowd * std::max<std::size_t>(4, last - first));
    std::fill(share_.begin() + static_cast<std::ptrdiff_t>(first), share_.begin() + static_cast<std::ptrdiff_t>(last),
              1.0 / static_cast<double>(last - first));
    first = last;
  }
}

void ShapeContacts::gather(const Slots& slots, const BodyView& bodies, const Evaluation& e, Work& w) const {
  ContactBatch& batch = w.batch;
  batch.lead = 0.5 * e.h;
  const ContactTiming timing{e};
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Entry& entry = entries_[active_[w.first + k]];
    const Contact& c = entry.contact;
    const Moving &a = slots.moving[slots.slot_of[c.a]], &b = slots.moving[slots.slot_of[c.b]];
    w.arms[k] = arms(slots, c, e.at_contact_point);
    const Vec3 v = surface_velocity(slots, bodies, c, w.arms[k]);
    const double overlap = -c.gap, approach = -dot(v, c.normal);
    const double ra = radius_of(slots, bodies, c.a), rb = radius_of(slots, bodies, c.b);
    batch.radius[k] = 1.0 / (1.0 / ra + 1.0 / rb);
    batch.mass[k] = share_[w.first + k] / (a.inverse_mass + b.inverse_mass);
    batch.normal.set(k, c.normal);
    batch.velocity.set(k, v);
    batch.spin.set(k, b.angular - a.angular);
    batch.materials[k] = static_cast<std::uint32_t>(slots.material[slots.slot_of[c.a]] * e.materials +
                                                    slots.material[slots.slot_of[c.b]]);
    const Acting acting = timing.of({entry.is_new ? 1.0 : 0.0, entry.leaving ? 1.0 : 0.0}, overlap, approach);
    w.overlap[k] = overlap;
    batch.overlap[k] = overlap + acting.shift;
    batch.ahead[k] = acting.ahead;
    w.acting[k] = acting.part;
    w.leaving[k] = acting.leaving != 0.0;
    for (std::size_t j = 0; j < e.history; ++j) batch.history[j][k] = entry.history[j];
    w.slip[k] = belt_slip(bodies, c, w.arms[k]);
    w.smaller[k] = std::min(a.is_dynamic() ? bodies.radius[c.a] : std::numeric_limits<double>::infinity(),
                            b.is_dynamic() ? bodies.radius[c.b] : std::numeric_limits<double>::infinity());
  }
}

void ShapeContacts::scatter(const Evaluation& e, Work& w) {
  const double time = kick_time(e);
  for (std::size_t k = 0; k < w.batch.count; ++k) {
    Entry& entry = entries_[active_[w.first + k]];
    const Vec3 force = w.acting[k] * w.batch.force[k];
    const Vec3 torque = e.rolls ? w.acting[k] * w.batch.torque[k] : Vec3{};
    on_a_[w.first + k] = {.force = -force, .torque = cross(w.arms[k].a, -force) - torque};
    on_b_[w.first + k] = {.force = force, .torque = cross(w.arms[k].b, force) + torque};
    if (entry.impulse == Vec3{} && (entry.is_new || e.stage == Stage::first)) entry.before = w.batch.velocity[k];
    entry.leaving = w.leaving[k];
    entry.impulse += time * force;
    entry.moment += time * torque;
    entry.work -= time * (dot(force, w.batch.velocity[k]) + dot(torque, w.batch.spin[k]));
    for (std::size_t j = 0; j < e.history; ++j) entry.history[j] = w.batch.history[j][k];
    w.tally.belt_work -= time * dot(force, w.slip[k]);
    w.tally.greatest_overlap = std::max(w.tally.greatest_overlap, w.overlap[k]);
    if (e.stage == Stage::last && w.overlap[k] > 0.0) w.tally.add(w.overlap[k], w.smaller[k]);
  }
}

ContactTally ShapeContacts::evaluate(Slots& slots, const BodyView& bodies, std::span<const Contact> found,
                                     const Evaluation& e, const Executor& executor) {
  if (found.empty() && entries_.empty()) return {};
  match(bodies, found);
  share_mass(slots);
  on_a_.resize(active_.size()), on_b_.resize(active_.size());
  tally_.assign(Executor::chunk_count(active_.size(), kLanes), ContactTally{});
  executor.for_chunks(active_.size(), kLanes, [&](std::size_t first, std::size_t last) {
    Work w;
    w.first = first;
    w.batch.count = last - first;
    gather(slots, bodies, e, w);
    e.law->forces(w.batch);
    scatter(e, w);
    tally_[first / kLanes] = w.tally;
  });
  ContactTally sum;
  for (const ContactTally& tally : tally_) sum += tally;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const Contact& c = entries_[active_[k]].contact;
    slots.wrench[slots.slot_of[c.a]] += on_a_[k];
    slots.wrench[slots.slot_of[c.b]] += on_b_[k];
  }
  return sum;
}

void ShapeContacts::report(const Slots& slots, const BodyView& bodies, bool rolls, ContactRecords& out) const {
  for (const Entry& entry : entries_) {
    if (entry.impulse == Vec3{} && entry.contact.gap > 0.0) continue;  // within reach of a law, but not held
    const ContactFrame frame = contact_frame(entry.contact.normal);
    const Vec3 after = surface_velocity(slots, bodies, entry.contact, arms(slots, entry.contact, false));
    out.contact.push_back(entry.contact);
    out.impulse.push_back(to_contact(frame, entry.impulse));
    if (rolls) out.angular_impulse.push_back(to_contact(frame, entry.moment));
    out.before.push_back(to_contact(frame, entry.before));
    out.after.push_back(to_contact(frame, after));
    out.work.push_back(entry.work);
  }
}

void ShapeContacts::save(StateWriter& out, std::size_t history) const {
  std::vector<std::uint64_t> keys;
  std::vector<double> values;
  for (const Entry& e : entries_) {
    if (!e.touching) continue;
    keys.insert(keys.end(),
                {e.key.a, e.key.b, e.key.primitive_a, e.key.primitive_b, e.key.feature, e.leaving ? 1U : 0U});
    values.insert(values.end(), e.history.begin(), e.history.begin() + static_cast<std::ptrdiff_t>(history));
    const Vec3 &point = e.contact.point, &normal = e.contact.normal;
    values.insert(values.end(), {point.x, point.y, point.z, normal.x, normal.y, normal.z});
  }
  out.write("shape_keys", keys);
  out.write("shape_history", values);
}

void ShapeContacts::load(const StateReader& in, std::size_t history) {
  const std::vector<std::uint64_t> keys = in.integers("shape_keys");
  const std::vector<double> values = in.doubles("shape_history");
  entries_.assign(keys.size() / 6, Entry{});
  const double* value = values.data();
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    Entry& e = entries_[k];
    const std::uint64_t* const key = keys.data() + 6 * k;
    e.key = {key[0], key[1], static_cast<std::uint32_t>(key[2]), static_cast<std::uint32_t>(key[3]), key[4]};
    e.touching = true;
    e.leaving = key[5] != 0;
    std::copy_n(value, history, e.history.begin());
    value += history;
    e.contact.point = {value[0], value[1], value[2]};
    e.contact.normal = {value[3], value[4], value[5]};
    value += 6;
  }
}

}  // namespace scree::dem
