// What BallContacts tells of an outer step.
#include <algorithm>

#include "ball_contacts.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr std::size_t kPrefetch = 16;  // neighbours ahead

}  // namespace

void BallContacts::begin_step(const Executor& executor) {
  executor.for_chunks(list_.flags.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if ((list_.flags[k] & kTouched) == 0) continue;
      list_.flags[k] = static_cast<std::uint8_t>(list_.flags[k] & (kTouching | kLeaving));
      list_.records[stride_ * k + springs_ - 1][3] = 0.0;
      for (std::size_t q = springs_; q < stride_; ++q) list_.records[stride_ * k + q] = Lanes{};
    }
  });
}

void BallContacts::report(const Slots& slots, const Executor& executor, ContactRecords& out) const {
  std::vector<std::size_t> begin(Executor::chunk_count(list_.pairs.size(), kGrain) + 1, 0);
  executor.for_chunks(list_.pairs.size(), kGrain, [&](std::size_t first, std::size_t last) {
    std::size_t count = 0;
    for (std::size_t p = first; p < last; ++p) count += list_.flags[list_.place[p]] / kTouched & 1;
    begin[first / kGrain + 1] = count;
  });
  for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
  out.resize(begin.back(), rolls_);
  executor.for_chunks(list_.pairs.size(), kGrain, [&](std::size_t first, std::size_t last) {
    std::size_t to = begin[first / kGrain];
    for (std::size_t p = first; p < last; ++p) {
      // Neighbours are in the order of bodies, what is kept of them in that of space.
      const std::size_t soon = list_.place[std::min(p + kPrefetch, list_.pairs.size() - 1)];
      __builtin_prefetch(&list_.records[stride_ * soon]);
      __builtin_prefetch(&list_.before[soon]);
      if (soon < pairs_.size()) __builtin_prefetch(&pairs_[soon]);
      if ((list_.flags[list_.place[p]] & kTouched) != 0) report_one(slots, p, to++, out);
    }
  });
}

void BallContacts::report_one(const Slots& slots, std::size_t neighbour, std::size_t to, ContactRecords& out) const {
  const std::size_t at = list_.place[neighbour];
  Vec3 normal, point, after;
  double gap = 0.0;
  if (at < pairs_.size()) {
    const Pair& pair = pairs_[at];
    const Place &a = slots.place[pair.a], &b = slots.place[pair.b];
    const Moving &ma = slots.moving[pair.a], &mb = slots.moving[pair.b];
    const Vec3 apart = b.position - a.position;
    const double distance = norm(apart);
    gap = distance - a.radius - b.radius;
    normal = distance > 0.0 ? (1.0 / distance) * apart : Vec3{0, 0, 1};
    point = a.position + (a.radius + 0.5 * gap) * normal;
    after = mb.linear - ma.linear - cross(a.radius * ma.angular + b.radius * mb.angular, normal);
  } else {
    const FlatPair& pair = flat_pairs_[at - pairs_.size()];
    const Flat& flat = slots.flats[pair.flat];
    const Place& ball = slots.place[pair.ball];
    const Moving& moving = slots.moving[pair.ball];
    const double towards_b = pair.ball_is_b ? 1.0 : -1.0;
    gap = dot(flat.normal, ball.position) - flat.offset - ball.radius;
    normal = towards_b * flat.normal;
    point = ball.position - (ball.radius + 0.5 * gap) * flat.normal;
    after = towards_b * moving.linear - cross(ball.radius * moving.angular, normal);
  }
  const ContactFrame frame = contact_frame(normal);
  const Lanes* const record = list_.records.data() + stride_ * at + springs_;
  const auto vector = [](const Lanes& of) { return Vec3{of[0], of[1], of[2]}; };
  out.contact[to] = {
      .a = list_.pairs[neighbour].a, .b = list_.pairs[neighbour].b, .point = point, .normal = normal, .gap = gap};
  out.impulse[to] = to_contact(frame, vector(record[0]));
  if (rolls_) out.angular_impulse[to] = to_contact(frame, vector(record[1]));
  out.work[to] = record[-1][3];
  out.before[to] = to_contact(frame, list_.before[at]);
  out.after[to] = to_contact(frame, after);
}

std::size_t BallContacts::memory() const {
  const auto bytes = [](const auto&... columns) { return ((columns.capacity() * sizeof(*columns.data())) + ...); };
  const auto of = [&](const List& list) {
    return bytes(list.pairs, list.place, list.begin, list.records, list.flags, list.before);
  };
  return bytes(pairs_, flat_pairs_, incoming_, given_begin_) + of(list_) + std::max(of(list_), of(old_));
}

}  // namespace scree::dem
