// Whether sparse matrices of a file are positive (semi)definite. For the sources of this folder; not installed.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

namespace scree {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// (A + A^T)/2.
[[nodiscard]] SparseMatrix symmetric_part(const SparseMatrix& a);

/// max |a_kl - a_lk| over max |a_kl| [1]; 0 for a matrix of zeros.
[[nodiscard]] double asymmetry(const SparseMatrix& a);

/// What keeps a matrix from being positive semidefinite.
struct Indefinite {
  double eigenvalue = 0.0;  ///< the least eigenvalue is this or less [as A]
  double diagonal = 0.0;    ///< the largest number of the diagonal [as A]
};

/// Eigenvalues below zero by this share of the largest diagonal [1] are rounding.
inline constexpr double kSemidefinite = 1e-9;

/// What shows that the symmetric `a` has an eigenvalue below -kSemidefinite times its largest diagonal; nothing when it has
/// none. Certain up to 100 000 rows as long as the factor of L D L^T fills no more than 30 million numbers and takes no more than
/// 5e9 products, and for up to 7700 rows however full. Beyond, 60 steps of Lanczos look for one, which find those that are not
/// small beside the largest eigenvalue.
[[nodiscard]] std::optional<Indefinite> find_indefinite(const SparseMatrix& a);

/// A pivot that a positive definite matrix does not have.
struct BadPivot {
  Eigen::Index row = 0;
  double pivot = 0.0;  ///< what L D L^T leaves of the diagonal there [as A]
};

/// The first pivot of L D L^T that is not above the rounding of its diagonal; nothing for a positive definite `a`.
[[nodiscard]] std::optional<BadPivot> find_bad_pivot(const SparseMatrix& a);

}  // namespace scree
