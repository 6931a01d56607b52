#include "joints.hpp"

#include <algorithm>
#include <cmath>

#include "scree/machine/joint_geometry.hpp"

namespace scree::dem {
namespace {

constexpr int kMostSweeps = 200;
/// What a sweep may still change of a row, over what it changed at first.
constexpr double kEnough = 1e-10;

/// The rotation vector of a unit quaternion [rad].
Vec3 rotation_vector(const Quat& q) {
  const double sign = q.w < 0.0 ? -1.0 : 1.0;
  const Vec3 axis = sign * Vec3{q.x, q.y, q.z};
  const double sine = norm(axis);
  return sine < 1e-12 ? 2.0 * axis : (2.0 * std::atan2(sine, sign * q.w) / sine) * axis;
}

Pose moved(const Pose& start, const Twist& velocity, double h) {
  return {start.position + h * velocity.linear,
          normalized(from_rotation_vector(h * velocity.angular) * start.orientation)};
}

/// An impulse within what its block allows.
double allowed(const CcpBlock& block, double g) {
  if (block.kind == CcpKind::nonnegative) return std::max(g, 0.0);
  return block.kind == CcpKind::box ? std::clamp(g, block.lower, block.upper) : g;
}

}  // namespace

void Joints::begin_step(Machine* machine, const BodyView& bodies) {
  machine_ = machine != nullptr && !machine->empty() ? machine : nullptr;
  work_ = 0.0;
  if (machine_ != nullptr) machine_->locate(bodies);
}

std::span<const BodyIndex> Joints::bodies() const {
  return machine_ == nullptr ? std::span<const BodyIndex>{} : machine_->bodies();
}

void Joints::before(const Slots& slots, const BodyState& state) {
  const std::span<const BodyIndex> bodies = machine_->bodies();
  slots.store_poses(state, bodies);
  held_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Slot slot = slots.slot_of[bodies[k]];
    const Moving& moving = slots.moving[slot];
    if (moving.is_dynamic()) {
      state.velocity[bodies[k]] = moving.linear;
      state.angular_velocity[bodies[k]] = moving.angular;
    }
    const auto entry = std::ranges::lower_bound(slots.turning, slot, {}, &Turning::slot);
    Body& body = held_[k];
    body = {.start = {state.position[bodies[k]], state.orientation[bodies[k]]},
            .inertia = {},
            .inverse = {inverse_mass(state.view, bodies[k]), inverse_inertia(state.view, bodies[k])},
            .turning = kNone};
    if (entry == slots.turning.end() || entry->slot != slot) continue;  // a fixed body
    body.turning = static_cast<std::size_t>(entry - slots.turning.begin());
    if (!moving.is_dynamic()) continue;
    const Mat3 r = to_matrix(body.start.orientation);
    body.inertia = r * Mat3::diagonal(state.view.inertia[bodies[k]]) * transpose(r);
  }
}

void Joints::after(Slots& slots, const BodyView& bodies, double time, double h) {
  const std::span<const BodyIndex> index = machine_->bodies();
  free_.resize(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    const Slot slot = slots.slot_of[index[k]];
    const Body& body = held_[k];
    // The velocities of the drift, which is done already.
    free_[k].linear = (1.0 / h) * (slots.place[slot].position - body.start.position);
    free_[k].angular = {};
    if (body.turning == kNone) continue;
    const Quat turn = slots.turning[body.turning].orientation * conjugate(body.start.orientation);
    free_[k].angular = (1.0 / h) * rotation_vector(turn);
  }
  const PoseAfter pose_after = [&](BodyIndex i, const Twist& v) {
    const auto k = static_cast<std::size_t>(std::ranges::find(index, i) - index.begin());
    return k < held_.size() ? moved(held_[k].start, v, h) : Pose{bodies.position[i], bodies.orientation[i]};
  };
  machine_->pose(bodies, free_, pose_after, time, h);
  velocity_ = free_;
  solve_rows(velocity_);
  machine_->settle(impulse_, velocity_, pose_after);
  work_ += machine_->work();
  for (std::size_t k = 0; k < index.size(); ++k) {
    const Slot slot = slots.slot_of[index[k]];
    Moving& moving = slots.moving[slot];
    const Body& body = held_[k];
    if (!moving.is_dynamic()) continue;
    const Pose pose = moved(body.start, velocity_[k], h);
    slots.place[slot].position = pose.position;
    moving.linear += velocity_[k].linear - free_[k].linear;
    if (body.turning == kNone) continue;
    Turning& turning = slots.turning[body.turning];
    turning.orientation = pose.orientation;
    turning.momentum += body.inertia * (velocity_[k].angular - free_[k].angular);
    moving.angular = angular_velocity(turning.orientation, turning.inverse_inertia, turning.momentum);
  }
}

/// Rows that may not pull, or not more than so much. Without such rows settle() finds all.
void Joints::solve_rows(std::span<Twist> velocity) {
  const MachineProblem problem = machine_->problem();
  const std::span<const BodyIndex> index = machine_->bodies();
  impulse_.assign(problem.rows.size(), 0.0);
  const bool equations = std::ranges::all_of(problem.blocks, [](const CcpBlock& b) { return b.kind == CcpKind::free; });
  if (equations) return;
  const auto number = [&](BodyIndex body) {
    return static_cast<std::size_t>(std::ranges::find(index, body) - index.begin());
  };
  double first = 0.0;
  const std::vector<Twist> start{velocity.begin(), velocity.end()};
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double most = 0.0;
    for (const CcpBlock& block : problem.blocks) {
      const std::size_t a = number(block.a), b = number(block.b);
      for (std::size_t i = block.first_row; i < block.first_row + std::size_t{block.rows}; ++i) {
        const CcpRow& row = problem.rows[i];
        const auto change = [&](double g) {
          return std::pair{a < held_.size() ? velocity_change(held_[a].inverse, row.a, g) : Twist{},
                           b < held_.size() ? velocity_change(held_[b].inverse, row.b, g) : Twist{}};
        };
        const auto rate = [&](const Twist& of_a, const Twist& of_b) { return row_rate(row, of_a, of_b); };
        const auto [unit_a, unit_b] = change(1.0);
        const double diagonal = rate(unit_a, unit_b) + problem.compliance[i];
        if (!(diagonal > 0.0)) continue;
        const auto since = [&](std::size_t k) {
          if (k >= held_.size()) return Twist{};
          return Twist{velocity[k].linear - start[k].linear, velocity[k].angular - start[k].angular};
        };
        const double u = rate(since(a), since(b)) + problem.r[i] + problem.compliance[i] * impulse_[i];
        const double g = allowed(block, impulse_[i] - u / diagonal), step = g - impulse_[i];
        impulse_[i] = g;
        most = std::max(most, std::abs(step) * diagonal);
        const auto [on_a, on_b] = change(step);
        if (a < held_.size()) velocity[a] += on_a;
        if (b < held_.size()) velocity[b] += on_b;
      }
    }
    if (sweep == 0) first = most;
    if (most <= kEnough * first) break;
  }
}

}  // namespace scree::dem
