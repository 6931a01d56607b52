// CCP solvers: the suite of the interface.
#include "conformance/ccp_solver_conformance.hpp"
#include "conformance/subject.hpp"

namespace scree::test {
namespace {

std::vector<SolverCase> cases() {
  std::vector<SolverCase> list;
  for (const Subject& subject : living_subjects(CcpSolver::kKind)) {
    list.push_back({subject.entry.name, [subject] {
                      return std::unique_ptr<CcpSolver>{static_cast<CcpSolver*>(subject.make().release())};
                    }});
  }
  return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CcpSolverConformance);
INSTANTIATE_TEST_SUITE_P(entry, CcpSolverConformance, testing::ValuesIn(cases()), solver_case_name);

}  // namespace
}  // namespace scree::test
