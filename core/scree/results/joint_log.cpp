#include "scree/results/joint_log.hpp"

#include "scree/machine/joint_type.hpp"

namespace scree {

JointLog::JointLog(const std::filesystem::path& file)
    : table_{file,
             {{"time", "s"},
              {"name", ""},
              {"kind", ""},
              {"rotation", "rad"},
              {"angular_speed", "rad/s"},
              {"translation", "m"},
              {"speed", "m/s"},
              {"force_x", "N"},
              {"force_y", "N"},
              {"force_z", "N"},
              {"torque_x", "N m"},
              {"torque_y", "N m"},
              {"torque_z", "N m"},
              {"effort_torque", "N m"},
              {"effort_force", "N"},
              {"power", "W"},
              {"energy", "J"},
              {"error", "m"},
              {"state", ""}}} {}

void JointLog::add(const Machine& machine, double time) {
  const MachineDescription& m = machine.description();
  std::size_t k = 0;
  for (const Joint& joint : m.joints) {
    add_row(time, joint.name, joint.type->name, machine.reports()[k++]);
  }
  for (const Motor& motor : m.motors) {
    // A motor moves along the coordinates of its joint.
    MachineReport report = machine.reports()[k++];
    const MachineReport& joint = machine.reports()[motor.joint];
    report.rotation = joint.rotation;
    report.rotation_rate = joint.rotation_rate;
    report.translation = joint.translation;
    report.translation_rate = joint.translation_rate;
    report.gone = joint.gone;
    add_row(time, motor.name, "motor", report);
  }
  for (const Coupling& coupling : m.couplings) {
    MachineReport report = machine.reports()[k++];
    report.gone = machine.reports()[coupling.first].gone || machine.reports()[coupling.second].gone;
    add_row(time, coupling.name, "coupling", report);
  }
}

void JointLog::add_row(double time, std::string_view name, std::string_view kind, const MachineReport& r) {
  table_.cell(time).cell(name).cell(kind).cell(r.rotation).cell(r.rotation_rate).cell(r.translation);
  table_.cell(r.translation_rate).cell(r.force.x).cell(r.force.y).cell(r.force.z);
  table_.cell(r.torque.x).cell(r.torque.y).cell(r.torque.z);
  table_.cell(r.effort_torque).cell(r.effort_force);
  table_.cell(r.power).cell(r.energy).cell(r.position_error).cell(r.gone ? "gone" : "holds");
  table_.end_row();
}

}  // namespace scree
