// What every NarrowPhase owes: the conformance suite of the interface, pair of kinds by pair of kinds, which
// scree-conformance instantiates for the phases of a plugin.
#pragma once

#include "conformance/hollow_drum_case.hpp"
#include "conformance/narrow_phase_case.hpp"
#include "support/trials.hpp"

namespace scree::test {

class NarrowPhaseConformance : public testing::TestWithParam<NarrowPhaseCase> {};

TEST_P(NarrowPhaseConformance, contacts_are_true_and_none_is_missing) {
  const NarrowPhaseCase& param = GetParam();
  const int count = trials(param.poses);
  int faults = 0;
  for (int trial = 0; trial < count; ++trial) {
    const bool swapped = trial % 3 == 1;
    const NarrowPhasePose pose = narrow_phase_pose(swapped ? param.b : param.a, swapped ? param.a : param.b, trial);
    const std::string fault = fault_of(*param.make(), pose);
    if (fault.empty() || is_declared_exception(param, trial)) continue;
    if (++faults <= 5) ADD_FAILURE() << pose.description << ": " << fault;
  }
  EXPECT_EQ(faults, 0) << "of " << count << " poses";
}

/// The same for a phase and what it supports inside of a hollow cylinder: kind b of the case.
class HollowDrumConformance : public testing::TestWithParam<NarrowPhaseCase> {};

TEST_P(HollowDrumConformance, contacts_are_true_and_none_is_missing) {
  const int count = trials(GetParam().poses);
  int faults = 0;
  for (int trial = 0; trial < count; ++trial) {
    const DrumPose pose = drum_pose(GetParam().b, trial);
    const std::string fault = fault_of(*GetParam().make(), pose);
    if (!fault.empty() && ++faults <= 5) ADD_FAILURE() << pose.description << ": " << fault;
  }
  EXPECT_EQ(faults, 0) << "of " << count << " poses";
}

}  // namespace scree::test
