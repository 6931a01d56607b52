// Rig: a few bodies, joints and contacts that are stepped by hand, semi-implicitly, with any solver of the contact problem.
//
//     v1 = v0 + h g + M^-1 D gamma,   q1 = q0 + h v1,   joint rows b = Psi / h, contact rows b = Phi / h
//
// Bodies turn with an inertia that is the same in all directions, so that nothing but positions and rows is needed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/math/quat.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {

constexpr double kGravity = 9.81;  // [m/s2]
constexpr double kFriction = 0.5;

/// Ball joint of two bodies: a point of each, in its own frame [m].
struct PointJoint {
  std::uint32_t a = 0, b = 0;
  Vec3 on_a, on_b;
  bool fixed = false;  ///< no turning either
};

/// Contact of b with the plane z = height of a, which is level: of a point of b, or of a ball's lowest.
struct FootContact {
  std::uint32_t a = 0, b = 0;
  double height = 0.0;  ///< over the centre of a [m]
  Vec3 on_b;            ///< [m]
  bool ball = false;
};

struct Rig {
  std::vector<double> mass, inertia;  ///< [kg], [kg m2]; mass 0: immovable
  std::vector<Vec3> position;         ///< [m]
  std::vector<Quat> orientation;
  std::vector<Twist> velocity;  ///< [m/s], [rad/s]
  std::vector<PointJoint> joints;
  std::vector<FootContact> feet;
  double step = 1e-3;   ///< [s]
  double length = 1.0;  ///< that makes velocities of angular ones [m]
  double share = 1.0;   ///< of a joint's error that a step undoes [1]
  double drag = 0.0;    ///< torque of a motor about y on body 1 at most, to stand still [N m]; 0: no motor
  TestingProblem problem;
  std::vector<double> gamma;  ///< [N s], of the step before

  std::uint32_t add(double m, double j, const Vec3& centre) {
    mass.push_back(m), inertia.push_back(j), position.push_back(centre);
    orientation.emplace_back(), velocity.emplace_back();
    return static_cast<std::uint32_t>(mass.size() - 1);
  }
  [[nodiscard]] Vec3 point(std::uint32_t body, const Vec3& local) const {
    return position[body] + rotate(orientation[body], local);
  }
  [[nodiscard]] Vec3 apart(const PointJoint& j) const { return point(j.b, j.on_b) - point(j.a, j.on_a); }
  [[nodiscard]] double worst_joint() const {
    double worst = 0.0;
    for (const PointJoint& j : joints) worst = std::max(worst, norm(apart(j)));
    return worst;
  }
  /// Kinetic and potential [J].
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < mass.size(); ++k) {
      sum += 0.5 * (mass[k] * squared_norm(velocity[k].linear) + inertia[k] * squared_norm(velocity[k].angular)) +
             mass[k] * kGravity * position[k].z;
    }
    return sum;
  }

  /// The problem of the next step, in `problem`; velocities become the free ones.
  void pose() {
    problem = {};
    for (std::size_t k = 0; k < mass.size(); ++k) {
      if (mass[k] == 0.0) {
        problem.add_immovable();
        continue;
      }
      problem.add_body(mass[k], {inertia[k], inertia[k], inertia[k]});
      velocity[k].linear.z -= step * kGravity;
    }
    for (const FootContact& f : feet) {
      const Vec3 foot = f.ball ? position[f.b] + f.on_b : point(f.b, f.on_b);
      const double gap = foot.z - position[f.a].z - f.height;
      problem.add_contact(f.a, f.b, {0, 0, 1}, foot - position[f.a], foot - position[f.b], kFriction, {});
      const Vec3 u = relative_velocity(problem.contacts.back(), velocity[f.a], velocity[f.b]);
      store_block(problem.r, problem.contacts.size() - 1,
                  u + Vec3{gap > 0.0 ? gap / step : std::max(gap / step, -0.15), 0, 0});
    }
    for (const PointJoint& j : joints) add_joint(j);
    if (drag > 0.0) add_motor();
  }

  /// Poses a step, solves it and moves.
  SolveSummary advance(CcpSolver& solver, int iterations) {
    pose();
    const CcpProblem view = problem.view();
    gamma.resize(view.rows(), 0.0);
    SolveContext context;
    context.tolerance = 1e-9;
    context.max_iterations = iterations;
    const SolveSummary summary = solver.solve(view, context, gamma);
    DelassusOperator delassus;
    delassus.bind(view, nullptr);
    std::vector<Twist> w(view.bodies());
    delassus.body_velocities(gamma, w);
    for (std::size_t k = 0; k < mass.size(); ++k) {
      velocity[k] += w[k];
      position[k] += step * velocity[k].linear;
      if (velocity[k].angular == Vec3{}) continue;
      orientation[k] = normalized(from_rotation_vector(step * velocity[k].angular) * orientation[k]);
    }
    return summary;
  }

 private:
  void add_rows(std::uint32_t a, std::uint32_t b, CcpBlock block, const std::vector<CcpRow>& rows,
                const std::vector<double>& off) {
    std::vector<double> r;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      r.push_back(dot(rows[i].a.linear, velocity[a].linear) + dot(rows[i].a.angular, velocity[a].angular) +
                  dot(rows[i].b.linear, velocity[b].linear) + dot(rows[i].b.angular, velocity[b].angular) + off[i]);
    }
    block.a = a, block.b = b;
    problem.add_block(block, rows, r);
  }
  void add_joint(const PointJoint& j) {
    const Vec3 gap = (share / step) * apart(j);
    const std::vector<CcpRow> rows =
        rows_at_a_point(j.fixed ? 6 : 3, false, {0, 0, 1}, point(j.a, j.on_a) - position[j.a],
                        point(j.b, j.on_b) - position[j.b], length);
    const ContactFrame f = contact_frame({0, 0, 1});
    std::vector<double> off{dot(gap, f.normal), dot(gap, f.tangent1), dot(gap, f.tangent2)};
    if (j.fixed) {
      // The vector part of the rotation of b against a: half the angle.
      const Quat turned = orientation[j.b] * conjugate(orientation[j.a]);
      const Vec3 angle =
          (2.0 * share * length / step * (turned.w < 0.0 ? -1.0 : 1.0)) * Vec3{turned.x, turned.y, turned.z};
      for (const Vec3& axis : {f.normal, f.tangent1, f.tangent2}) off.push_back(dot(angle, axis));
    }
    add_rows(j.a, j.b, {.kind = CcpKind::free}, rows, off);
  }
  /// The drum's axle along y and its motor: five free rows and a box.
  void add_motor() {
    std::vector<CcpRow> rows;
    std::vector<double> off;
    for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      rows.push_back({{-e, {}}, {e, {}}});
      off.push_back(share * dot(position[1], e) / step);
    }
    for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 0, 1}})
      rows.push_back({{{}, -length * e}, {{}, length * e}}), off.push_back(0.0);
    add_rows(0, 1, {.kind = CcpKind::free}, rows, off);
    const Vec3 y{0, 1, 0};
    const double most = drag * step / length;
    add_rows(0, 1, {.kind = CcpKind::box, .lower = -most, .upper = most}, {{{{}, -length * y}, {{}, length * y}}},
             {0.0});
  }
};

}  // namespace scree::test
