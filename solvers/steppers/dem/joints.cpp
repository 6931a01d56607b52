#include "joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scree/machine/joint_geometry.hpp"

namespace scree::dem {
namespace {

constexpr int kMostSweeps = 200;
/// What a sweep may still change of a row, over what it changed at first.
constexpr double kEnough = 1e-12;
constexpr double kNothing = 1e-12;  // [1/kg]

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

}  // namespace

void Joints::begin_step(Machine* machine, const BodyView& bodies) {
  machine_ = machine != nullptr && !machine->empty() ? machine : nullptr;
  work_ = 0.0;
  if (machine_ != nullptr) machine_->locate(bodies);
}

std::span<const BodyIndex> Joints::bodies() const {
  return machine_ == nullptr ? std::span<const BodyIndex>{} : machine_->bodies();
}

void Joints::before(const Slots& slots, const BodyState& state, Stage stage) {
  const std::span<const BodyIndex> bodies = machine_->bodies();
  slots.store_poses(state, bodies);
  held_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Slot slot = slots.slot_of[bodies[k]];
    const Moving& moving = slots.moving[slot];
    // What moves on through the middle of a step are velocities at the ends of drifts: those before the kick are what joints left.
    const Twist before =
        stage == Stage::first || !moving.is_dynamic() ? Twist{moving.linear, moving.angular} : velocity_[k];
    if (moving.is_dynamic()) {
      state.velocity[bodies[k]] = before.linear;
      state.angular_velocity[bodies[k]] = before.angular;
    }
    const auto entry = std::ranges::lower_bound(slots.turning, slot, {}, &Turning::slot);
    Body& body = held_[k];
    body = {.start = {state.position[bodies[k]], state.orientation[bodies[k]]},
            .before = before,
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

void Joints::after(Slots& slots, const BodyView& bodies, double time, double h, Stage stage, Motions& done) {
  const std::span<const BodyIndex> index = machine_->bodies();
  const double drift = stage == Stage::last ? 0.0 : h, kick = stage == Stage::middle ? h : 0.5 * h;
  find_free(slots, drift);
  const PoseAfter pose_after = [&](BodyIndex i, const Twist& v) {
    const auto k = static_cast<std::size_t>(std::ranges::find(index, i) - index.begin());
    return k < held_.size() ? moved(held_[k].start, v, drift) : Pose{bodies.position[i], bodies.orientation[i]};
  };
  machine_->pose(bodies, free_, pose_after, {.time = time, .drift = drift, .kick = kick});
  velocity_ = free_;
  solve_rows(velocity_);
  machine_->settle(impulse_, velocity_, pose_after);
  allow(slots, drift, kick, done);
}

/// Velocities without joints: of the drift, which is done already, or, at the end of an outer step, those of then.
void Joints::find_free(const Slots& slots, double h) {
  const std::span<const BodyIndex> index = machine_->bodies();
  free_.resize(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    const Slot slot = slots.slot_of[index[k]];
    const Body& body = held_[k];
    if (h == 0.0) {
      free_[k] = {slots.moving[slot].linear, slots.moving[slot].angular};
      continue;
    }
    free_[k].linear = (1.0 / h) * (slots.place[slot].position - body.start.position);
    free_[k].angular = {};
    if (body.turning == kNone) continue;
    const Quat turn = slots.turning[body.turning].orientation * conjugate(body.start.orientation);
    free_[k].angular = (1.0 / h) * rotation_vector(turn);
  }
}

/// Puts velocity_ in the place of free_. All impulses of a kick act at once, each does its work at the mean of the velocities
/// before and after the kick: what the joints take from the latter, the work of the other forces loses.
void Joints::allow(Slots& slots, double h, double kick, Motions& done) {
  const std::span<const BodyIndex> index = machine_->bodies();
  for (std::size_t k = 0; k < index.size(); ++k) {
    const Slot slot = slots.slot_of[index[k]];
    Moving& moving = slots.moving[slot];
    const Body& body = held_[k];
    if (!moving.is_dynamic()) continue;
    const Vec3 push = velocity_[k].linear - free_[k].linear, turn = velocity_[k].angular - free_[k].angular;
    const Wrench& contact = slots.wrench[slot];
    const Lanes& field = slots.field_force[slot];
    const Vec3 field_torque = slots.field_torque.empty() ? Vec3{} : slots.field_torque[slot];
    const double of_contacts = 0.5 * kick * (dot(contact.force, push) + dot(contact.torque, turn));
    const double of_fields = 0.5 * kick * (dot(Vec3{field[0], field[1], field[2]}, push) + dot(field_torque, turn));
    done.contact_work += of_contacts;
    done.force_work += of_fields;
    // The change of the kinetic energy by the joints alone, to the bit, and what they took from the work of the others.
    work_ += 0.5 / moving.inverse_mass * dot(push, velocity_[k].linear + free_[k].linear) +
             0.5 * dot(body.inertia * turn, velocity_[k].angular + free_[k].angular) - of_contacts - of_fields;
    moving.linear += push;
    const Pose pose = moved(body.start, velocity_[k], h);
    if (h > 0.0) slots.place[slot].position = pose.position;
    const double reach = body.turning == kNone ? 0.0 : slots.reach[body.turning];
    done.fastest = std::max(done.fastest, norm(velocity_[k].linear) + reach * norm(velocity_[k].angular));
    if (body.turning == kNone) continue;
    Turning& turning = slots.turning[body.turning];
    if (h > 0.0) turning.orientation = pose.orientation;
    turning.load.work += of_contacts;
    turning.momentum += body.inertia * turn;
    moving.angular = angular_velocity(turning.orientation, turning.inverse_inertia, turning.momentum);
  }
}

/// What a unit impulse of a row does to the velocities, when the equations answer to it.
struct Joints::Response {
  std::uint32_t row = 0;
  std::vector<Twist> velocity;  // by body
  std::vector<double> impulse;  // of the equations
  double allowed_from = 0.0, allowed_to = 0.0;
  double rate = 0.0;  // of its row, without its impulse [m/s]
};

/// Adds to `velocity` what takes the defects out of the equations, and returns their impulses.
void Joints::answer(std::span<const double> defect, std::span<Twist> velocity, std::span<double> impulse) {
  equations_.solve(defect, impulse);
  for (std::size_t k = 0; k < equation_rows_.size(); ++k) add(equation_rows_[k], impulse[k], velocity);
}

void Joints::add(const MachineRow& row, double impulse, std::span<Twist> velocity) const {
  for (const auto& [body, part] : {std::pair{row.a, row.row.a}, std::pair{row.b, row.row.b}}) {
    if (body >= 0) velocity[body] += velocity_change(held_[static_cast<std::size_t>(body)].inverse, part, impulse);
  }
}

/// Rate of a row for velocities by body.
double Joints::rate(const MachineRow& row, std::span<const Twist> velocity) {
  const auto of = [&](int body) { return body < 0 ? Twist{} : velocity[static_cast<std::size_t>(body)]; };
  return row_rate(row.row, of(row.a), of(row.b));
}

/// Rows that may not pull, or not more than so much; without any, settle() finds all. Each row's effect on all others, with the
/// equations held, makes a small problem of such rows alone, which projected Gauss-Seidel solves.
void Joints::solve_rows(std::span<Twist> velocity) {
  const MachineProblem problem = machine_->problem();
  impulse_.assign(problem.rows.size(), 0.0);
  if (std::ranges::all_of(problem.blocks, [](const CcpBlock& b) { return b.kind == CcpKind::free; })) return;
  const std::span<const BodyIndex> index = machine_->bodies();
  const auto number = [&](BodyIndex body, const Twist& part) {
    const auto k = std::ranges::find(index, body) - index.begin();
    const bool of_world = part == Twist{} || static_cast<std::size_t>(k) == index.size();
    return of_world ? -1 : static_cast<int>(k);
  };
  equation_rows_.clear();
  std::vector<std::uint32_t> equation_index;
  std::vector<double> compliance, defect;
  std::vector<MachineRow> limited_rows;
  std::vector<Response> limited;
  for (const CcpBlock& block : problem.blocks) {
    for (std::uint32_t i = block.first_row; i < block.first_row + std::uint32_t{block.rows}; ++i) {
      const CcpRow& row = problem.rows[i];
      const MachineRow at{number(block.a, row.a), number(block.b, row.b), row};
      if (block.kind == CcpKind::free) {
        equation_rows_.push_back(at), equation_index.push_back(i);
        compliance.push_back(problem.compliance[i]), defect.push_back(problem.r[i]);
        continue;
      }
      limited_rows.push_back(at);
      Response response;
      response.row = i;
      response.allowed_to = block.kind == CcpKind::box ? block.upper : std::numeric_limits<double>::infinity();
      response.allowed_from = block.kind == CcpKind::box ? block.lower : 0.0;
      limited.push_back(std::move(response));
    }
  }
  std::vector<BodyInertia> inertia;
  for (const Body& body : held_) inertia.push_back(body.inverse);
  if (!equations_.bind(equation_rows_, compliance, inertia)) return;
  std::vector<Twist> change(held_.size());
  std::vector<double> held(equation_rows_.size());
  answer(defect, change, held);
  for (std::size_t k = 0; k < limited.size(); ++k) {
    Response& response = limited[k];
    response.velocity.assign(held_.size(), Twist{});
    response.impulse.resize(equation_rows_.size());
    add(limited_rows[k], 1.0, response.velocity);
    for (std::size_t e = 0; e < defect.size(); ++e) defect[e] = rate(equation_rows_[e], response.velocity);
    answer(defect, response.velocity, response.impulse);
    response.rate = problem.r[response.row] + rate(limited_rows[k], change);
  }
  sweep(problem, limited_rows, limited);
  for (const Response& response : limited) {
    const double g = impulse_[response.row];
    for (std::size_t e = 0; e < held.size(); ++e) held[e] += g * response.impulse[e];
    for (std::size_t b = 0; b < change.size(); ++b) {
      change[b] += {g * response.velocity[b].linear, g * response.velocity[b].angular};
    }
  }
  for (std::size_t e = 0; e < held.size(); ++e) impulse_[equation_index[e]] = held[e];
  for (std::size_t b = 0; b < change.size(); ++b) velocity[b] += change[b];
}

/// Projected Gauss-Seidel over the rows that have limits.
void Joints::sweep(const MachineProblem& problem, std::span<const MachineRow> rows,
                   std::span<const Response> responses) {
  double first = 0.0;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double most = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::uint32_t i = responses[k].row;
      const double diagonal = rate(rows[k], responses[k].velocity) + problem.compliance[i];
      double u = responses[k].rate + problem.compliance[i] * impulse_[i];
      for (const Response& other : responses) u += rate(rows[k], other.velocity) * impulse_[other.row];
      // A row that the equations do not let move has nothing to give, but what it is told to.
      const double wanted = diagonal > kNothing ? impulse_[i] - u / diagonal : impulse_[i];
      const double g = std::clamp(wanted, responses[k].allowed_from, responses[k].allowed_to);
      most = std::max(most, std::abs(g - impulse_[i]) * diagonal);
      impulse_[i] = g;
    }
    if (sweep == 0) first = most;
    if (most <= kEnough * first) return;
  }
}

}  // namespace scree::dem
