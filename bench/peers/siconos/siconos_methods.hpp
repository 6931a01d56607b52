// The solvers of Siconos that the comparison knows, each with the model of friction that it solves.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "siconos_problem.hpp"

namespace scree {

struct SiconosMethod {
  enum class Form { local, second_order_cone, convex_qp, global };
  std::string_view name;
  Form form = Form::local;
  int solver = 0;      ///< Siconos' number of it
  bool exact = false;  ///< Coulomb friction; otherwise the associated problem
  std::string_view about;
};

[[nodiscard]] std::span<const SiconosMethod> siconos_methods();

/// @throws scree::Error for another name, with those that are valid.
[[nodiscard]] const SiconosMethod& siconos_method(std::string_view name);

/// What a solve left.
struct SiconosAnswer {
  std::vector<double> gamma;  ///< [N s], projected into the cones
  int iterations = 0;
  double seconds = 0.0;  ///< of the solver alone
};

/// One problem, in the form that the method takes. @throws scree::Error when it has none in that form.
class SiconosSolver {
 public:
  SiconosSolver(const SiconosMethod& method, const CcpProblem& problem);

  /// From zero, to Siconos' own error measure `tolerance`.
  [[nodiscard]] SiconosAnswer solve(double tolerance, int max_iterations);

 private:
  const SiconosMethod& method_;
  const CcpProblem& problem_;
  std::optional<LocalForm> local_;
  std::optional<GlobalForm> global_;
};

}  // namespace scree
