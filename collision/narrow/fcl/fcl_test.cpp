// What narrow phases around a library hold, of `fcl`.
#include "fcl_phase.hpp"
#include "library_phase_test.hpp"

namespace scree::test {

INSTANTIATE_TYPED_TEST_SUITE_P(fcl, LibraryPhase, FclNarrowPhase);

}  // namespace scree::test
