// FakeStepServices: a host for unit tests of time steppers. Spheres on a half
// space, uniform gravity, a slow and simple CCP solver of its own.
//
//     FakeStepServices host{bodies};          // body 0: the half space z <= 0
//     host.material({.friction = 0.5});
//     stepper.step(host, host.state(), 0.0, 1e-3);
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"
#include "support/test_bodies.hpp"

namespace scree::test {

/// Body 0 is the half space below its position, the others are spheres of their radius.
class FakeStepServices final : public StepServices {
 public:
  explicit FakeStepServices(TestBodies& bodies, int threads = 1) : bodies_{bodies}, executor_{threads} { material({}); }

  /// One material for all bodies; `values` hold for each contact.
  void material(const ContactMaterial& values) {
    materials_ = Materials{};
    materials_.add({"stuff", 1000.0, values, {}});
    materials_.set_pair(0, 0, values);
  }
  /// One more, of the given half of a pair, for bodies whose `material` says so.
  void add_material(const ContactMaterial& values) {
    materials_.add({"stuff " + std::to_string(materials_.size()), 1000.0, values, {}});
  }
  [[nodiscard]] BodyState state() {
    return {bodies_.view(), bodies_.position, bodies_.orientation, bodies_.velocity, bodies_.angular_velocity};
  }

  void forces(const BodyView& view, double, WrenchView out) override {
    for (std::size_t i = 0; i < view.size(); ++i) {
      out.force[i] = view.motion[i] == Motion::dynamic ? view.mass[i] * gravity : Vec3{};
      out.torque[i] = {};
    }
  }

  std::span<const Contact> contacts(const BodyView& view, std::span<const Vec3> v, std::span<const Vec3>,
                                    double dt) override {
    found_.clear();
    for (BodyIndex a = 0; a < view.size(); ++a) {
      for (BodyIndex b = a + 1; b < view.size(); ++b) {
        const Contact c = a == 0 ? on_floor(view, b) : between(view, a, b);
        if (c.gap < dt * norm(v[b] - v[a]) + 1e-3 * view.radius[b]) found_.push_back(c);
      }
    }
    return found_;
  }

  // Projected Gauss-Seidel straight from the definition: the whole product for every contact.
  SolveSummary solve_ccp(const CcpProblem& problem, std::span<double> gamma) override {
    ++solves;
    DelassusOperator delassus;
    delassus.bind(problem, nullptr);
    std::vector<double> u(problem.rows());
    SolveSummary summary{SolveStatus::iteration_limit, 0, ccp_residual(problem, gamma)};
    while (summary.residual > tolerance && summary.iterations < 5000) {
      for (std::size_t i = 0; i < problem.units(); ++i) {
        delassus.apply(gamma, u);
        for (std::size_t k = 0; k < u.size(); ++k) u[k] += problem.r[k];
        if (i < problem.contacts.size()) {
          update_contact(problem, i, u, gamma);
        } else {
          // Below twice the inverse of the greatest eigenvalue: each update gains. Of six rows it is not the whole trace.
          const std::size_t block = i - problem.contacts.size();
          const double step = problem.blocks[block].rows == 6 ? 2.0 : 1.0;
          update_block(problem, block, step / delassus.traces()[i], u, gamma);
        }
      }
      ++summary.iterations;
      summary.residual = ccp_residual(problem, gamma);
    }
    if (summary.residual <= tolerance) summary.status = SolveStatus::converged;
    iterations += summary.iterations;
    return summary;
  }

  [[nodiscard]] const Materials& materials() const override { return materials_; }
  [[nodiscard]] const Executor& executor() const override { return executor_; }
  [[nodiscard]] Machine* machine() override { return joints; }

  Machine* joints = nullptr;      ///< of the scene; none
  Vec3 gravity{0.0, 0.0, -9.81};  ///< [m/s2]
  double tolerance = 1e-13;       ///< of the solver [m/s]
  int solves = 0;                 ///< CCPs solved so far
  int iterations = 0;             ///< sweeps so far

 private:
  static Contact on_floor(const BodyView& view, BodyIndex b) {
    const Vec3 x = view.position[b];
    const double floor = view.position[0].z, gap = x.z - floor - view.radius[b];
    return {0, b, 0, 0, 0, {x.x, x.y, floor + 0.5 * gap}, {0, 0, 1}, gap};
  }
  static Contact between(const BodyView& view, BodyIndex a, BodyIndex b) {
    const Vec3 apart = view.position[b] - view.position[a];
    const Vec3 n = normalized(apart);
    const double gap = norm(apart) - view.radius[a] - view.radius[b];
    return {a, b, 0, 0, 0, view.position[a] + (view.radius[a] + 0.5 * gap) * n, n, gap};
  }

  static void update_contact(const CcpProblem& problem, std::size_t i, std::span<const double> u,
                             std::span<double> gamma) {
    const Mat3 block = diagonal_block(problem, i);
    const double step = 1.0 / std::max({block.row0.x, block.row1.y, block.row2.z});
    const Vec3 g = load_block(gamma, i) - step * load_block(u, i);
    store_block(gamma, i, project_cone3(g, problem.contacts[i].friction));
  }
  static void update_block(const CcpProblem& problem, std::size_t i, double step, std::span<const double> u,
                           std::span<double> gamma) {
    const CcpBlock& block = problem.blocks[i];
    const std::size_t first = problem.contact_rows() + block.first_row;
    const std::span<double> g = gamma.subspan(first, block.rows);
    for (std::size_t k = 0; k < g.size(); ++k) g[k] -= step * u[first + k];
    project_block(block, g);
  }

  TestBodies& bodies_;
  Executor executor_;
  Materials materials_;
  std::vector<Contact> found_;
};

}  // namespace scree::test
