// siconos_error FILE...: the solution in each FCLIB file, by scree's judge and by Siconos' own.

#include <cstdio>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/fclib_ccp.hpp"
#include "scree/ccp/fclib/fclib_export.hpp"
#include "scree/ccp/fclib/fclib_file.hpp"
#include "scree/ccp/judge.hpp"
#include "siconos_error.hpp"

namespace {

void compare(const char* file) {
  const scree::FclibCcp reduced{scree::read_fclib_file(file), file};
  if (!reduced.source().solution) {
    std::printf("%s holds no solution\n", file);
    return;
  }
  const scree::CcpProblem problem = reduced.record().problem();
  const std::vector<double> gamma = reduced.impulses(*reduced.source().solution);
  const double ours = scree::CcpJudge{}.figures(problem, gamma, nullptr).coulomb_error;
  const scree::SiconosError theirs = scree::siconos_error(scree::export_to_fclib(problem, gamma), gamma);
  std::printf("%s\n  coulomb_error  %.17g\n  Siconos        %.17g over ||q||, difference %.3g\n", file, ours,
              theirs.over_q, ours - theirs.over_q);
  std::printf("  as it scales   %.17g, difference %.3g\n", theirs.own, ours - theirs.own);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    for (int k = 1; k < count; ++k) compare(arguments[k]);
  } catch (const scree::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
