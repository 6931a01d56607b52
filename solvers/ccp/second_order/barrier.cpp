#include "barrier.hpp"

#include <limits>

namespace scree::second_order {

void Barrier::add_ray(std::uint32_t row, double sign, double bound) {
  cones.push_back({{row, kNone, kNone}, sign, sign * bound});
}

void Barrier::add_cone(const CcpBlock& unit, double scale, std::span<double> gamma) {
  struct Part {
    std::uint32_t first = 0, count = 0;
    double coefficient = 0.0;
  };
  const Part parts[] = {
      {1, unit.rows == 2 ? 1U : 2U, unit.friction}, {3, 1, unit.spinning}, {unit.rows - 2U, 2, unit.rolling}};
  const bool has[] = {unit.rows >= 2, unit.rows == 6, unit.rows >= 5};
  const std::uint32_t normal = unit.first_row;
  bool bounded = false;
  gamma[normal] = scale;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!has[k]) continue;
    const std::uint32_t row = normal + parts[k].first, second = parts[k].count == 2 ? row + 1 : kNone;
    gamma[row] = 0.0;
    if (second != kNone) gamma[second] = 0.0;
    if (parts[k].coefficient > 0.0) {
      cones.push_back({{normal, row, second}, parts[k].coefficient, 0.0});
      bounded = true;
    } else {
      fixed[row] = 1;
      if (second != kNone) fixed[second] = 1;
    }
  }
  if (!bounded) add_ray(normal, 1.0, 0.0);
}

void Barrier::add_bounds(const CcpBlock& unit, double scale, std::span<double> gamma) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double lower = unit.kind == CcpKind::box ? unit.lower : unit.kind == CcpKind::nonnegative ? 0.0 : -kInfinity;
  const double upper = unit.kind == CcpKind::box ? unit.upper : kInfinity;
  const double inside = lower > -kInfinity && upper < kInfinity ? 0.5 * lower + 0.5 * upper
                        : lower > -kInfinity                    ? lower + scale
                        : upper < kInfinity                     ? upper - scale
                                                                : 0.0;
  for (std::uint32_t row = unit.first_row; row < unit.first_row + unit.rows; ++row) {
    gamma[row] = inside;
    if (!(lower < inside && inside < upper)) {
      fixed[row] = 1;
      continue;
    }
    if (lower > -kInfinity) add_ray(row, 1.0, lower);
    if (upper < kInfinity) add_ray(row, -1.0, upper);
  }
}

void Barrier::build(std::span<const CcpBlock> units, std::span<const double> scale, std::span<double> gamma) {
  cones.clear();
  fixed.assign(gamma.size(), 0);
  first.assign(1, 0);
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (scale[i] > 0.0 && units[i].kind == CcpKind::cone) {
      add_cone(units[i], scale[i], gamma);
    } else if (scale[i] > 0.0) {
      add_bounds(units[i], scale[i], gamma);
    } else {
      for (std::uint32_t row = units[i].first_row; row < units[i].first_row + units[i].rows; ++row) fixed[row] = 1;
    }
    first.push_back(static_cast<std::uint32_t>(cones.size()));
  }
}

}  // namespace scree::second_order
