#include "lacey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

Lacey::Lacey(std::size_t cells, std::uint64_t least, bool by_mass) : least_{least}, by_mass_{by_mass}, cells_(cells) {}

LaceyIndex Lacey::index(std::span<const Particle> particles) {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  for (const Particle& particle : particles) {
    if (particle.cell < 0 || particle.of == BodyClass::neither) continue;
    Cell& cell = cells_[static_cast<std::size_t>(particle.cell)];
    ++cell.number;
    cell.amount += amount(particle);
    if (particle.of == BodyClass::first) cell.first += amount(particle);
  }

  LaceyIndex result;
  double all = 0.0, first = 0.0;
  for (const Cell& cell : cells_) {
    if (cell.number < least_) continue;
    ++result.cells;
    result.particles += cell.number;
    all += cell.amount;
    first += cell.first;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  result.share = all > 0.0 ? first / all : kNone;
  const double p = result.share, n = static_cast<double>(result.particles), m = static_cast<double>(result.cells);
  for (const Cell& cell : cells_) {
    if (cell.number < least_) continue;
    const double off = cell.first / cell.amount - p;
    result.variance += cell.amount / all * off * off;
  }
  double spread = 0.0;  // S
  for (const Particle& particle : particles) {
    if (particle.cell < 0 || particle.of == BodyClass::neither) continue;
    if (cells_[static_cast<std::size_t>(particle.cell)].number < least_) continue;
    const double off = (particle.of == BodyClass::first ? 1.0 : 0.0) - p, relative = amount(particle) * n / all;
    spread += relative * relative * off * off / n;
  }
  result.variance_segregated = p * (1.0 - p);
  result.variance_random = spread * (m - 1.0) / (n - 1.0);
  const double range = result.variance_segregated - result.variance_random;
  const bool defined = result.cells > 1 && range > 0.0;
  result.value = defined ? (result.variance_segregated - result.variance) / range : kNone;
  result.width = defined ? result.variance_random * std::sqrt(2.0 / (m - 1.0)) / range : kNone;
  return result;
}

}  // namespace scree
