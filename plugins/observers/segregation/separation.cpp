#include "separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scree {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Pearson's coefficient between the place and a property of the particles.
double correlation(std::span<const OnAxis> particles, double OnAxis::*property) {
  const auto n = static_cast<double>(particles.size());
  double mx = 0.0, my = 0.0;
  for (const OnAxis& p : particles) {
    mx += p.place / n;
    my += p.*property / n;
  }
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const OnAxis& p : particles) {
    const double x = p.place - mx, y = p.*property - my;
    xx += x * x;
    yy += y * y;
    xy += x * y;
  }
  constexpr double kAlike = 1e-24;  // squared relative spread of particles that differ by rounding only
  return xx > 0.0 && yy > kAlike * n * my * my ? xy / std::sqrt(xx * yy) : kNone;
}

}  // namespace

AxisProfile::AxisProfile(double from, double to, std::size_t bins, std::size_t materials)
    : from_{from}, to_{to}, materials_{materials}, bins_(bins), material_mass_(bins * materials) {}

double AxisProfile::edge(std::size_t index) const {
  return from_ + (to_ - from_) * static_cast<double>(index) / static_cast<double>(bins_.size());
}

void AxisProfile::fill(std::span<const OnAxis> particles) {
  std::fill(bins_.begin(), bins_.end(), ProfileBin{});
  std::fill(material_mass_.begin(), material_mass_.end(), 0.0);
  for (const OnAxis& p : particles) {
    if (!(p.place >= from_ && p.place <= to_)) continue;
    const double along = (p.place - from_) / (to_ - from_) * static_cast<double>(bins_.size());
    const std::size_t b = std::min(static_cast<std::size_t>(along), bins_.size() - 1);
    ProfileBin& bin = bins_[b];
    bin.number += 1.0;
    bin.mass += p.mass;
    bin.volume += std::numbers::pi / 6.0 * p.diameter * p.diameter * p.diameter;
    bin.diameters += p.diameter;
    if (p.of != BodyClass::neither) bin.classed_mass += p.mass;
    if (p.of == BodyClass::first) bin.first_mass += p.mass;
    material_mass_[b * materials_ + p.material] += p.mass;
  }
}

double AxisProfile::intensity() const {
  double all = 0.0, first = 0.0;
  for (const ProfileBin& bin : bins_) {
    all += bin.classed_mass;
    first += bin.first_mass;
  }
  const double p = first / all;
  if (!(p > 0.0 && p < 1.0)) return kNone;
  double variance = 0.0;
  for (const ProfileBin& bin : bins_) {
    if (bin.classed_mass <= 0.0) continue;
    const double off = bin.first_mass / bin.classed_mass - p;
    variance += bin.classed_mass / all * off * off;
  }
  return variance / (p * (1.0 - p));
}

double AxisProfile::parted(double mass, bool ahead) const {
  double left = mass, first = 0.0, second = 0.0, all = 0.0;
  const auto take = [&](const OnAxis& p) {
    const double part = std::min(left, p.mass);  // the particle at the border is divided
    left -= part;
    first += part * p.place;
    second += (p.mass - part) * p.place;
    all += p.mass;
  };
  if (ahead) {
    std::for_each(sorted_.rbegin(), sorted_.rend(), take);
  } else {
    std::for_each(sorted_.begin(), sorted_.end(), take);
  }
  return std::abs(first / mass - second / (all - mass));
}

Separation AxisProfile::look(std::span<const OnAxis> particles) {
  fill(particles);
  sorted_.assign(particles.begin(), particles.end());
  std::erase_if(sorted_, [](const OnAxis& p) { return p.of == BodyClass::neither; });
  std::sort(sorted_.begin(), sorted_.end(), [](const OnAxis& a, const OnAxis& b) { return a.place < b.place; });
  double mass[2] = {}, moment[2] = {};
  for (const OnAxis& p : sorted_) {
    mass[static_cast<int>(p.of)] += p.mass;
    moment[static_cast<int>(p.of)] += p.mass * p.place;
  }
  Separation s;
  s.first_centre = mass[0] > 0.0 ? moment[0] / mass[0] : kNone;
  s.second_centre = mass[1] > 0.0 ? moment[1] / mass[1] : kNone;
  s.difference = s.first_centre - s.second_centre;
  const bool both = mass[0] > 0.0 && mass[1] > 0.0;
  const double most = both ? parted(mass[0], s.difference >= 0.0) : 0.0;
  s.index = most > 0.0 ? s.difference / most : kNone;
  s.intensity = intensity();
  s.size_correlation = correlation(particles, &OnAxis::diameter);
  s.density_correlation = correlation(particles, &OnAxis::density);
  return s;
}

}  // namespace scree
