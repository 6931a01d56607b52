#include "scree/ccp/judge.hpp"

#include <algorithm>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/contact_residual.hpp"

namespace scree {

namespace {

/// Square of || g - P(g - s u) || of one block [N2 s2]. Where P leaves a number as it is, the difference is s u itself,
/// without the rounding of g.
double squared_map(const CcpBlock& block, std::span<const double> g, std::span<const double> u, double s) {
  BlockVector x, p;
  double total = 0.0;
  for (std::size_t k = 0; k < block.rows; ++k) x[k] = p[k] = g[k] - s * u[k];
  project_block(block, {p.data(), block.rows});
  for (std::size_t k = 0; k < block.rows; ++k) {
    const double difference = p[k] == x[k] ? s * u[k] : g[k] - p[k];
    total += difference * difference + 0.0 * u[k];  // a projection may hide a number that is none
  }
  return total;
}

/// The larger of both; infinite when `error` is not a number.
double worse(double worst, double error) {
  if (error <= worst) return worst;
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// How far `u` is outside of the velocities that a block can have at a solution [m/s].
double velocity_violation(const CcpBlock& block, std::span<const double> u) {
  if (block.kind == CcpKind::cone) return dissipation_rate(block, u) - u[0];
  const bool pulls = block.kind == CcpKind::free || (block.kind == CcpKind::box && std::isinf(block.lower));
  const bool pushes = block.kind != CcpKind::box || std::isinf(block.upper);
  double worst = 0.0;
  for (std::size_t k = 0; k < block.rows; ++k) {
    if (pushes) worst = std::max(worst, -u[k]);
    if (pulls) worst = std::max(worst, u[k]);
  }
  return worst;
}

/// |g . u| of a cone; row by row of everything else, from the bound that holds the row against u [J].
double complementarity_gap(const CcpBlock& block, std::span<const double> g, std::span<const double> u) {
  double sum = 0.0;
  for (std::size_t k = 0; k < block.rows; ++k) {
    if (block.kind == CcpKind::cone) {
      sum += g[k] * u[k];
      continue;
    }
    const double bound = block.kind != CcpKind::box ? 0.0 : u[k] > 0.0 ? block.lower : block.upper;
    sum += std::abs((std::isinf(bound) ? g[k] : g[k] - bound) * u[k]);
  }
  return std::abs(sum);
}

/// Sums of squares of the figures that are norms.
struct Squares {
  double associated = 0.0, coulomb = 0.0, worst_coulomb = 0.0, r = 0.0;
};

/// Adds what one unit has to say; `trace` is that of N_ii.
void judge_unit(const CcpBlock& block, std::span<const double> g, std::span<const double> u, std::span<const double> r,
                double trace, Squares& squares, CcpFigures& out) {
  BlockVector de_saxce{};
  std::copy(u.begin(), u.end(), de_saxce.begin());
  const std::span<const double> coulomb{de_saxce.data(), block.rows};
  if (block.kind == CcpKind::cone) de_saxce[0] += dissipation_rate(block, u);
  for (std::size_t k = 0; k < block.rows; ++k) {
    out.objective += 0.5 * g[k] * (u[k] + r[k]);
    squares.r += r[k] * r[k];
  }
  squares.associated += squared_map(block, g, u, 1.0);
  squares.coulomb += squared_map(block, g, coulomb, 1.0);
  out.impulse_violation = worse(out.impulse_violation, violation(block, g));
  out.velocity_violation = worse(out.velocity_violation, velocity_violation(block, u));
  out.complementarity_gap += complementarity_gap(block, g, u);
  if (trace == 0.0) return;
  squares.worst_coulomb = worse(squares.worst_coulomb, squared_block_residual(block, g, coulomb, trace));
}

}  // namespace

double squared_block_residual(const CcpBlock& block, std::span<const double> g, std::span<const double> u,
                              double trace) {
  const double s = block.rows / trace;
  if (s > kLeastScale && s < kMostScale) return squared_map(block, g, u, s) / (s * s);
  // As for contacts, in velocities; bounds are impulses.
  CcpBlock scaled = block;
  scaled.lower *= trace / block.rows;
  scaled.upper *= trace / block.rows;
  BlockVector velocity{};
  for (std::size_t k = 0; k < block.rows; ++k) velocity[k] = g[k] * (trace / block.rows);
  return squared_map(scaled, {velocity.data(), block.rows}, u, 1.0);
}

double ccp_residual(const DelassusOperator& delassus, std::span<const double> gamma, std::span<const Twist> w,
                    std::vector<double>& partial) {
  const CcpProblem& problem = delassus.problem();
  const bool compliant = !problem.compliance.empty();
  const std::span<const double> traces = delassus.traces();
  partial.assign(Executor::chunk_count(problem.units(), DelassusOperator::kGrain), 0.0);
  delassus.for_chunks(problem.units(), [&](std::size_t first, std::size_t last) {
    double worst = 0.0;
    delassus.for_units(
        first, last,
        [&](std::size_t i) {
          const double trace = traces[i];
          if (trace == 0.0) return;  // two immovable bodies: no impulse changes anything
          const CcpContact& c = problem.contacts[i];
          const Vec3 g = load_block(gamma, i);
          Vec3 u = relative_velocity(c, w[c.a], w[c.b]) + load_block(problem.r, i);
          if (compliant) u += hadamard(load_block(problem.compliance, i), g);
          worst = worse(worst, squared_contact_residual(g, u, c.friction, 3.0 / trace, trace / 3.0));
        },
        [&](std::size_t i) {
          const double trace = traces[problem.contacts.size() + i];
          if (trace == 0.0) return;
          const CcpBlock& block = problem.blocks[i];
          const std::span<const double> g = rows_of(problem, block, gamma), r = rows_of(problem, block, problem.r);
          BlockVector u;
          delassus.block_velocity(i, w, gamma, u);
          for (std::size_t k = 0; k < block.rows; ++k) u[k] += r[k];
          worst = worse(worst, squared_block_residual(block, g, {u.data(), block.rows}, trace));
        });
    partial[first / DelassusOperator::kGrain] = worst;
  });
  return partial.empty() ? 0.0 : std::sqrt(*std::max_element(partial.begin(), partial.end()));
}

double CcpJudge::residual(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "CcpJudge: gamma needs a number a row");
  delassus_.bind(problem, executor);
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  return ccp_residual(delassus_, gamma, w_, partial_);
}

CcpFigures CcpJudge::figures(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  CcpFigures out;
  out.residual = residual(problem, gamma, executor);
  u_.resize(problem.rows());
  delassus_.row_velocities(w_, gamma, u_);
  for (std::size_t k = 0; k < u_.size(); ++k) u_[k] += problem.r[k];
  Squares squares;
  const auto judge = [&](const CcpBlock& block, std::size_t row, std::size_t unit) {
    const std::span<const double> u{u_};
    judge_unit(block, gamma.subspan(row, block.rows), u.subspan(row, block.rows), problem.r.subspan(row, block.rows),
               delassus_.traces()[unit], squares, out);
  };
  const std::size_t contacts = problem.contacts.size();
  for (std::size_t i = 0; i < contacts; ++i) judge(block_of(problem.contacts[i]), 3 * i, i);
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    judge(problem.blocks[i], first_row(problem, problem.blocks[i]), contacts + i);
  }
  const double length = squares.r > 0.0 ? std::sqrt(squares.r) : 1.0;
  out.relative_residual = std::sqrt(squares.associated) / length;
  out.coulomb_error = std::sqrt(squares.coulomb) / length;
  out.coulomb_residual = std::sqrt(squares.worst_coulomb);
  return out;
}

double ccp_residual(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  CcpJudge judge;
  return judge.residual(problem, gamma, executor);
}

}  // namespace scree
