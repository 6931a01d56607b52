#include "scree/machine/prescribed/prescribed_motion.hpp"

#include <cmath>

#include "scree/model/body_store.hpp"

namespace scree {

double Way::at(double t) {
  if (!is_speed_) return function_.value(t);
  if (function_.has_closed_integral()) return function_.integral(0.0, t);
  const auto whole = static_cast<std::uint64_t>(std::max(0.0, std::floor(t / step_ * (1.0 + 1e-12))));
  if (whole < spans_) {
    spans_ = 0;
    sum_ = 0.0;
  }
  const auto end_of = [&](std::uint64_t k) { return static_cast<double>(k) * step_; };
  for (; spans_ < whole; ++spans_) sum_ += function_.integral(end_of(spans_), end_of(spans_ + 1));
  const double rest = t - end_of(whole);
  return std::abs(rest) <= 1e-9 * step_ ? sum_ : sum_ + function_.integral(end_of(whole), t);
}

Pose PrescribedMotion::pose(double t) {
  Pose pose = written_;
  if (path_) {
    const Pose at = path_->at(t);
    pose.position = at.position;
    if (path_->has_orientations()) pose.orientation = at.orientation;
    return pose;
  }
  // Turns first, about axes that no shift moves.
  for (MotionPart& part : parts_) {
    if (!part.through) continue;
    const Quat turn = from_rotation_vector(part.way.at(t) * part.axis);
    pose.position = *part.through + rotate(turn, pose.position - *part.through);
    pose.orientation = normalized(turn * pose.orientation);
  }
  for (MotionPart& part : parts_) {
    if (!part.through) pose.position += part.way.at(t) * part.axis;
  }
  return pose;
}

void PrescribedMotions::begin_step(BodyStore& bodies, double end, double dt) {
  targets_.clear();
  const BodyState state = bodies.state();
  for (PrescribedMotion& motion : motions_) {
    const auto i = static_cast<BodyIndex>(bodies.find(motion.body()));
    targets_.push_back({i, motion.pose(end), {state.velocity[i], state.angular_velocity[i]}});
  }
  for (const Target& target : targets_) {
    const BodyIndex i = target.body;
    state.velocity[i] = (1.0 / dt) * (target.pose.position - state.position[i]);
    state.angular_velocity[i] = (1.0 / dt) * rotation_vector(target.pose.orientation * conjugate(state.orientation[i]));
  }
}

void PrescribedMotions::end_step(BodyStore& bodies) const {
  const BodyState state = bodies.state();
  for (const Target& target : targets_) {
    state.position[target.body] = target.pose.position;
    state.orientation[target.body] = target.pose.orientation;
  }
}

void PrescribedMotions::undo(BodyStore& bodies) const {
  const BodyState state = bodies.state();
  for (const Target& target : targets_) {
    state.velocity[target.body] = target.before.linear;
    state.angular_velocity[target.body] = target.before.angular;
  }
}

}  // namespace scree
