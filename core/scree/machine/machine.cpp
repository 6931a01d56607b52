#include "scree/machine/machine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scree {
namespace {

/// Greatest speed at which a stop that was passed is undone [m/s], and the least impact that bounces: those of contacts.
constexpr double kRecoverySpeed = 0.15;
constexpr double kBounceSpeed = 0.1;

std::vector<BodyId> bodies_of(const MachineDescription& machine) {
  std::vector<BodyId> ids;
  for (const Joint& joint : machine.joints) {
    for (const JointEnd* end : {&joint.a, &joint.b}) {
      if (end->body != kWorld) ids.push_back(end->body);
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

void check(const MachineDescription& machine) {
  const auto require = [&](bool good, const char* what) {
    if (!good) throw std::logic_error{std::string{"machine: "} + what};
  };
  for (const Motor& m : machine.motors) {
    require(m.joint < machine.joints.size() && machine.joints[m.joint].type->has(m.coordinate), "a motor's coordinate");
  }
  for (const Coupling& c : machine.couplings) {
    require(c.first < machine.joints.size() && machine.joints[c.first].type->has(c.of_first),
            "a coupling's first joint");
    require(c.second < machine.joints.size() && machine.joints[c.second].type->has(c.of_second),
            "a coupling's second joint");
  }
}

/// Row of a coupling from those of its coordinates: at most two bodies that forces move.
class RowSum {
 public:
  explicit RowSum(std::span<const BodyInertia> bodies) : bodies_{bodies} {}
  void add(int body, const Twist& part) {
    if (body < 0 || bodies_[static_cast<std::size_t>(body)].inverse_mass == 0.0) return;
    if (sum_.a < 0 || sum_.a == body) {
      sum_.a = body;
      sum_.row.a += part;
    } else if (sum_.b < 0 || sum_.b == body) {
      sum_.b = body;
      sum_.row.b += part;
    } else {
      throw std::logic_error{"machine: a coupling of more than two bodies that move"};
    }
  }
  [[nodiscard]] const MachineRow& sum() const { return sum_; }

 private:
  std::span<const BodyInertia> bodies_;
  MachineRow sum_;
};

}  // namespace

Machine::Machine(MachineDescription description)
    : description_{std::move(description)}, groups_{row_groups(description_)}, ids_{bodies_of(description_)} {
  check(description_);
  states_.resize(description_.joints.size());
  last_impulse_.assign(groups_.empty() ? 0 : groups_.back().first_slot + std::size_t{groups_.back().rows}, 0.0);
  reports_.resize(description_.joints.size() + description_.motors.size() + description_.couplings.size());
  energy_.assign(reports_.size(), 0.0);
}

Machine::~Machine() = default;

void Machine::locate(const BodyView& bodies) {
  news_.clear();
  bodies_.clear();
  numbers_.clear();
  for (const BodyId id : ids_) {
    const auto at = std::ranges::lower_bound(bodies.id, id);
    const bool there = at != bodies.id.end() && *at == id;
    numbers_.push_back(there ? static_cast<int>(bodies_.size()) : kGone);
    if (there) bodies_.push_back(static_cast<BodyIndex>(at - bodies.id.begin()));
  }
  ends_.resize(description_.joints.size());
  for (std::size_t j = 0; j < ends_.size(); ++j) {
    const Joint& joint = description_.joints[j];
    const auto number = [&](BodyId id) {
      return id == kWorld ? -1 : numbers_[static_cast<std::size_t>(std::ranges::lower_bound(ids_, id) - ids_.begin())];
    };
    ends_[j] = {number(joint.a.body), number(joint.b.body)};
    if (ends_[j][0] == kGone || ends_[j][1] == kGone) {
      if (!states_[j].gone) news_.push_back("joint '" + joint.name + "' is gone: one of its bodies has left the scene");
      states_[j].gone = true;
      ends_[j] = {-1, -1};
    }
  }
}

void Machine::start(const BodyView& bodies) {
  locate(bodies);
  place(bodies, {}, nullptr, placed_);
  for (std::size_t j = 0; j < states_.size(); ++j) {
    const JointType& type = *description_.joints[j].type;
    JointState& state = states_[j];
    if (type.turns) {
      const double angle = coordinate_value(type, Coordinate::rotation, placed_[j]);
      state.angle = state.start[0] = nearest_turn(angle, starting_angle(description_, static_cast<std::uint32_t>(j)));
    }
    if (type.has(Coordinate::translation)) {
      state.start[1] = coordinate_value(type, Coordinate::translation, placed_[j]);
    }
  }
}

// At the poses of the view, or after the step with `velocity`.
void Machine::place(const BodyView& bodies, std::span<const Twist> velocity, const PoseAfter* after,
                    std::vector<JointPlacement>& out) const {
  out.clear();
  const auto pose = [&](int number) -> Pose {
    if (number < 0) return {};
    const BodyIndex i = bodies_[static_cast<std::size_t>(number)];
    if (after != nullptr) return (*after)(i, velocity[static_cast<std::size_t>(number)]);
    return {bodies.position[i], bodies.orientation[i]};
  };
  for (std::size_t j = 0; j < ends_.size(); ++j) {
    out.emplace_back(description_.joints[j], pose(ends_[j][0]), pose(ends_[j][1]));
  }
}

void Machine::pose(const BodyView& bodies, std::span<const Twist> free, const PoseAfter& after,
                   const MachineStep& step) {
  step_ = step;
  end_ = step.time + step.drift;
  view_ = bodies;
  inertia_.clear();
  before_.clear();
  for (const BodyIndex i : bodies_) {
    inertia_.push_back({inverse_mass(bodies, i), inverse_inertia(bodies, i)});
    before_.push_back({bodies.velocity[i], bodies.angular_velocity[i]});
  }
  length_.clear();
  for (const auto& ends : ends_) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const int end : ends) {
      if (end < 0 || inertia_[static_cast<std::size_t>(end)].inverse_mass == 0.0) continue;
      shortest = std::min(shortest, bodies.radius[bodies_[static_cast<std::size_t>(end)]]);
    }
    length_.push_back(std::isfinite(shortest) && shortest > 0.0 ? shortest : 1.0);
  }
  place(bodies, {}, nullptr, placed_);
  place(bodies, free, &after, after_);
  step_rows_.clear();
  blocks_.clear();
  rows_.clear();
  r_.clear();
  compliance_.clear();
  guess_.clear();
  for (const RowGroup& group : groups_) {
    if (!is_gone(group)) add_group(group, free);
  }
}

MachineProblem Machine::problem() const { return {blocks_, rows_, r_, compliance_, guess_}; }

bool Machine::is_gone(const RowGroup& group) const {
  if (states_[joint_of(description_, group)].gone) return true;
  return group.role == RowRole::coupling && states_[description_.couplings[group.owner].second].gone;
}

void Machine::add_group(const RowGroup& group, std::span<const Twist> free) {
  CcpBlock block{.kind = group.role == RowRole::stop ? CcpKind::nonnegative : CcpKind::free,
                 .rows = group.rows,
                 .first_row = static_cast<std::uint32_t>(rows_.size())};
  for (std::uint8_t k = 0; k < group.rows; ++k) {
    StepRow row{.group = group, .k = k, .at = row_of(group, k)};
    row.scale = is_angular(description_, group, k) ? length_[joint_of(description_, group)] : 1.0;
    r_.push_back(right_side(row, block, free));
    // The world has no body in the problem: its part is zero, of whichever body.
    CcpRow in_problem = row.at.row;
    if (row.at.a < 0) in_problem.a = {};
    if (row.at.b < 0) in_problem.b = {};
    rows_.push_back(in_problem);
    compliance_.push_back(row.compliance);
    guess_.push_back(last_kick_ > 0.0 ? last_impulse_[group.first_slot + k] * (step_.kick / last_kick_) : 0.0);
    const auto index = [&](int number, int other) {
      return bodies_[static_cast<std::size_t>(number < 0 ? other : number)];
    };
    block.a = index(row.at.a, row.at.b);
    block.b = index(row.at.b, row.at.a);
    step_rows_.push_back(row);
  }
  blocks_.push_back(block);
}

MachineRow Machine::row_of(const RowGroup& group, std::size_t k) const {
  const MachinePlacement now{placed_, states_, step_.time};
  if (group.role != RowRole::coupling) {
    const std::uint32_t j = joint_of(description_, group);
    return {ends_[j][0], ends_[j][1], row_jacobian(description_, group, k, now, length_[j])};
  }
  const Coupling& c = description_.couplings[group.owner];
  const double scale = c.of_second == Coordinate::rotation ? length_[c.first] : 1.0;
  RowSum sum{inertia_};
  for (const bool second : {false, true}) {
    const std::uint32_t j = second ? c.second : c.first;
    const CcpRow part =
        scaled(coordinate_row(*description_.joints[j].type, second ? c.of_second : c.of_first, placed_[j]),
               second ? scale : -c.ratio * scale);
    sum.add(ends_[j][0], part.a);
    sum.add(ends_[j][1], part.b);
  }
  return sum.sum();
}

double Machine::right_side(StepRow& row, CcpBlock& block, std::span<const Twist> free) const {
  const RowGroup& group = row.group;
  const double rate_free = rate(row.at, free);
  const Joint& joint = description_.joints[joint_of(description_, group)];
  switch (group.role) {
    case RowRole::equation: {
      const bool tilts = is_angular(joint.type->equations[row.k]);
      const SpringLaw& law = tilts ? joint.tilt : joint.shift;
      if (law.acts()) return spring_side(row, law, 0.0, rate_free);
      break;
    }
    case RowRole::spring: {
      const CoordinateLaw& law = joint.along(group.coordinate);
      return spring_side(row, law.spring, law.preload, rate_free);
    }
    case RowRole::stop:
      return stop_side(row, rate_free);
    case RowRole::motor:
      return motor_side(row, block, rate_free);
    case RowRole::coupling:
      break;
  }
  row.exact = true;
  if (step_.drift > 0.0) return value(row, after_) / step_.drift;
  row.linear = true;
  return rate_free;
}

// In the row's own scale: a stiffness k of an angle is k / L^2 of the row's length, a preload F is F / L. The force is that
// at the end of the drift; without one, as if there were one as long as the kick.
double Machine::spring_side(StepRow& row, const SpringLaw& law, double preload, double rate_free) const {
  const double l = row.scale, k = law.stiffness / (l * l), d = law.damping / (l * l);
  const double sum = (step_.drift > 0.0 ? step_.drift : step_.kick) * k + d;
  const double straight = value(row, after_) - step_.drift * rate_free;
  row.linear = row.exact = true;
  row.compliance = 1.0 / (step_.kick * sum);
  row.offset = (k * straight - preload / l) / sum;
  return rate_free + row.offset;
}

double Machine::stop_side(const StepRow& row, double rate_free) const {
  const Joint& joint = description_.joints[row.group.owner];
  const double left = value(row, placed_), then = value(row, after_);
  const bool drifts = step_.drift > 0.0;
  const double time = drifts ? step_.drift : step_.kick;
  const double open = drifts ? then / time : rate_free + left / time;
  double r = left >= 0.0 ? open : rate_free + std::max(left / time, -kRecoverySpeed);
  const double rate_before = rate(row.at, before_);
  if (drifts && rate_before < -kBounceSpeed && then <= 0.0) {
    r = std::min(r, rate_free + joint.along(row.group.coordinate).stop_restitution * rate_before);
  }
  return r;
}

double Machine::motor_side(StepRow& row, CcpBlock& block, double rate_free) const {
  const Motor& motor = description_.motors[row.group.owner];
  const double l = row.scale, most = motor.limit * step_.kick / l;
  if (motor.drive == Drive::effort) {
    const double g = std::clamp(motor.value.value(end_), -motor.limit, motor.limit) * step_.kick / l;
    block.kind = CcpKind::box;
    block.lower = block.upper = g;
    row.linear = true;
    return rate_free;
  }
  if (std::isfinite(most)) {
    block.kind = CcpKind::box;
    block.lower = -most;
    block.upper = most;
  }
  row.exact = true;
  const bool drifts = step_.drift > 0.0;
  if (motor.drive == Drive::position && drifts) return value(row, after_) / step_.drift;
  row.linear = true;
  if (motor.drive == Drive::position) {
    row.offset = -l * motor.value.derivative(end_);
  } else {
    row.offset = -l * (drifts ? motor.value.integral(step_.time, end_) / step_.drift : motor.value.value(end_));
  }
  return rate_free + row.offset;
}

double Machine::value(const StepRow& row, std::span<const JointPlacement> joints) const {
  return row_value(description_, row.group, row.k, {joints, states_, end_}, length_[joint_of(description_, row.group)]);
}

double Machine::rate(const MachineRow& row, std::span<const Twist> velocity) const {
  const auto of = [&](int number) { return number < 0 ? Twist{} : velocity[static_cast<std::size_t>(number)]; };
  return row_rate(row.row, of(row.a), of(row.b));
}

}  // namespace scree
