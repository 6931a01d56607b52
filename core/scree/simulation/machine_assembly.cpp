// The start of a machine: joints put together, and what is said about it.
#include <algorithm>
#include <cstdio>

#include "scree/collision/collision_filter.hpp"
#include "scree/config/suggest.hpp"
#include "scree/machine/joint_assembly.hpp"
#include "scree/machine/machine.hpp"
#include "scree/simulation/scene_machine.hpp"

namespace scree {
namespace {

std::string in_metres(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", x);
  return text;
}

/// The options of joint `j`: joints come first among the machine's.
const Options& options_of(const SceneModel& model, std::uint32_t j) { return model.machine_options[j].second; }

std::string names_of(const SceneModel& model, const std::vector<std::uint32_t>& joints) {
  std::vector<std::string> names;
  for (const std::uint32_t j : joints) names.push_back(model.machine.joints[j].name);
  return list_of(names);
}

/// True of a joint whose two bodies do not touch each other.
bool keeps_apart(const SceneModel& model, std::uint32_t j) {
  const Joint& joint = model.machine.joints[j];
  return joint.a.body != kWorld && joint.b.body != kWorld && !options_of(model, j).boolean("collide");
}

/// Refuses joints that start outside their stops.
void check_stops(const SceneModel& model) {
  const auto pose = [&](BodyId id) { return id == kWorld ? Pose{} : model.bodies[id].body.pose; };
  for (std::uint32_t j = 0; j < model.machine.joints.size(); ++j) {
    const Joint& joint = model.machine.joints[j];
    const JointPlacement at{joint, pose(joint.a.body), pose(joint.b.body)};
    for (const Coordinate c : {Coordinate::rotation, Coordinate::translation}) {
      if (!joint.type->has(c)) continue;
      const bool turns = c == Coordinate::rotation;
      const CoordinateLaw& law = joint.along(c);
      const double value = coordinate_value(*joint.type, c, at);
      const double x = turns ? nearest_turn(value, starting_angle(model.machine, j)) : value;
      if (x >= law.lower - 1e-9 && x <= law.upper + 1e-9) continue;
      char text[160];
      std::snprintf(text, sizeof text, "joint '%.60s' starts at %.4g %s, outside its stops from %.4g to %.4g",
                    joint.name.c_str(), x, turns ? "rad" : "m", law.lower, law.upper);
      throw options_of(model, j).error(turns ? "rotation" : "translation",
                                       std::string{text} + "; turn or move its bodies, or the stops");
    }
  }
}

}  // namespace

void assemble_machine(SceneModel& model, std::vector<std::string>& log) {
  if (model.machine.joints.empty()) return;
  const bool move = model.simulation.boolean("assemble");
  std::vector<NewBody> bodies;
  for (const SceneBody& b : model.bodies) bodies.push_back(b.body);
  const AssemblyReport report = assemble(model.machine, bodies, move);
  if (!report.together) {
    const Joint& joint = model.machine.joints[report.worst_joint];
    const std::string lacks = "joint '" + joint.name + "' is off by " + in_metres(report.error);
    throw options_of(model, report.worst_joint)
        .error(lacks + (move ? " however its bodies are moved (" + in_metres(report.error_before) +
                                   " where they stand): its equations contradict those of other joints, or its frames "
                                   "are too far apart; look at the positions and axes of its frames"
                             : " where its bodies stand; move them, or set simulation.assemble = true"));
  }
  if (move && !report.flipped.empty()) {
    const std::uint32_t j = report.flipped.front();
    throw options_of(model, j).error("joint '" + model.machine.joints[j].name +
                                     "' went together with its axes opposed; turn one of its bodies or frames, so that "
                                     "they start within a quarter turn");
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) model.bodies[k].body.pose = bodies[k].pose;
  if (report.error_before > report.tolerance) {
    const std::string& name = model.bodies[report.moved_body].name;
    log.push_back("joints put together: the greatest gap was " + in_metres(report.error_before) +
                  ", the greatest move " + in_metres(report.greatest_move) +
                  (name.empty() ? std::string{} : ", of '" + name + "'"));
  }
  check_stops(model);
  if (report.contradicting_motor) {
    const Motor& motor = model.machine.motors[*report.contradicting_motor];
    throw options_of(model, static_cast<std::uint32_t>(model.machine.joints.size() + *report.contradicting_motor))
        .error("motor '" + motor.name +
               "' imposes what other joints and motors determine already; give one of them a limit, or take it away");
  }
  if (report.redundant_equations > 0) {
    log.push_back("joints repeat each other: " + std::to_string(report.redundant_equations) + " equations, of " +
                  names_of(model, report.redundant) +
                  ", follow from others; motion is not changed by that, but their reactions are not unique");
  }
}

void exclude_joined(const SceneModel& model, CollisionFilter& filter) {
  for (std::uint32_t j = 0; j < model.machine.joints.size(); ++j) {
    if (keeps_apart(model, j)) filter.exclude(model.machine.joints[j].a.body, model.machine.joints[j].b.body);
  }
}

void admit_parted(const SceneModel& model, const Machine& machine, std::vector<char>& known, CollisionFilter& filter) {
  known.resize(model.machine.joints.size(), 0);
  for (std::uint32_t j = 0; j < known.size(); ++j) {
    if (known[j] != 0 || !machine.is_gone(j)) continue;
    known[j] = 1;
    if (keeps_apart(model, j)) filter.admit(model.machine.joints[j].a.body, model.machine.joints[j].b.body);
  }
}

}  // namespace scree
