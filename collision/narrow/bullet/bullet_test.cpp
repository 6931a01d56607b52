// What narrow phases around a library hold, of `bullet`.
#include "bullet.hpp"
#include "library_phase_test.hpp"

namespace scree::test {

INSTANTIATE_TYPED_TEST_SUITE_P(bullet, LibraryPhase, BulletNarrowPhase);

}  // namespace scree::test
