#include "verlet.hpp"

#include <algorithm>
#include <cmath>

#include "four.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

/// Work of a force f over the kick(s) about the present time, whose velocity is v and acceleration a: an impulse times the mean of
/// the velocities before and after it.
struct KickWork {
  double impulse_time = 0.0;  ///< [s]
  double shift = 0.0;         ///< from the present velocity to the mean one, in accelerations [s]
};

KickWork kick_work(double h, Stage stage) {
  switch (stage) {
    case Stage::first:
      return {0.5 * h, 0.25 * h};
    case Stage::last:
      return {0.5 * h, -0.25 * h};
    case Stage::middle:
      break;
  }
  return {h, 0.0};
}

}  // namespace

void Verlet::move_chunk(Slots& slots, double h, Stage stage, std::size_t first, std::size_t last, Motions& out) const {
  const KickWork work = kick_work(h, stage);
  const double correct = stage == Stage::first ? 0.0 : 0.5 * h, ahead = stage == Stage::last ? 0.0 : h;
  const bool turns = !slots.field_torque.empty();
  // Four numbers at a time: behind a velocity lies the inverse mass, behind a place the radius, behind the rest zero.
  constexpr Lanes kVector{1.0, 1.0, 1.0, 0.0};
  Lanes contact_work{}, force_work{};
  double fastest2 = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    Moving& body = slots.moving[k];
    Place& place = slots.place[k];
    const Wrench& contact = slots.wrench[k];
    if (!body.is_dynamic()) {
      out.boundary_work -= work.impulse_time * (dot(contact.force, body.linear) + dot(contact.torque, body.angular));
      place.position += ahead * body.linear;
      fastest2 = std::max(fastest2, squared_norm(body.linear));
      continue;
    }
    const Lanes pull = four_of(contact), turn = four_of(contact, 1), force = slots.field_force[k];
    const Lanes torque = turns ? four_of(slots.field_torque[k], 0.0) : Lanes{};
    Accelerations& old = slots.old[k];
    const Lanes a = body.inverse_mass * (pull + force), alpha = slots.inverse_moment[k] * (turn + torque);
    const Lanes v = four_of(body) + correct * (a - four_of(old));
    const Lanes w = four_of(body, 1) + correct * (alpha - four_of(old, 1));
    // Of bodies of `turning`, turn_chunk() counts what torques do.
    const double counts = slots.inverse_moment[k] > 0.0 ? 1.0 : 0.0;
    const Lanes mean = v + work.shift * a, mean_spin = counts * (w + work.shift * alpha);
    contact_work += pull * mean + turn * mean_spin;
    force_work += force * mean + torque * mean_spin;
    const Lanes drift = v + (0.5 * ahead) * a;
    set_four(four_of(place) + (ahead * kVector) * drift, place);
    set_four(v + ahead * a, body);
    set_four(w + ahead * alpha, body, 1);
    set_four(a, old);
    set_four(alpha, old, 1);
    fastest2 = std::max(fastest2, drift[0] * drift[0] + drift[1] * drift[1] + drift[2] * drift[2]);
  }
  out.contact_work += work.impulse_time * (contact_work[0] + contact_work[1] + contact_work[2]);
  out.force_work += work.impulse_time * (force_work[0] + force_work[1] + force_work[2]);
  out.fastest = std::max(out.fastest, std::sqrt(fastest2));
}

// After move_chunk(), which left alone the angular part of these bodies. Kicks do work at one orientation, impulse times the mean
// of the angular velocities before and after; the drift between them keeps the energy to the third order in the step.
void Verlet::turn_chunk(Slots& slots, double h, Stage stage, std::size_t first, std::size_t last, Motions& out) const {
  const KickWork work = kick_work(h, stage);
  const double correct = stage == Stage::first ? 0.0 : 0.5 * h, ahead = stage == Stage::last ? 0.0 : h;
  for (std::size_t k = first; k < last; ++k) {
    Turning& t = slots.turning[k];
    const Wrench& contact = slots.wrench[t.slot];
    Vec3& spin = slots.moving[t.slot].angular;
    Quat& q = t.orientation;
    Twist mean{slots.moving[t.slot].linear, spin};
    double speed = norm(mean.linear), turn = norm(spin);  // of the drift
    t.load.impulse += work.impulse_time * contact.force;
    t.load.angular_impulse += work.impulse_time * contact.torque;
    if (slots.moving[t.slot].is_dynamic()) {
      const Vec3 torque = contact.torque + (slots.field_torque.empty() ? Vec3{} : slots.field_torque[t.slot]);
      t.momentum += correct * (torque - t.torque);
      mean.linear += (work.shift - ahead) * slots.old[t.slot].linear;  // move_chunk() has moved it on
      mean.angular = angular_velocity(q, t.inverse_inertia, t.momentum + work.shift * torque);
      out.contact_work += work.impulse_time * dot(contact.torque, mean.angular);
      out.force_work += work.impulse_time * dot(torque - contact.torque, mean.angular);
      const Vec3 half = t.momentum + (0.5 * ahead) * torque;
      speed = norm(slots.moving[t.slot].linear - (0.5 * ahead) * slots.old[t.slot].linear);
      if (ahead > 0.0) {
        const Vec3 w = angular_velocity(q, t.inverse_inertia, half);
        const Quat middle = normalized(from_rotation_vector((0.5 * ahead) * w) * q);
        const Vec3 w_middle = angular_velocity(middle, t.inverse_inertia, half);
        q = normalized(from_rotation_vector(ahead * w_middle) * q);
        turn = norm(w_middle);
      }
      t.momentum = half + (0.5 * ahead) * torque;
      t.torque = torque;
      spin = angular_velocity(q, t.inverse_inertia, t.momentum);
    } else if (spin != Vec3{} && ahead > 0.0) {
      q = normalized(from_rotation_vector(ahead * spin) * q);
    }
    t.load.work += work.impulse_time * (dot(contact.force, mean.linear) + dot(contact.torque, mean.angular));
    if (turn > 0.0) out.fastest = std::max(out.fastest, speed + turn * slots.reach[k]);
  }
}

Motions Verlet::advance(Slots& slots, double h, Stage stage, const Executor& executor) {
  const std::size_t chunks = Executor::chunk_count(slots.size(), kChunk),
                    turning = Executor::chunk_count(slots.turning.size(), kChunk);
  partial_.assign(chunks + turning, Motions{});
  executor.for_chunks(slots.size(), kChunk, [&](std::size_t first, std::size_t last) {
    move_chunk(slots, h, stage, first, last, partial_[first / kChunk]);
  });
  executor.for_chunks(slots.turning.size(), kChunk, [&](std::size_t first, std::size_t last) {
    turn_chunk(slots, h, stage, first, last, partial_[chunks + first / kChunk]);
  });
  const double impulse_time = kick_work(h, stage).impulse_time;
  for (Standing& body : slots.standing) {
    body.load.impulse += impulse_time * slots.wrench[body.slot].force;
    body.load.angular_impulse += impulse_time * slots.wrench[body.slot].torque;
  }
  Motions sum;
  for (const Motions& part : partial_) {
    sum.contact_work += part.contact_work;
    sum.boundary_work += part.boundary_work;
    sum.force_work += part.force_work;
    sum.fastest = std::max(sum.fastest, part.fastest);
  }
  return sum;
}

}  // namespace scree::dem
