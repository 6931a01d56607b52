// Spectral projected gradient for cone complementarity problems (Birgin,
// Martinez, Raydan 2000, SIAM J. Optim. 10:1196, algorithm SPG2; steps: Barzilai,
// Borwein 1988).
//
// Glossary: x, the iterate [N s]; u = N x + r, the gradient [m/s]; D = diag(d_n,
// d_t, d_t) per contact, the metric [1/kg]; P, the projection on the cones in the
// metric; alpha, the spectral step [1]; lambda, that of the line search [1]; w =
// M^-1 D_J x, body velocities (D_J: the Jacobian); v = M^-1 D_J d.
//
//     d = P(x - alpha D^-1 u) - x,      x <- x + lambda d,      w <- w + lambda v
//     alpha <- d^T D d / d^T N d  (BB1)  or  d^T N d / (N d)^T D^-1 (N d)  (BB2)
//
// An iteration makes one product N d, and with BB1 not even all of it: d^T N d =
// v^T M v is a sum over bodies, and the next gradient comes from w. So it is one
// pass over the contacts, which finishes the step before, takes the gradient,
// makes d and adds it up for the bodies, and one over the bodies. BB2 needs N d
// at the contacts: a second, lighter pass.
#pragma once

#include <vector>

#include "line_search.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about spg.
struct SpgOptions {
  enum class Scaling { block, contact, none };  ///< d of normal and tangents; one d a contact; one d for all
  enum class Step { bb1, bb2, alternating };    ///< the spectral step; alternating: BB1, BB2, BB1...
  Scaling scaling = Scaling::block;
  Step step = Step::alternating;
  int memory = 10;          ///< iterates that the line search compares with; 1: monotone
  int check_interval = 10;  ///< iterations between two computations of the residual
};

/// Returns the iterate with the least residual seen. No allocation once the
/// workspace has its size.
class Spg final : public CcpSolver {
 public:
  explicit Spg(const SpgOptions& options) : options_{options} {}
  explicit Spg(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;

  /// Trials that the line search refused in the last solve.
  [[nodiscard]] int reductions() const { return search_.reductions(); }

 private:
  /// The metric of a contact.
  struct Metric {
    double normal = 0.0;   ///< 1 / d_n [kg]
    double tangent = 0.0;  ///< 1 / d_t [kg]
    ConeWeights weights;
  };
  /// Sums over a pass [J].
  struct Sums {
    double slope = 0.0;      ///< u^T d
    double distance = 0.0;   ///< d^T D d
    double curvature = 0.0;  ///< d^T N d
    Sums& operator+=(const Sums& o);
  };

  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void prepare_metric(const CcpProblem& problem);
  template <bool compliant>
  Sums contact_range(std::size_t first, std::size_t last);
  Sums contact_pass();
  double body_pass();
  double product_norm();
  bool iterate(int iteration);
  void finish_step();
  void refresh();
  double look(SolveSummary& summary, double tolerance);

  SpgOptions options_;
  DelassusOperator delassus_;
  spg::LineSearch search_;
  std::vector<Metric> metric_;
  std::vector<double> x_, d_, x_best_;  ///< impulses, direction [N s]
  std::vector<Twist> w_, v_, slots_;
  std::vector<Sums> sums_;
  std::vector<double> partial_;
  double alpha_ = 1.0;
  double pending_ = 0.0;  ///< lambda that x has not moved by yet [1]
  int looks_ = 0;
  bool fresh_ = true;  ///< w was made from x, not updated
};

}  // namespace scree
