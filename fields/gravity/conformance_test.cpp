#include "conformance/force_field_conformance.hpp"

#include "gravity.hpp"

namespace scree::test {
namespace {

INSTANTIATE_TEST_SUITE_P(gravity, ForceFieldConformance,
                         testing::Values(ForceFieldCase{
                             "default", [](FakeSceneServices& services) { return set_up<Gravity>("", services); }}),
                         force_field_case_name);

}  // namespace
}  // namespace scree::test
