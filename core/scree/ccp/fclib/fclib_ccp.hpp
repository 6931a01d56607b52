// FclibCcp: a problem of FCLIB in the form that solvers take, and the way back.
//
// A local problem is the explicit matrix [W V; V^T R] with r = [q; s]. A global one is reduced to its contacts and constraints:
// with J = [H G], N = J^T M^-1 J and r = [w; b] + J^T M^-1 f, by a sparse factorisation of M. Contacts are cones of 2, 3 or 5
// rows; bilateral constraints are free blocks of one row, behind them. A plane contact with rolling friction gets two rows of
// zeros, since cones of rolling friction have 5 rows.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/fclib/fclib_problem.hpp"

namespace scree {

/// A problem of FCLIB as a contact problem.
class FclibCcp {
 public:
  /// `problem` as read_fclib_file() gives it; `file` for messages. @throws Error (io) when the symmetric part of M is not
  /// positive definite or that of [W V; V^T R] not positive semidefinite, and when M or W is further from symmetric than
  /// rounding and gyroscopic terms explain.
  FclibCcp(FclibProblem problem, const std::string& file);
  ~FclibCcp();
  FclibCcp(FclibCcp&&) noexcept;
  FclibCcp& operator=(FclibCcp&&) noexcept;

  [[nodiscard]] const FclibProblem& source() const;
  /// The contact problem; its guess is the first of the file, or zero.
  [[nodiscard]] const CcpRecord& record() const;
  /// Impulses of all rows of the record [N s] from those of an answer in FCLIB's form.
  [[nodiscard]] std::vector<double> impulses(const FclibSolution& solution) const;
  /// The answer in FCLIB's form, velocities and all, from impulses of all rows of the record [N s].
  [[nodiscard]] FclibSolution solution(std::span<const double> gamma) const;

 private:
  struct Reduction;
  std::unique_ptr<Reduction> reduction_;
};

}  // namespace scree
