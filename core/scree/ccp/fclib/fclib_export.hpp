// Contact problems of scree in the form of FCLIB, for other programs.
#pragma once

#include <span>

#include "scree/ccp/fclib/fclib_problem.hpp"
#include "scree/ccp/problem.hpp"

namespace scree {

/// `problem` as a local problem, with the answer `gamma` (one a row) [N s] as its solution: W = D^T M^-1 D + E, q = r; free
/// blocks become bilateral constraints. @throws Error (usage) when it has blocks that FCLIB does not know: limits, motors,
/// spinning friction, contacts of different numbers of rows.
[[nodiscard]] FclibProblem export_to_fclib(const CcpProblem& problem, std::span<const double> gamma);

/// Finds what export_to_fclib() would refuse, at no cost. @throws Error (usage) as it does.
void check_exportable(const CcpProblem& problem);

}  // namespace scree
