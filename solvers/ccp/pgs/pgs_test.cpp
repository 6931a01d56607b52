// pgs: the conformance suite of CCP solvers in all its orders and steps.
#include "pgs.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {

INSTANTIATE_TEST_SUITE_P(
    pgs, CcpSolverConformance,
    testing::Values(SolverCase{"scalar", [] { return std::make_unique<Pgs>(PgsOptions{.scalar_step = true}); }},
                    SolverCase{"relaxed", [] { return std::make_unique<Pgs>(PgsOptions{.relaxation = 1.5}); }},
                    SolverCase{"coloured", [] { return std::make_unique<Pgs>(PgsOptions{.coloured = true}); }}),
    solver_case_name);

}  // namespace scree::test
