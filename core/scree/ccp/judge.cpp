#include "scree/ccp/judge.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/cone3.hpp"

namespace scree {

namespace {

/// Square of the residual of one block [m2/s2]: impulse `g` [N s], velocity `u` [m/s], 1/s = trace(N_ii) / 3 [1/kg]. The two
/// common cases, a contact that sticks and one that opens, need no root and no division.
double squared_residual(const Vec3& g, const Vec3& u, double mu, double s, double inverse_s) {
  const Vec3 x = g - s * u;
  const double n = x.x;
  const double tt = x.y * x.y + x.z * x.z;
  const double mu2 = mu * mu;
  if (n >= 0.0 && tt <= mu2 * n * n) return squared_norm(u);                          // x in K: P x = x
  if (n <= 0.0 && mu2 * tt <= n * n) return squared_norm(g) * inverse_s * inverse_s;  // x in -K*: P x = 0
  return squared_norm(g - project_cone3(x, mu)) * inverse_s * inverse_s;
}

}  // namespace

double ccp_residual(const DelassusOperator& delassus, std::span<const double> gamma, std::span<const Twist> w,
                    std::vector<double>& partial) {
  const CcpProblem& problem = delassus.problem();
  const bool compliant = !problem.compliance.empty();
  partial.assign(Executor::chunk_count(problem.contacts.size(), DelassusOperator::kGrain), 0.0);
  delassus.for_chunks(problem.contacts.size(), [&](std::size_t first, std::size_t last) {
    double worst = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double trace = delassus.traces()[i];
      if (trace == 0.0) continue;  // two immovable bodies: no impulse changes anything
      const CcpContact& c = problem.contacts[i];
      const Vec3 g = load_block(gamma, i);
      Vec3 u = relative_velocity(c, w[c.a], w[c.b]) + load_block(problem.r, i);
      if (compliant) u += hadamard(load_block(problem.compliance, i), g);
      const double error = squared_residual(g, u, c.friction, 3.0 / trace, trace / 3.0);
      if (!(error <= worst)) worst = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
    }
    partial[first / DelassusOperator::kGrain] = worst;
  });
  return partial.empty() ? 0.0 : std::sqrt(*std::max_element(partial.begin(), partial.end()));
}

double CcpJudge::residual(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "CcpJudge: gamma needs three numbers a contact");
  delassus_.bind(problem, executor);
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  return ccp_residual(delassus_, gamma, w_, partial_);
}

CcpFigures CcpJudge::figures(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  CcpFigures out;
  out.residual = residual(problem, gamma, executor);
  u_.resize(problem.rows());
  delassus_.apply(gamma, u_);
  double associated = 0.0, coulomb = 0.0, scale = 0.0;  // squares
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const double mu = problem.contacts[i].friction;
    const Vec3 g = load_block(gamma, i), r = load_block(problem.r, i);
    Vec3 u = load_block(u_, i) + r;
    out.objective += 0.5 * dot(g, u + r);
    associated += squared_norm(g - project_cone3(g - u, mu));
    u.x += mu * std::hypot(u.y, u.z);
    coulomb += squared_norm(g - project_cone3(g - u, mu));
    scale += squared_norm(r);
  }
  const double length = scale > 0.0 ? std::sqrt(scale) : 1.0;
  out.relative_residual = std::sqrt(associated) / length;
  out.coulomb_error = std::sqrt(coulomb) / length;
  return out;
}

double ccp_residual(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  CcpJudge judge;
  return judge.residual(problem, gamma, executor);
}

}  // namespace scree
