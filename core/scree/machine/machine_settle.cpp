// The end of a machine's step: joints made to hold, forces and work noted, state kept.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/machine/machine.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

/// What exact rows may lack after settle() [m/s], beside rounding, and the rounds it takes at most. Each round gains a factor
/// of about the angle per step.
constexpr double kExact = 1e-12;
constexpr int kMostRounds = 30;

/// Rounding of positions as large as those of the joints [m].
double rounding(std::span<const JointPlacement> joints) {
  double size = 0.0;
  for (const JointPlacement& at : joints) {
    for (const Vec3& x : {at.a.position, at.b.position})
      size = std::max({size, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  }
  return 8.0 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

void Machine::settle(std::span<double> impulse, std::span<Twist> velocity, const PoseAfter& after) {
  solved_impulse_.assign(impulse.begin(), impulse.end());
  solved_velocity_.assign(velocity.begin(), velocity.end());
  hold(impulse, velocity, after);
  // A motor that would have to exceed its limit gives just that.
  while (let_go_of_overloaded(impulse)) {
    std::ranges::copy(solved_impulse_, impulse.begin());
    std::ranges::copy(solved_velocity_, velocity.begin());
    hold(impulse, velocity, after);
  }
  place(view_, velocity, &after, after_);
  account(impulse, velocity);
  note_coordinates(velocity);
  break_overloaded();
  last_kick_ = step_.kick;
}

void Machine::hold(std::span<double> impulse, std::span<Twist> velocity, const PoseAfter& after) {
  gather_held(impulse);
  if (held_.empty() || !projection_.bind(held_rows_, held_compliance_, inertia_)) return;
  const double enough = std::max(kExact, rounding(placed_) / step_.kick);
  double worst = find_defects(impulse, velocity, view_, after);
  for (int round = 0; round < kMostRounds && worst > enough && std::isfinite(worst); ++round) {
    projection_.solve(defect_, correction_);
    apply_correction(impulse, velocity);
    const double now = find_defects(impulse, velocity, view_, after);
    // Equations that contradict each other never vanish together: their least error stands.
    if (now > 0.9 * worst) break;
    worst = now;
  }
}

// Rows of motors beyond their limits are put there and are exact no longer; true when there was one.
bool Machine::let_go_of_overloaded(std::span<const double> impulse) {
  bool found = false;
  for (const CcpBlock& block : blocks_) {
    if (block.kind != CcpKind::box) continue;
    StepRow& row = step_rows_[block.first_row];
    const double g = impulse[block.first_row];
    if (!row.exact || (g >= block.lower && g <= block.upper)) continue;
    row.exact = false;
    found = true;
    double& solved = solved_impulse_[block.first_row];
    const double limit = g < block.lower ? block.lower : block.upper;
    push(row.at, limit - solved, solved_velocity_);
    solved = limit;
  }
  return found;
}

void Machine::gather_held(std::span<const double> impulse) {
  held_.clear();
  held_rows_.clear();
  held_compliance_.clear();
  std::size_t block = 0;
  for (std::uint32_t i = 0; i < step_rows_.size(); ++i) {
    while (i >= blocks_[block].first_row + std::uint32_t{blocks_[block].rows}) ++block;
    const CcpBlock& b = blocks_[block];
    const bool at_limit = b.kind == CcpKind::box && (impulse[i] <= b.lower || impulse[i] >= b.upper);
    if (!step_rows_[i].exact || at_limit) continue;
    held_.push_back(i);
    held_rows_.push_back(step_rows_[i].at);
    held_compliance_.push_back(step_rows_[i].compliance);
  }
  defect_.resize(held_.size());
  correction_.resize(held_.size());
}

double Machine::find_defects(std::span<const double> impulse, std::span<const Twist> velocity, const BodyView& bodies,
                             const PoseAfter& after) {
  place(bodies, velocity, &after, after_);
  double worst = 0.0;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const StepRow& row = step_rows_[held_[k]];
    defect_[k] = row.linear ? rate(row.at, velocity) + row.offset + row.compliance * impulse[held_[k]]
                            : value(row, after_) / step_.drift;
    worst = std::max(worst, std::abs(defect_[k]));
  }
  return worst;
}

void Machine::apply_correction(std::span<double> impulse, std::span<Twist> velocity) {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    impulse[held_[k]] += correction_[k];
    push(held_rows_[k], correction_[k], velocity);
  }
}

// What an impulse of a row [N s] changes of the velocities.
void Machine::push(const MachineRow& row, double impulse, std::span<Twist> velocity) const {
  for (const auto& [body, part] : {std::pair{row.a, row.row.a}, std::pair{row.b, row.row.b}}) {
    if (body < 0) continue;
    const auto k = static_cast<std::size_t>(body);
    velocity[k] += velocity_change(inertia_[k], part, impulse);
  }
}

MachineReport& Machine::report_of(const RowGroup& group) {
  const std::size_t joints = description_.joints.size();
  if (group.role == RowRole::motor) return reports_[joints + group.owner];
  if (group.role == RowRole::coupling) return reports_[joints + description_.motors.size() + group.owner];
  return reports_[group.owner];
}

// The part of a row's rate that bodies have which forces move.
double Machine::rate_of_moved(const MachineRow& row, std::span<const Twist> velocity) const {
  const auto of = [&](int number) {
    const bool moved = number >= 0 && inertia_[static_cast<std::size_t>(number)].inverse_mass > 0.0;
    return moved ? velocity[static_cast<std::size_t>(number)] : Twist{};
  };
  return row_rate(row.row, of(row.a), of(row.b));
}

// Work of a row: impulse times the mean of its rates before and after, which is what it adds to the kinetic energy.
void Machine::account(std::span<const double> impulse, std::span<const Twist> velocity) {
  std::ranges::fill(reports_, MachineReport{});
  std::ranges::fill(last_impulse_, 0.0);
  work_ = 0.0;
  for (std::size_t i = 0; i < step_rows_.size(); ++i) {
    const StepRow& row = step_rows_[i];
    const double g = impulse[i], per_second = g / step_.kick;
    last_impulse_[row.group.first_slot + row.k] = g;
    MachineReport& report = report_of(row.group);
    const double work = 0.5 * g * (rate(row.at, before_) + rate(row.at, velocity));
    report.power += work / step_.kick;
    energy_[static_cast<std::size_t>(&report - reports_.data())] += work;
    work_ += 0.5 * g * (rate_of_moved(row.at, before_) + rate_of_moved(row.at, velocity));
    const bool of_joint = row.group.role != RowRole::motor && row.group.role != RowRole::coupling;
    if (of_joint) {
      const Vec3 force = per_second * row.at.row.b.linear;
      const JointPlacement& at = placed_[row.group.owner];
      report.force += force;
      report.torque += per_second * row.at.row.b.angular - cross(at.b.position - at.centre_b, force);
      if (row.group.role == RowRole::equation && !row.linear) {
        report.position_error = std::max(report.position_error, std::abs(value(row, after_)));
      }
    }
    if (row.group.role == RowRole::equation || row.group.role == RowRole::stop) continue;
    const bool turns = is_angular(description_, row.group, row.k);
    (turns ? report.effort_torque : report.effort_force) = per_second * row.scale;
  }
  for (std::size_t k = 0; k < reports_.size(); ++k) reports_[k].energy = energy_[k];
}

void Machine::note_coordinates(std::span<const Twist> velocity) {
  for (std::uint32_t j = 0; j < states_.size(); ++j) {
    MachineReport& report = reports_[j];
    report.gone = states_[j].gone;
    if (report.gone) continue;
    const JointType& type = *description_.joints[j].type;
    const MachinePlacement end{after_, states_, end_};
    const auto rate_along = [&](Coordinate c) {
      return rate({ends_[j][0], ends_[j][1], coordinate_row(type, c, placed_[j])}, velocity);
    };
    if (type.has(Coordinate::translation)) {
      report.translation = coordinate_of(description_, end, j, Coordinate::translation);
      report.translation_rate = rate_along(Coordinate::translation);
    }
    if (type.turns) {
      states_[j].angle = report.rotation = coordinate_of(description_, end, j, Coordinate::rotation);
      report.rotation_rate = rate_along(Coordinate::rotation);
    }
  }
}

void Machine::break_overloaded() {
  for (std::size_t j = 0; j < states_.size(); ++j) {
    const Joint& joint = description_.joints[j];
    const double force = norm(reports_[j].force), torque = norm(reports_[j].torque);
    if (states_[j].gone || (force <= joint.breaking_force && torque <= joint.breaking_torque)) continue;
    states_[j].gone = true;
    news_.push_back("joint '" + joint.name + "' breaks at t = " + std::to_string(end_) + " s under " +
                    std::to_string(force) + " N and " + std::to_string(torque) + " N m");
  }
}

void Machine::keep() {
  kept_.states.assign(states_.begin(), states_.end());
  kept_.impulse.assign(last_impulse_.begin(), last_impulse_.end());
  kept_.energy.assign(energy_.begin(), energy_.end());
  kept_.dt = last_kick_;
}

void Machine::undo() {
  states_ = kept_.states;
  last_impulse_ = kept_.impulse;
  energy_ = kept_.energy;
  last_kick_ = kept_.dt;
}

void Machine::save(StateWriter& out) const {
  std::vector<double> angles, starts;
  std::vector<std::uint64_t> gone;
  for (const JointState& state : states_) {
    angles.push_back(state.angle);
    starts.insert(starts.end(), state.start.begin(), state.start.end());
    gone.push_back(state.gone ? 1 : 0);
  }
  out.write("angle", std::span<const double>{angles});
  out.write("start", std::span<const double>{starts});
  out.write("gone", std::span<const std::uint64_t>{gone});
  out.write("impulse", std::span<const double>{last_impulse_});
  out.write("energy", std::span<const double>{energy_});
  out.write("time_step", last_kick_);
}

void Machine::load(const StateReader& in) {
  const std::vector<double> angles = in.doubles("angle"), starts = in.doubles("start");
  const std::vector<std::uint64_t> gone = in.integers("gone");
  for (std::size_t j = 0; j < states_.size(); ++j) {
    states_[j] = {angles.at(j), {starts.at(kCoordinates * j), starts.at(kCoordinates * j + 1)}, gone.at(j) != 0};
  }
  last_impulse_ = in.doubles("impulse");
  energy_ = in.doubles("energy");
  last_kick_ = in.number("time_step");
}

}  // namespace scree
