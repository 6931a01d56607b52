// The cones of a contact problem as second-order cones, s = G gamma - b.
//
// A cone of five or six rows is an intersection: each kind of friction gives one of its own, and all share the normal
// impulse. A bound is a ray. Rows whose impulse is fixed (no friction, a box without width) stay out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "second_order_cone.hpp"

namespace scree::second_order {

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// s = (factor gamma_k0 - bound, gamma_k1, gamma_k2).
struct Cone {
  std::array<std::uint32_t, 3> row{kNone, kNone, kNone};  ///< k; kNone: zero
  double factor = 1.0, bound = 0.0;

  [[nodiscard]] Vec3 of(std::span<const double> gamma) const {
    return {factor * gamma[row[0]] - bound, row[1] == kNone ? 0.0 : gamma[row[1]],
            row[2] == kNone ? 0.0 : gamma[row[2]]};
  }
  /// The same without the bound.
  [[nodiscard]] Vec3 direction(std::span<const double> d) const {
    const Vec3 s = of(d);
    return {s.x + bound, s.y, s.z};
  }
  /// out += G^T z.
  void add_transposed(const Vec3& z, std::span<double> out) const {
    out[row[0]] += factor * z.x;
    if (row[1] != kNone) out[row[1]] += z.y;
    if (row[2] != kNone) out[row[2]] += z.z;
  }
};

/// All cones of a problem, unit by unit.
struct Barrier {
  std::vector<Cone> cones;
  std::vector<std::uint32_t> first;  ///< cone of each unit; units + 1
  std::vector<char> fixed;           ///< rows whose impulse stays as it is

  /// `units` as DirectSystem has them; `gamma` receives a point inside, of the size `scale` [N s] of each unit.
  void build(std::span<const CcpBlock> units, std::span<const double> scale, std::span<double> gamma);

 private:
  void add_cone(const CcpBlock& unit, double scale, std::span<double> gamma);
  void add_bounds(const CcpBlock& unit, double scale, std::span<double> gamma);
  void add_ray(std::uint32_t row, double sign, double bound);
};

}  // namespace scree::second_order
