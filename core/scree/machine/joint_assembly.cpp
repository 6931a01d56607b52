#include "scree/machine/joint_assembly.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/machine/joint_projection.hpp"

namespace scree {
namespace {

constexpr int kMostRounds = 100;
constexpr double kMostTurn = 0.5;  // in a round [rad]
/// Violations up to this part of the machine's size are rounding.
constexpr double kTogether = 1e-12;

BodyInertia inertia_of(const NewBody& body) {
  if (body.motion != Motion::dynamic) return {};
  const Mat3 r = to_matrix(body.pose.orientation);
  const Vec3 j = body.inertia;
  return {1.0 / body.mass, r * Mat3::diagonal({1.0 / j.x, 1.0 / j.y, 1.0 / j.z}) * transpose(r)};
}

bool is_imposed(const Motor& motor) { return motor.drive != Drive::effort && !std::isfinite(motor.limit); }

bool imposes_position(const MachineDescription& machine, const RowGroup& group) {
  if (group.role != RowRole::motor) return false;
  const Motor& motor = machine.motors[group.owner];
  return motor.drive == Drive::position && is_imposed(motor);
}

/// The equations of all joints at the bodies' present poses.
class Equations {
 public:
  Equations(const MachineDescription& machine, std::span<const NewBody> bodies, bool with_motors) : machine_{machine} {
    for (const RowGroup& group : row_groups(machine)) {
      if (group.role == RowRole::equation || (with_motors && imposes_position(machine, group)))
        groups_.push_back(group);
    }
    states_.resize(machine.joints.size());
    for (std::uint32_t j = 0; j < states_.size(); ++j) states_[j].angle = starting_angle(machine, j);
    for (const Joint& tie : machine.joints) {
      double length = std::numeric_limits<double>::infinity();
      for (const JointEnd* end : {&tie.a, &tie.b}) {
        if (end->body == kWorld) continue;
        size_ = std::max(size_, norm(end->frame.position));
        if (bodies[end->body].motion == Motion::dynamic) length = std::min(length, bodies[end->body].radius);
      }
      length_.push_back(length);
      size_ = std::max(size_, std::isfinite(length) ? length : 0.0);
    }
  }

  void evaluate(std::span<const NewBody> bodies) {
    rows.clear();
    value.clear();
    joint.clear();
    const auto pose = [&](BodyId id) { return id == kWorld ? Pose{} : bodies[id].pose; };
    placed_.clear();
    for (const Joint& j : machine_.joints) placed_.emplace_back(j, pose(j.a.body), pose(j.b.body));
    const MachinePlacement at{placed_, states_, 0.0};
    for (const RowGroup& group : groups_) {
      const std::uint32_t owner = joint_of(machine_, group);
      const Joint& j = machine_.joints[owner];
      const auto number = [](BodyId id) { return id == kWorld ? -1 : static_cast<int>(id); };
      for (std::size_t k = 0; k < group.rows; ++k) {
        const double length = length_[owner];
        value.push_back(row_value(machine_, group, k, at, length));
        rows.push_back({number(j.a.body), number(j.b.body), row_jacobian(machine_, group, k, at, length)});
        joint.push_back(owner);
      }
    }
  }

  [[nodiscard]] std::size_t worst() const {
    const auto less = [](double x, double y) { return std::abs(x) < std::abs(y); };
    return static_cast<std::size_t>(std::ranges::max_element(value, less) - value.begin());
  }
  [[nodiscard]] bool is_flipped(std::uint32_t j) const {
    const auto& equations = machine_.joints[j].type->equations;
    if (std::ranges::find(equations, JointEquation::tilt_x) == equations.end()) return false;
    const Vec3 z{0, 0, 1};
    return dot(rotate(placed_[j].a.orientation, z), rotate(placed_[j].b.orientation, z)) < 0.0;
  }
  [[nodiscard]] double size() const { return size_; }
  /// Of the coordinate that a motor drives.
  [[nodiscard]] MachineRow row_of(const Motor& motor) const {
    const Joint& j = machine_.joints[motor.joint];
    const auto number = [](BodyId id) { return id == kWorld ? -1 : static_cast<int>(id); };
    return {number(j.a.body), number(j.b.body), coordinate_row(*j.type, motor.coordinate, placed_[motor.joint])};
  }

  std::vector<MachineRow> rows;
  std::vector<double> value;         ///< [m]
  std::vector<std::uint32_t> joint;  ///< of each row

 private:
  const MachineDescription& machine_;
  std::vector<RowGroup> groups_;
  std::vector<JointState> states_;
  std::vector<JointPlacement> placed_;
  std::vector<double> length_;  // L by joint [m]
  double size_ = 0.0;           // greatest distance of a frame from its body's centre [m]
};

/// Moves every body by its part of M^-1 D g.
void move_bodies(const Equations& equations, std::span<const double> impulse, std::span<const BodyInertia> inertia,
                 std::span<NewBody> bodies) {
  std::vector<Twist> step(bodies.size());
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    const MachineRow& row = equations.rows[i];
    for (const auto& [body, part] : {std::pair{row.a, row.row.a}, std::pair{row.b, row.row.b}}) {
      if (body < 0) continue;
      const auto k = static_cast<std::size_t>(body);
      step[k] += velocity_change(inertia[k], part, impulse[i]);
    }
  }
  double turn = 0.0;
  for (const Twist& s : step) turn = std::max(turn, norm(s.angular));
  const double part = turn > kMostTurn ? kMostTurn / turn : 1.0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Pose& pose = bodies[k].pose;
    pose.position += part * step[k].linear;
    if (step[k].angular == Vec3{}) continue;
    pose.orientation = normalized(from_rotation_vector(part * step[k].angular) * pose.orientation);
  }
}

