#include "conformance/force_field_conformance.hpp"

#include "drag.hpp"

namespace scree::test {
namespace {

INSTANTIATE_TEST_SUITE_P(drag, ForceFieldConformance,
                         testing::Values(ForceFieldCase{"stokes",
                                                        [](FakeSceneServices& services) {
                                                          return set_up<Drag>("law = 'stokes'", services);
                                                        }},
                                         ForceFieldCase{"schiller_naumann",
                                                        [](FakeSceneServices& services) {
                                                          return set_up<Drag>("wind = [1.0, 2.0, 3.0]", services);
                                                        }}),
                         force_field_case_name);

}  // namespace
}  // namespace scree::test
