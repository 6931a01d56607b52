#include "kernel.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

Kernel::Kernel(KernelKind kind, double width)
    : kind_{kind},
      range_{kind == KernelKind::lucy ? 2.0 * width : 3.0 * width},
      squared_range_{range_ * range_},
      per_squared_{0.5 / (width * width)} {}

double Kernel::operator()(double squared_distance) const {
  if (squared_distance >= squared_range_) return 0.0;
  if (kind_ == KernelKind::gaussian) return std::exp(-squared_distance * per_squared_);
  const double q = std::sqrt(squared_distance) / range_, left = 1.0 - q;
  return (1.0 + 3.0 * q) * left * left * left;
}

Lattice::Lattice(const CellGrid& grid) : origin_{grid.box().lower}, spacing_{grid.spacing()} {
  for (std::size_t axis = 0; axis < 3; ++axis) count_[axis] = static_cast<long>(grid.count()[axis]);
}

Vec3 Lattice::centre(long x, long y, long z) const {
  const Vec3 cells{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, static_cast<double>(z) + 0.5};
  return origin_ + hadamard(cells, spacing_);
}

CellRange Lattice::around(const Vec3& place, double range) const {
  CellRange cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double along = (place[axis] - origin_[axis]) / spacing_[axis] - 0.5, reach = range / spacing_[axis];
    cells.first[k] = static_cast<long>(std::ceil(along - reach));
    cells.last[k] = static_cast<long>(std::floor(along + reach)) + 1;
  }
  return cells;
}

CellRange Lattice::within_grid(CellRange cells) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells.first[axis] = std::clamp(cells.first[axis], 0L, count_[axis]);
    cells.last[axis] = std::clamp(cells.last[axis], cells.first[axis], count_[axis]);
  }
  return cells;
}

double Lattice::normalisation(const Kernel& kernel, const Vec3& place) const {
  const CellRange cells = around(place, kernel.range());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cells.last[axis] <= 0 || cells.first[axis] >= count_[axis]) return 0.0;
  }
  double sum = 0.0;
  for (long z = cells.first[2]; z < cells.last[2]; ++z) {
    for (long y = cells.first[1]; y < cells.last[1]; ++y) {
      for (long x = cells.first[0]; x < cells.last[0]; ++x) sum += kernel(squared_norm(centre(x, y, z) - place));
    }
  }
  return sum > 0.0 ? 1.0 / sum : 0.0;
}

}  // namespace scree
