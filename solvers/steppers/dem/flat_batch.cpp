// What BallContacts does with a batch of contacts of balls with flats: few beside those of two balls, and one at a time.
#include <cmath>

#include "ball_contacts.hpp"
#include "ball_work.hpp"

namespace scree::dem {

/// As look_at(), with the overlap in the fourth lane.
void BallContacts::look_at_flats(const Slots& slots, double reach, std::size_t first, std::size_t last,
                                 BallWork& w) const {
  w.first = pairs_.size();
  std::size_t hits = 0, parted = 0;
  for (std::size_t k = first; k < last; ++k) {
    const Place& ball = slots.place[flat_pairs_[k].ball];
    const Flat& flat = slots.flats[flat_pairs_[k].flat];
    const double overlap = ball.radius + flat.offset - dot(flat.normal, ball.position);
    const unsigned touch = overlap > -reach ? 1 : 0;
    w.apart[hits] = Lanes{ball.position.x, ball.position.y, ball.position.z, overlap};
    w.hit[hits] = w.gone[parted] = static_cast<std::uint32_t>(k);
    hits += touch;
    parted += (1 - touch) & (list_.flags[w.first + k] & kTouching);
  }
  w.batch.count = hits;
  w.parted = parted;
  fill_lanes(w);
}

void BallContacts::measure_flats(const Slots& slots, const Evaluation& e, BallWork& w) const {
  const double sunk = e.at_contact_point ? 0.5 : 0.0;
  for (std::size_t k = 0; k < padded(w.batch.count); ++k) {
    const FlatPair& pair = flat_pairs_[w.hit[k]];
    const double radius = slots.place[pair.ball].radius, overlap = w.apart[k][3];
    const Vec3& out = slots.flats[pair.flat].normal;
    w.batch.normal.set(k, pair.ball_is_b ? out : -out);
    w.overlap[k] = overlap;
    w.batch.radius[k] = w.radius_a[k] = w.radius_b[k] = radius;
    w.arm_a[k] = radius - sunk * overlap;  // of the ball, whichever it is
  }
}

void BallContacts::gather_flats(const Slots& slots, const Evaluation& e, BallWork& w) const {
  ContactBatch& batch = w.batch;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const FlatPair& pair = flat_pairs_[w.hit[k]];
    const Moving& ball = slots.moving[pair.ball];
    const double towards_b = pair.ball_is_b ? 1.0 : -1.0;
    batch.velocity.set(k, towards_b * ball.linear);
    w.rim.set(k, w.arm_a[k] * ball.angular);
    if (rolls_) batch.spin.set(k, towards_b * ball.angular);
    w.inverse_mass[k] = ball.inverse_mass;
    const std::size_t own = slots.material[pair.ball], other = slots.material[slots.flats[pair.flat].slot];
    batch.materials[k] =
        static_cast<std::uint32_t>(pair.ball_is_b ? other * e.materials + own : own * e.materials + other);
  }
}

void BallContacts::scatter_flats(Slots& slots, const Evaluation& e, BallWork& w) const {
  for (std::size_t k = 0; k < w.batch.count; ++k) {
    const FlatPair& pair = flat_pairs_[w.hit[k]];
    const Flat& flat = slots.flats[pair.flat];
    const double towards_b = pair.ball_is_b ? 1.0 : -1.0;
    const Vec3 force = towards_b * w.batch.force[k];
    const Vec3 torque = rolls_ ? towards_b * w.batch.torque[k] : Vec3{};
    Wrench &on_ball = slots.wrench[pair.ball], &on_flat = slots.wrench[pair.to_flat];
    on_ball.force += force;
    on_ball.torque += torque - w.arm_a[k] * w.lever[k];
    // Where the force acts on the flat: at its surface, or midway.
    const double sunk = e.at_contact_point ? w.arm_a[k] : w.radius_a[k] - w.overlap[k];
    const Vec3 at = Vec3{w.apart[k][0], w.apart[k][1], w.apart[k][2]} - sunk * flat.normal;
    on_flat.force -= force;
    on_flat.torque -= cross(at - flat.centre, force) + torque;
  }
}

}  // namespace scree::dem
