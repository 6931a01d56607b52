// ContactDrive: one contact in time, for tests of contact laws: a ball on the half space z < 0, or two balls. Velocity Verlet with
// predicted velocities; a force stands for half a step on either side of it, less where the contact begins or ends.
//
//     ContactDrive drive{law, {.position = {0, 0, r}, .velocity = {0, 0, -1}, .radius = r, .mass = m}};
//     drive.run(1e-7);
//     EXPECT_NEAR(drive.ball.velocity.z, restitution, 1e-6);
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "scree/interfaces/contact_law.hpp"

namespace scree::test {

/// A solid ball, m R^2 2/5 about its centre; world.
struct DrivenBall {
  Vec3 position = {};  ///< [m]
  Vec3 velocity = {};  ///< [m/s]
  Vec3 spin = {};      ///< [rad/s]
  double radius = 1.0;
  double mass = 1.0;  ///< [kg]

  Vec3 old_push = {}, old_twist = {};  ///< accelerations of the step before
};

class ContactDrive {
 public:
  ContactDrive(const ContactLaw& law, const DrivenBall& on_the_floor) : ball{on_the_floor}, law_{law} {}
  ContactDrive(const ContactLaw& law, const DrivenBall& a, const DrivenBall& b) : ball{b}, other{a}, law_{law} {}

  DrivenBall ball;                  ///< body b
  std::optional<DrivenBall> other;  ///< body a; the floor when there is none
  Vec3 gravity = {};                ///< [m/s2]
  std::uint32_t materials = 0;      ///< as ContactBatch::materials

  double deepest = 0.0;          ///< greatest overlap so far [m]
  double hardest = 0.0;          ///< greatest normal force so far [N]
  double weakest = 0.0;          ///< least normal force so far [N]
  double contact_time = 0.0;     ///< that the surfaces were on each other [s]
  double time = 0.0;             ///< [s]
  double overlap = 0.0;          ///< now [m]
  Vec3 force = {}, torque = {};  ///< now, on b

  /// One step of h [s].
  void step(double h) {
    evaluate(h);
    move(ball, force, torque, h);
    if (other) move(*other, -force, -torque, h);
    time += h;
    started_ = true;
  }
  /// Steps until the bodies have met and parted, at most `most` of them. False when they did not part.
  bool run(double h, int most = 100'000'000) {
    bool met = false;
    for (int count = 0; count < most; ++count) {
      step(h);
      met |= touching_;
      if (met && !touching_) return true;
    }
    return false;
  }
  [[nodiscard]] bool touching() const { return touching_; }
  /// Of both bodies [J].
  [[nodiscard]] double kinetic_energy() const { return energy(ball) + (other ? energy(*other) : 0.0); }

 private:
  static double energy(const DrivenBall& body) {
    return 0.5 * body.mass * (squared_norm(body.velocity) + 0.4 * body.radius * body.radius * squared_norm(body.spin));
  }

  void evaluate(double h) {
    const Vec3 apart = other ? ball.position - other->position : Vec3{0.0, 0.0, ball.position.z};
    const double distance = norm(apart);
    const Vec3 n = apart / distance;
    overlap = ball.radius + (other ? other->radius : 0.0) - distance;
    batch_.radius[0] = other ? 1.0 / (1.0 / ball.radius + 1.0 / other->radius) : ball.radius;
    force = torque = {};
    const bool was = touching_;
    touching_ = overlap >= -law_.reach(batch_.radius[0]) && (was || overlap >= 0.0);
    if (!touching_) return;
    if (!was)
      for (ContactBatch::Lane& lane : batch_.history) lane[0] = 0.0;
    batch_.mass[0] = other ? 1.0 / (1.0 / ball.mass + 1.0 / other->mass) : ball.mass;
    const Vec3 of_a = other ? other->velocity + cross(other->spin, other->radius * n) : Vec3{};
    const Vec3 v = ball.velocity + cross(ball.spin, -ball.radius * n) - of_a;
    const double closing = -dot(v, n), since = overlap < closing * h ? std::max(overlap, 0.0) / closing : h;
    fill(n, v, was ? 0.5 * h : (started_ ? since : 0.0), 0.5 * h);
    law_.forces(batch_);
    force = batch_.force[0];
    if (law_.resists_rolling()) torque = batch_.torque[0];
    deepest = std::max(deepest, overlap);
    hardest = std::max(hardest, dot(force, n)), weakest = std::min(weakest, dot(force, n));
    // The part of a step for which the contact lasts on either side.
    double part = 1.0, lasts = h;
    if (law_.reach(batch_.radius[0]) == 0.0) {
      const double before = was ? 0.5 * h : (started_ ? since : 0.0);
      const double after = overlap < -closing * h ? std::max(overlap, 0.0) / -closing : 0.5 * h;
      lasts = before + after;
      part = lasts / (started_ ? h : 0.5 * h);  // the first kick is half a step long
    }
    contact_time += lasts;
    force *= part, torque *= part;
  }
  void fill(const Vec3& n, const Vec3& v, double ahead, double lead) {
    batch_.count = 1;
    batch_.overlap[0] = overlap;
    batch_.normal.set(0, n);
    batch_.velocity.set(0, v);
    batch_.spin.set(0, ball.spin - (other ? other->spin : Vec3{}));
    batch_.materials[0] = materials;
    batch_.ahead[0] = ahead;
    batch_.lead = lead;
  }
  // `push` and `twist` act on the body at its surface towards the other one.
  void move(DrivenBall& body, const Vec3& push, const Vec3& twist, double h) const {
    const Vec3 n = batch_.count > 0 ? batch_.normal[0] : Vec3{};
    const Vec3 arm = (&body == &ball ? -body.radius : body.radius) * n;
    const Vec3 a = push / body.mass + gravity;
    const Vec3 alpha = (twist + cross(arm, push)) / (0.4 * body.mass * body.radius * body.radius);
    const double correct = started_ ? 0.5 * h : 0.0;
    body.velocity += correct * (a - body.old_push);
    body.spin += correct * (alpha - body.old_twist);
    body.position += h * (body.velocity + (0.5 * h) * a);
    body.velocity += h * a, body.spin += h * alpha;
    body.old_push = a, body.old_twist = alpha;
  }

  const ContactLaw& law_;
  ContactBatch batch_{};
  bool touching_ = false, started_ = false;
};

}  // namespace scree::test
