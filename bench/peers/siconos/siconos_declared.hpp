// Two problems that libsiconos_numerics solves, whose headers Debian's package leaves out: declared here as the manual of Siconos
// describes them. siconos_methods_test would notice another layout.
#pragma once

#include <NumericsFwd.h>

// NOLINTBEGIN(readability-identifier-naming): names of Siconos.
extern "C" {

/// Find r in the product of the cones |r_t| <= tau r_n with v = M r + q in its dual, r . v = 0.
struct SecondOrderConeLinearComplementarityProblem {
  int n, nc;
  NumericsMatrix* M;
  double* q;
  unsigned int* coneIndex;  ///< nc + 1: first row of each cone
  double* tau;
};

/// Minimise 1/2 z M z + q z for A z + b in C; A = nullptr is the identity.
struct ConvexQP {
  int size, m;
  void* env;
  NumericsMatrix* M;
  double* q;
  NumericsMatrix* A;
  double* b;
  void (*ProjectionOnC)(void* self, double* x, double* projected);
  double normConvexQP;
  int istheNormConvexQPset;
};

int soclcp_driver(SecondOrderConeLinearComplementarityProblem* problem, double* r, double* v, SolverOptions* options);
void convexQP_ProjectedGradient(ConvexQP* problem, double* z, double* w, int* info, SolverOptions* options);
void convexQP_ADMM(ConvexQP* problem, double* z, double* w, double* xi, double* u, int* info, SolverOptions* options);
}
// NOLINTEND(readability-identifier-naming)

namespace scree {

constexpr int kSoclcpNsgs = 1100, kSoclcpFixedPoint = 1106, kSoclcpExtraGradient = 1107;
constexpr int kConvexQpGradient = 1200, kConvexQpAdmm = 1203;

}  // namespace scree
