// The natural map of a contact problem as a 2-norm with one global scale, by which solvers were compared before there was
// the judge's residual.
#pragma once

#include <span>

#include "scree/ccp/delassus.hpp"

namespace scree::bench {

/// || g - P(g - s (N g + r)) ||_2 / (s ||r||_2) [1], with s = 3 m / trace(N) of m contacts, the inverse of N's mean diagonal
/// [kg]. `delassus` is bound to a problem of contacts only.
[[nodiscard]] double natural_map(DelassusOperator& delassus, std::span<const double> gamma);

}  // namespace scree::bench
