#include "sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

void Sizes::assign(std::span<const Sized> particles) {
  number_ = static_cast<double>(particles.size());
  mass_ = cubes_ = squares_ = 0.0;
  workspace_.clear();
  for (const Sized& particle : particles) {
    const double d = particle.diameter;
    mass_ += particle.mass;
    cubes_ += d * d * d;
    squares_ += d * d;
    workspace_.push_back({d, 1.0});
  }
  by_number_.assign(workspace_);
  for (std::size_t i = 0; i < particles.size(); ++i) workspace_[i].weight = particles[i].mass;
  by_mass_.assign(workspace_);
}

SizeNumbers Sizes::numbers() const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto mass = [&](double p) { return by_mass_.quantile(p); };
  const auto number = [&](double p) { return by_number_.quantile(p); };
  return {number_,     mass_,       mass(0.1),
          mass(0.5),   mass(0.9),   number(0.1),
          number(0.5), number(0.9), number_ > 0.0 ? cubes_ / squares_ : kNone,
          number(0.0), number(1.0)};
}

std::vector<double> size_classes(double smallest, double largest, std::size_t count, bool logarithmic) {
  std::vector<double> edges(count + 1);
  for (std::size_t e = 0; e <= count; ++e) {
    const double part = static_cast<double>(e) / static_cast<double>(count);
    edges[e] = logarithmic ? smallest * std::pow(largest / smallest, part) : smallest + part * (largest - smallest);
  }
  edges.back() = largest;
  return edges;
}

void fill_histogram(std::span<const Sized> particles, std::span<const double> edges, SizeHistogram& out) {
  out.in_class.assign(edges.size() - 1, {});
  out.below = out.above = {};
  for (const Sized& particle : particles) {
    SizeHistogram::Amount* into = &out.above;
    if (particle.diameter < edges.front()) into = &out.below;
    if (particle.diameter >= edges.front() && particle.diameter <= edges.back()) {
      const auto after = std::upper_bound(edges.begin(), edges.end(), particle.diameter) - edges.begin();
      into = &out.in_class[std::min(static_cast<std::size_t>(after), out.in_class.size()) - 1];
    }
    into->number += 1.0;
    into->mass += particle.mass;
  }
}

}  // namespace scree
