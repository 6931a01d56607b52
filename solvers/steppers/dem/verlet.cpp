#include "verlet.hpp"

#include <algorithm>
#include <cmath>

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
    const Vec3& force = slots.field_force[k];
    const Vec3 torque = turns ? slots.field_torque[k] : Vec3{};
    Twist& old = slots.old[k];
    const Vec3 a = body.inverse_mass * (contact.force + force);
    const Vec3 alpha = slots.inverse_moment[k] * (contact.torque + torque);
    const Vec3 v = body.linear + correct * (a - old.linear), w = body.angular + correct * (alpha - old.angular);
    const Vec3 mean = v + work.shift * a;
    // Of bodies of `turning`, turn_chunk() counts it.
    const Vec3 mean_spin = slots.inverse_moment[k] > 0.0 ? w + work.shift * alpha : Vec3{};
    out.contact_work += work.impulse_time * (dot(contact.force, mean) + dot(contact.torque, mean_spin));
    out.force_work += work.impulse_time * (dot(force, mean) + dot(torque, mean_spin));
    place.position += ahead * (v + (0.5 * ahead) * a);
    body.linear = v + ahead * a;
    body.angular = w + ahead * alpha;
    old = {a, alpha};
    fastest2 = std::max(fastest2, squared_norm(body.linear));
  }
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
      if (ahead > 0.0) {
        const Vec3 w = angular_velocity(q, t.inverse_inertia, half);
        const Quat middle = normalized(from_rotation_vector((0.5 * ahead) * w) * q);
        const Vec3 w_middle = angular_velocity(middle, t.inverse_inertia, half);
        q = normalized(from_rotation_vector(ahead * w_middle) * q);
      }
      t.momentum = half + (0.5 * ahead) * torque;
      t.torque = torque;
      spin = angular_velocity(q, t.inverse_inertia, t.momentum);
    } else if (spin != Vec3{} && ahead > 0.0) {
      q = normalized(from_rotation_vector(ahead * spin) * q);
    }
    t.load.work += work.impulse_time * (dot(contact.force, mean.linear) + dot(contact.torque, mean.angular));
    const double turn = norm(spin);
    if (turn > 0.0) out.fastest = std::max(out.fastest, norm(slots.moving[t.slot].linear) + turn * slots.reach[k]);
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
  for (ContactLoad& load : slots.standing) {
    load.impulse += impulse_time * slots.wrench[load.body].force;
    load.angular_impulse += impulse_time * slots.wrench[load.body].torque;
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
