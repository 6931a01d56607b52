// PrescribedMotion: the pose of a kinematic body as a function of time.
//
//     pose(t) = T(t) R(t) pose(written),   or the pose of a path
//
// R turns about axes that stay in the world, in the order in which the scene lists them, and T shifts. Each step from t to t + h gives
// the body the velocities
//
//     v = (x(t + h) - x) / h,   w = rotation vector of q(t + h) q* / h
//
// from where it is, so that it is exactly where the functions say at the end of every step, however many there were.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scree/machine/functions/time_function.hpp"
#include "scree/machine/prescribed/pose_path.hpp"
#include "scree/math/twist.hpp"
#include "scree/model/body.hpp"

namespace scree {

class BodyStore;

/// A way or an angle over time: a function, or the integral of a speed since t = 0. A pure function of time. Integrals without a
/// closed form are summed over spans of one step and remembered: ask in order of time, and not from several threads.
class Way {
 public:
  static Way by(TimeFunction way) { return Way{std::move(way), false, 0.0}; }
  /// `step` [s]: of the run.
  static Way at_speed(TimeFunction speed, double step) { return Way{std::move(speed), true, step}; }
  /// [m] or [rad] at time `t` [s]. @throws Error (usage) when it is not finite.
  [[nodiscard]] double at(double t);

 private:
  Way(TimeFunction function, bool is_speed, double step)
      : function_{std::move(function)}, is_speed_{is_speed}, step_{step} {}

  TimeFunction function_;
  bool is_speed_;
  double step_;              // [s]
  std::uint64_t spans_ = 0;  // steps summed so far
  double sum_ = 0.0;         // over them [m] or [rad]
};

/// A shift along or a turn about an axis of the world.
struct MotionPart {
  Vec3 axis;                    ///< unit [1]
  Way way;                      ///< [m], or of a turn [rad]
  std::optional<Vec3> through;  ///< a point of the axis of a turn [m]; none for a shift
};

/// The motion of one body.
class PrescribedMotion {
 public:
  /// Of a body that the scene puts at `written` [m].
  PrescribedMotion(BodyId body, const Pose& written, std::vector<MotionPart> parts)
      : body_{body}, written_{written}, parts_{std::move(parts)} {}
  /// Along a path; without orientations in it the body keeps that of `written`.
  PrescribedMotion(BodyId body, const Pose& written, PosePath path)
      : body_{body}, written_{written}, path_{std::move(path)} {}

  [[nodiscard]] BodyId body() const { return body_; }
  /// At time `t` [s]. @throws Error (usage) when a function is not finite there.
  [[nodiscard]] Pose pose(double t);

 private:
  BodyId body_;
  Pose written_;
  std::vector<MotionPart> parts_;
  std::optional<PosePath> path_;
};

/// Moves the bodies of a simulation.
class PrescribedMotions {
 public:
  explicit PrescribedMotions(std::vector<PrescribedMotion> motions = {}) : motions_{std::move(motions)} {}

  /// Gives the bodies the velocities that take them to their poses at `end` [s] within `dt` [s]. @throws Error (usage) when a
  /// function is not finite; then nothing has changed.
  void begin_step(BodyStore& bodies, double end, double dt);
  /// Puts the bodies where they are to be, without the rounding of a step.
  void end_step(BodyStore& bodies) const;
  /// Gives the bodies the velocities that they had before the last begin_step().
  void undo(BodyStore& bodies) const;

 private:
  struct Target {
    BodyIndex body;
    Pose pose;
    Twist before;
  };
  std::vector<PrescribedMotion> motions_;
  std::vector<Target> targets_;  // of the current step
};

}  // namespace scree
