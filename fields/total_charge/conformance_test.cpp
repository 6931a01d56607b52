#include "conformance/force_field_conformance.hpp"

#include "total_charge.hpp"

namespace scree::test {
namespace {

INSTANTIATE_TEST_SUITE_P(total_charge, ForceFieldConformance,
                         testing::Values(ForceFieldCase{
                             "default",
                             [](FakeSceneServices& services) { return set_up<TotalCharge>("", services); },
                             {{"charge_induced", 1e-10}, {"charge_corona", -1e-10}}}),
                         force_field_case_name);

}  // namespace
}  // namespace scree::test
