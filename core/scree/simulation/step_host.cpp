#include "scree/simulation/step_host.hpp"

#include <algorithm>
#include <utility>

#include "scree/base/release.hpp"
#include "scree/collision/simple_pairs.hpp"
#include "scree/simulation/force_sum.hpp"

namespace scree {

void StepHost::forces(const BodyView& bodies, double time, WrenchView out) {
  const PhaseTimer::Scope scope{timer_, Phase::forces};
  sum_forces(parts_.forces, bodies, time, out);
}

std::span<const Contact> StepHost::contacts(const BodyView& bodies, std::span<const Vec3> free_velocity,
                                            std::span<const Vec3> free_angular_velocity, double dt) {
  const PhaseTimer::Scope scope{timer_, Phase::collision};
  const std::span<const Contact> found = pipeline_.find(bodies, free_velocity, free_angular_velocity, dt);
  if (births_ != nullptr) births_->check(bodies, found, known_);
  return found;
}

std::span<const Contact> StepHost::wall_contacts(const BodyView& bodies, std::span<const BodyIndex> few,
                                                 std::span<const Vec3> velocity, std::span<const Vec3> angular_velocity,
                                                 double dt) {
  const PhaseTimer::Scope scope{timer_, Phase::collision};
  return pipeline_.find_walls(bodies, few, velocity, angular_velocity, dt);
}

NeighbourView StepHost::neighbours(const BodyView& bodies, const ExpectedMotion& expected) {
  const PhaseTimer::Scope scope{timer_, Phase::collision};
  const NeighbourView found = pipeline_.find_neighbours(bodies, expected);
  if (births_ != nullptr && births_->first_unseen(bodies.size()) < bodies.size()) check_births(bodies, found);
  return found;
}

// Simple pairs never become contacts of the host.
void StepHost::check_births(const BodyView& bodies, const NeighbourView& neighbours) {
  const BodyIndex first = births_->first_unseen(bodies.size());
  const std::span<const Contact> others = pipeline_.collide_neighbours(bodies, 0.0);
  std::vector<Contact> contacts{others.begin(), others.end()};
  for (const auto [a, b] : neighbours.balls) {
    if (b < first) continue;
    const double gap = simple_gap(*shapes_, bodies, a, b);
    if (gap >= 0.0) continue;
    contacts.emplace_back();
    contacts.back().a = a, contacts.back().b = b, contacts.back().gap = gap;
  }
  births_->check(bodies, contacts, known_);
}

std::span<const Contact> StepHost::neighbour_contacts(const BodyView& bodies, double reach) {
  const PhaseTimer::Scope scope{timer_, Phase::collision};
  return pipeline_.collide_neighbours(bodies, reach);
}

bool StepHost::forces_are_steady() const {
  return std::ranges::all_of(parts_.forces, [](const Part<ForceField>& field) { return field.plugin->is_steady(); });
}

SolveSummary StepHost::solve_ccp(const CcpProblem& problem, std::span<double> gamma) {
  const PhaseTimer::Scope scope{timer_, Phase::solver};
  if (!parts_.solver) {
    throw Error{ErrorKind::usage, parts_.stepper.info.label() +
                                      " solves a contact problem, but the scene has no [ccp_solver]; add one with "
                                      "`type`, and let needs_ccp_solver() of the stepper tell"};
  }
  if (const ProblemTap tap = std::exchange(tap_, {})) {
    const PhaseTimer::Scope output{timer_, Phase::output};
    tap(problem, gamma);
  }
  const SolveContext context{.tolerance = parts_.solver_tolerance,
                             .max_iterations = parts_.solver_iterations,
                             .executor = &executor_,
                             .on_iteration = {}};
  CcpSolver& solver = *parts_.solver->plugin;
  return guarded(parts_.solver->info, ErrorKind::diverged, [&] {
    const SolveSummary summary =
        parts_.active_set ? active_set_.solve(solver, problem, context, gamma) : solver.solve(problem, context, gamma);
    if (problem.contacts.size() >= kManyRecords) {
      active_set_ = {};
      solver.release_workspace();
    }
    return summary;
  });
}

}  // namespace scree
