// What every CcpSolver owes: the conformance suite of the interface, which scree-conformance instantiates for the
// solvers of a plugin with their defaults. A solver's test instantiates it for variants:
//
//     INSTANTIATE_TEST_SUITE_P(pgs, CcpSolverConformance, testing::Values(
//         SolverCase{"scalar", [] { return std::make_unique<Pgs>(PgsOptions{.scalar_step = true}); }}), solver_case_name);
#pragma once

#include "conformance/ccp_solver_answers.hpp"
#include "conformance/ccp_solver_blocks.hpp"
#include "conformance/ccp_solver_contract.hpp"
