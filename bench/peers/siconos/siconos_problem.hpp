// A recorded contact problem in the forms that solvers of Siconos take.
#pragma once

#include <memory>
#include <vector>

#include "scree/ccp/problem.hpp"

struct NumericsMatrix;

namespace scree {

struct FreeNumericsMatrix {
  void operator()(NumericsMatrix* matrix) const;
};
using NumericsMatrixPtr = std::unique_ptr<NumericsMatrix, FreeNumericsMatrix>;

/// Local form: u = W g + q, `q` = r. Only contacts: @throws scree::Error for a problem with blocks.
struct LocalForm {
  explicit LocalForm(const CcpProblem& problem);
  NumericsMatrixPtr w;           ///< D^T M^-1 D + E [1/kg]
  std::vector<double> q;         ///< [m/s]
  std::vector<double> friction;  ///< one a contact [1]
};

/// Global form: M v = H g, u = H^T v + b with b = r; six rows for each movable body. @throws scree::Error for compliance as well,
/// which this form has no place for.
struct GlobalForm {
  explicit GlobalForm(const CcpProblem& problem);
  NumericsMatrixPtr m;           ///< masses [kg], moments of inertia [kg m2]
  NumericsMatrixPtr h;           ///< linear [1], angular [m]
  std::vector<double> q;         ///< forces, none [N s]
  std::vector<double> b;         ///< [m/s]
  std::vector<double> friction;  ///< one a contact [1]
};

}  // namespace scree
