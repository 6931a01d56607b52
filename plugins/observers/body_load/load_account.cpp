#include "load_account.hpp"

#include <array>

#include "scree/state/state_io.hpp"

namespace scree {

void LoadSum::add(const LoadSum& o) {
  impulse += o.impulse;
  angular_impulse += o.angular_impulse;
  axial_impulse += o.axial_impulse;
  work += o.work;
  contacts += o.contacts;
  steps += o.steps;
  time += o.time;
}

void LoadSum::save(StateWriter& out) const {
  out.write("impulses", std::span<const Vec3>{std::array{impulse, angular_impulse}});
  out.write("amounts", std::span<const double>{std::array{axial_impulse, work, contacts, steps, time}});
}

void LoadSum::load(const StateReader& in) {
  const std::vector<Vec3> impulses = in.vectors("impulses");
  const std::vector<double> amounts = in.doubles("amounts");
  impulse = impulses.at(0);
  angular_impulse = impulses.at(1);
  axial_impulse = amounts.at(0);
  work = amounts.at(1);
  contacts = amounts.at(2);
  steps = amounts.at(3);
  time = amounts.at(4);
}

LoadSum load_of(const BodyMotion& body, const Vec3& point, const WorldImpulse& impulse) {
  const Vec3 arm = point - body.pose.position;
  const Vec3 spin = body.velocity.angular + body.surface.angular;
  LoadSum load;
  load.impulse = impulse.linear;
  load.angular_impulse = cross(point - body.reference, impulse.linear) + impulse.angular;
  load.axial_impulse = dot(body.axis, load.angular_impulse);
  load.work =
      dot(impulse.linear, body.velocity.linear + body.surface.linear + cross(spin, arm)) + dot(impulse.angular, spin);
  load.contacts = 1.0;
  return load;
}

LoadSum load_of(const BodyMotion& body, const Vec3& centre, const ContactLoad& summed) {
  LoadSum load;
  load.impulse = summed.impulse;
  load.angular_impulse = summed.angular_impulse + cross(centre - body.reference, summed.impulse);
  load.axial_impulse = dot(body.axis, load.angular_impulse);
  load.work = summed.work;
  return load;
}

}  // namespace scree
