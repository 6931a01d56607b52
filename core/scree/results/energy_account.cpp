#include "scree/results/energy_account.hpp"

#include "scree/state/state_io.hpp"

namespace scree {

void EnergyAccount::save(StateWriter& out) const {
  out.write("contact_loss", work.contact_loss);
  out.write("boundary_work", work.boundary_work);
  out.write("force_work", work.force_work);
  out.write("joint_work", work.joint_work);
  out.write("fed_kinetic", fed_kinetic);
}

void EnergyAccount::load(const StateReader& in) {
  work = {in.number("contact_loss"), in.number("boundary_work"), in.number("force_work"), in.number("joint_work")};
  fed_kinetic = in.number("fed_kinetic");
}

}  // namespace scree
