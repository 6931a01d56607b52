// Alternating direction method of multipliers for cone complementarity problems (Tasora, Mangoni, Benatti, Garziera 2021,
// "Solving variational inequalities and cone complementarity problems in nonsmooth dynamics using the alternating direction
// method of multipliers", Int. J. Numer. Methods Eng. 122:4093; residual balancing and over-relaxation: Boyd et al. 2011).
//
// Glossary: x, impulses that obey the dynamics [N s]; z, impulses in K [N s]; y, velocities that pull them together [m/s],
// minus those of the contacts in the end; S = rho times trace(N_ii) / rows of each unit [1/kg], so that cones stay cones;
// alpha, over-relaxation [1].
//
//     x <- (N + S)^-1 (S z - y - r),   x' = alpha x + (1 - alpha) z,   z <- P(x' + S^-1 y),   y <- y + S (x' - z)
//
// N + S is factorised once, in the unknowns of the bodies: M + D S^-1 D^T; and again only when rho changes.
#pragma once

#include <vector>

#include "scree/ccp/direct/best_answer.hpp"
#include "scree/ccp/direct/direct_system.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about admm.
struct AdmmOptions {
  double penalty = 0.1;          ///< rho to begin with [1]
  double relaxation = 1.6;       ///< alpha [1], in (0, 2)
  int balance_interval = 20;     ///< iterations between two looks at the balance of residuals
  int most_factorisations = 30;  ///< in one solve
  int check_interval = 5;        ///< iterations between two computations of the residual
};

/// Two triangular solves an iteration. The answer is the best z seen.
class Admm final : public CcpSolver {
 public:
  explicit Admm(const AdmmOptions& options) : options_{options} {}
  explicit Admm(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

  /// Factorisations in the last solve.
  [[nodiscard]] int factorisations() const { return factorisations_; }

 private:
  /// How far x and z are apart, and how far z still moves, as velocities: the largest of any unit [m/s].
  struct Residuals {
    double primal = 0.0, dual = 0.0;
  };

  void prepare(const CcpProblem& problem, std::span<const double> gamma);
  bool factor(double rho);
  void solve_dynamics();
  Residuals iterate();
  bool balance(const Residuals& residuals);

  AdmmOptions options_;
  direct::DirectSystem system_;
  direct::BestAnswer best_;
  const CcpProblem* problem_ = nullptr;
  std::vector<double> weight_;             ///< S of each unit for rho = 1 [1/kg]; zero where nothing moves
  std::vector<double> x_, z_;              ///< [N s]
  std::vector<double> y_, rhs_, product_;  ///< [m/s]
  std::vector<double> c_;                  ///< roots of (S + E)^-1, unit by unit
  double rho_ = 1.0;
  int factorisations_ = 0;
};

}  // namespace scree
