#include "natural_map.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "scree/ccp/cone3.hpp"

namespace scree::bench {

double natural_map(DelassusOperator& delassus, std::span<const double> gamma) {
  const CcpProblem& problem = delassus.problem();
  const std::span<const double> traces = delassus.traces();
  const double s = static_cast<double>(problem.rows()) / std::accumulate(traces.begin(), traces.end(), 0.0);
  std::vector<double> u(problem.rows());
  delassus.apply(gamma, u);
  double error = 0.0, scale = 0.0;  // squares
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Vec3 g = load_block(gamma, i), r = load_block(problem.r, i);
    error += squared_norm(g - project_cone3(g - s * (load_block(u, i) + r), problem.contacts[i].friction));
    scale += squared_norm(r);
  }
  return std::sqrt(error / scale) / s;
}

}  // namespace scree::bench
