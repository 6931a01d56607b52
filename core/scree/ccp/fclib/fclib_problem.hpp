// FclibProblem: what a file of the Frictional Contact Library holds (Acary, Bremond, Koziara, Perignon: "FCLIB: a collection
// of discrete 3D frictional contact problems", INRIA RT-0444, 2014).
//
// Glossary: u, relative velocities of the contacts [m/s]; r, their impulses [N s]; v, velocities of the degrees of freedom;
// lambda, impulses of p bilateral constraints; mu, friction. With C the product of the friction cones, C* its dual and, for
// exact Coulomb friction, u + mu ||u_t|| in the normal rows:
//
//     local    u = W r + V lambda + q,  V^T r + R lambda + s = 0,                      C* contains u _|_ r in C
//     global   M v = H r + G lambda + f,  G^T v + b = 0,  u = H^T v + w,               C* contains u _|_ r in C
//
// W m x m, V m x p, R p x p; M n x n, H n x m, G n x p. The rows of a contact are (normal, tangents), and with rolling
// friction, which newer files have, (normal, tangents, rolling).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scree/ccp/matrix.hpp"

namespace scree {

/// How a file keeps a sparse matrix: as a list, or packed by columns or rows.
enum class FclibStorage : std::uint8_t { triplets, columns, rows };

/// What its author knew of a matrix.
struct FclibMatrixInfo {
  std::string comment;
  double conditioning = 0.0;  ///< [1]
  double determinant = 0.0;   ///< of its unit to the power of its rows [1]
  int rank = 0;
};

/// A sparse matrix; entries in any order, those at the same place are summed.
struct FclibMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<MatrixEntry> entries = {};
  FclibStorage storage = FclibStorage::triplets;  ///< in the file
  std::optional<FclibMatrixInfo> info = {};
};

/// A problem reduced to its contacts.
struct FclibLocal {
  FclibMatrix W;          ///< [1/kg]
  std::vector<double> q;  ///< m [m/s]
  FclibMatrix V, R;       ///< 0 columns: no bilateral constraints
  std::vector<double> s;  ///< p [m/s]
};

/// A problem with its degrees of freedom.
struct FclibGlobal {
  FclibMatrix M;          ///< [kg]
  FclibMatrix H;          ///< [1]
  std::vector<double> f;  ///< n [N s]
  std::vector<double> w;  ///< m [m/s]
  FclibMatrix G;          ///< 0 columns: no bilateral constraints
  std::vector<double> b;  ///< p [m/s]
};

/// A guess or an answer.
struct FclibSolution {
  std::vector<double> v;       ///< n [m/s]; empty in a local problem
  std::vector<double> u;       ///< m [m/s], without the mu ||u_t|| of exact friction; may be missing in a guess
  std::vector<double> r;       ///< m [N s]
  std::vector<double> lambda;  ///< p [N s]
};

/// What a program noted beside a problem: a name with whole numbers, numbers (of its own unit) or a text.
struct FclibAttribute {
  std::string name;
  std::variant<std::vector<std::int64_t>, std::vector<double>, std::string> value;
};

/// About a problem; anything may be empty.
struct FclibInfo {
  std::string title, description, math_info;
  std::vector<FclibAttribute> attributes = {};  ///< by name
};

/// A problem with everything that its file says.
struct FclibProblem {
  std::variant<FclibLocal, FclibGlobal> form;
  int spacedim = 3;                  ///< as the file says: 2 or 3; 5 for some with rolling friction
  std::vector<double> mu;            ///< one a contact [1]
  std::vector<double> rolling = {};  ///< one a contact [1] (`mu_r`); empty without rolling friction
  FclibInfo info = {};
  std::vector<FclibSolution> guesses = {};
  std::optional<FclibSolution> solution = {};

  [[nodiscard]] bool global() const { return std::holds_alternative<FclibGlobal>(form); }
  [[nodiscard]] std::size_t contacts() const { return mu.size(); }
  /// m, rows of all contacts.
  [[nodiscard]] std::size_t contact_rows() const;
  /// p, bilateral constraints.
  [[nodiscard]] std::size_t bilateral_rows() const;
  /// n, degrees of freedom; 0 in a local problem.
  [[nodiscard]] std::size_t freedoms() const;
  /// Rows of one contact: 2, 3, or with rolling friction 3 (plane) or 5.
  [[nodiscard]] std::size_t rows_per_contact() const;
};

}  // namespace scree
