#include "scree/simulation/force_sum.hpp"

#include <algorithm>

namespace scree {
namespace {

/// The first body that forces move and whose force or torque is not finite, or the number of bodies. Entries of other bodies
/// are ignored: their mass is infinite, and a field may well have multiplied by it.
std::size_t first_bad(const BodyView& bodies, const WrenchView& wrench) {
  for (std::size_t i = 0; i < wrench.force.size(); ++i) {
    if (bodies.motion[i] != Motion::dynamic) continue;
    if (!is_finite(wrench.force[i]) || !is_finite(wrench.torque[i])) return i;
  }
  return wrench.force.size();
}

void clear(const WrenchView& wrench) {
  std::fill(wrench.force.begin(), wrench.force.end(), Vec3{});
  std::fill(wrench.torque.begin(), wrench.torque.end(), Vec3{});
}

/// Evaluates the fields one by one. Only for the message, so the cost does not matter.
[[noreturn]] void throw_guilty(std::span<const Part<ForceField>> fields, const BodyView& bodies, double time,
                               WrenchView wrench) {
  for (const Part<ForceField>& field : fields) {
    clear(wrench);
    field.plugin->add_forces(bodies, time, wrench);
    const std::size_t body = first_bad(bodies, wrench);
    if (body == bodies.size()) continue;
    throw Error{ErrorKind::diverged, field.info.label_with_library() + ": the force on body " +
                                         std::to_string(bodies.id[body]) + " is not a finite number at t = " +
                                         std::to_string(time) + " s; check the field's parameters near that body"};
  }
  throw Error{ErrorKind::diverged, "the forces of several fields overflow when they are added up at t = " +
                                       std::to_string(time) + " s; check their parameters"};
}

}  // namespace

void sum_forces(std::span<const Part<ForceField>> fields, const BodyView& bodies, double time, WrenchView out) {
  clear(out);
  for (const Part<ForceField>& field : fields) {
    guarded(field.info, ErrorKind::diverged, [&] { field.plugin->add_forces(bodies, time, out); });
  }
  if (first_bad(bodies, out) != bodies.size()) throw_guilty(fields, bodies, time, out);
}

}  // namespace scree