using SparseColumns = Eigen::SparseMatrix<double>;
using RankRevealing = Eigen::SparseQR<SparseColumns, Eigen::COLAMDOrdering<int>>;

/// Columns M^-1/2 D of rows, each of length one, factorised so that those that follow from others come last.
void factorise(std::span<const MachineRow> rows, std::span<const BodyInertia> inertia, RankRevealing& qr) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto& [body, part] : {std::pair{rows[i].a, rows[i].row.a}, std::pair{rows[i].b, rows[i].row.b}}) {
      if (body < 0 || inertia[static_cast<std::size_t>(body)].inverse_mass == 0.0) continue;
      const double heavy = std::sqrt(inertia[static_cast<std::size_t>(body)].inverse_mass);
      for (int axis = 0; axis < 3; ++axis) {
        entries.emplace_back(6 * body + axis, static_cast<int>(i), heavy * part.linear[axis]);
        // Weighed as the mass: whether rows depend on each other does not hang on it.
        entries.emplace_back(6 * body + 3 + axis, static_cast<int>(i), heavy * part.angular[axis]);
      }
    }
  }
  SparseColumns d(static_cast<Eigen::Index>(6 * inertia.size()), static_cast<Eigen::Index>(rows.size()));
  d.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index i = 0; i < d.cols(); ++i) {
    const double size = d.col(i).norm();
    if (size > 0.0) d.col(i) *= 1.0 / size;
  }
  d.makeCompressed();
  qr.setPivotThreshold(1e-7);
  qr.compute(d);
}

void find_redundant(const Equations& equations, std::span<const BodyInertia> inertia, AssemblyReport& report) {
  RankRevealing qr;
  factorise(equations.rows, inertia, qr);
  report.redundant_equations = static_cast<std::size_t>(qr.cols() - qr.rank());
  for (Eigen::Index k = qr.rank(); k < qr.cols(); ++k) {
    const std::uint32_t joint = equations.joint[static_cast<std::size_t>(qr.colsPermutation().indices()[k])];
    if (std::ranges::find(report.redundant, joint) == report.redundant.end()) report.redundant.push_back(joint);
  }
}

/// The first motor without a limit whose row follows from equations and earlier motors.
void find_contradiction(const MachineDescription& machine, const Equations& equations,
                        std::span<const BodyInertia> inertia, AssemblyReport& report) {
  std::vector<MachineRow> rows = equations.rows;
  RankRevealing qr;
  factorise(rows, inertia, qr);
  Eigen::Index rank = qr.rank();
  for (std::uint32_t k = 0; k < machine.motors.size(); ++k) {
    const Motor& motor = machine.motors[k];
    if (!is_imposed(motor)) continue;
    rows.push_back(equations.row_of(motor));
    factorise(rows, inertia, qr);
    if (qr.rank() == rank) {
      report.contradicting_motor = k;
      return;
    }
    rank = qr.rank();
  }
}

}  // namespace

AssemblyReport assemble(const MachineDescription& machine, std::span<NewBody> bodies, bool move) {
  AssemblyReport report;
  Equations equations{machine, bodies, true};
  std::vector<Vec3> start;
  for (const NewBody& body : bodies) start.push_back(body.pose.position);
  equations.evaluate(bodies);
  if (equations.rows.empty()) return report;
  report.tolerance = kTogether * equations.size();
  std::vector<BodyInertia> inertia(bodies.size());
  std::vector<double> none(equations.rows.size(), 0.0), impulse(equations.rows.size());
  JointProjection projection;
  report.error_before = std::abs(equations.value[equations.worst()]);
  for (int round = 0;; ++round) {
    std::ranges::transform(bodies, inertia.begin(), inertia_of);
    report.error = std::abs(equations.value[equations.worst()]);
    report.worst_joint = equations.joint[equations.worst()];
    report.together = report.error <= report.tolerance;
    if (!move || report.together || round == kMostRounds || !projection.bind(equations.rows, none, inertia)) break;
    projection.solve(equations.value, impulse);
    move_bodies(equations, impulse, inertia, bodies);
    equations.evaluate(bodies);
  }
  for (std::uint32_t j = 0; j < machine.joints.size(); ++j) {
    if (equations.is_flipped(j)) report.flipped.push_back(j);
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double way = norm(bodies[k].pose.position - start[k]);
    if (way > report.greatest_move) {
      report.greatest_move = way;
      report.moved_body = k;
    }
  }
  Equations joints{machine, bodies, false};
  joints.evaluate(bodies);
  if (joints.rows.empty()) return report;
  find_redundant(joints, inertia, report);
  find_contradiction(machine, joints, inertia, report);
  return report;
}

}  // namespace scree
