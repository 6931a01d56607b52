#include "scree/geometry/sphere_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scree/geometry/sphere_union.hpp"

namespace scree {
namespace {

constexpr std::size_t kLanes = 8;           // of independent sums, so that the compiler may use vector registers
constexpr int kSurfaceSamples = 600;        // besides corners and edges
constexpr double kInteriorSamples = 700.0;  // a grid of about so many points
constexpr double kCandidates = 600.0;       // a grid of about so many points
constexpr double kInteriorWeight = 0.5;     // relative to samples of the surface
constexpr double kToleratedDepth = 0.03;    // a crevice as deep as this is no worse than other gaps
constexpr double kMargin = 0.04;            // by which balls must cover what lies deeper, so that no hole slips through
constexpr double kLeastRadius = 1e-3;       // of the size
constexpr double kCoarse = 0.03;            // slices for volumes on the way; good to 1e-4

/// Points of a grid of about `count` points inside the solid, cell centres of its box.
std::vector<Vec3> grid_inside(const Solid& solid, double count) {
  const Aabb box = bounds_of(solid.surface.vertices);
  const Vec3 extent = box.upper - box.lower;
  const double spacing = std::cbrt(solid.volume / count);
  std::array<int, 3> n{};
  for (int a = 0; a < 3; ++a)
    n[static_cast<std::size_t>(a)] = std::max(1, static_cast<int>(std::lround(extent[a] / spacing)));
  std::vector<Vec3> points;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Vec3 share{(i + 0.5) / n[0], (j + 0.5) / n[1], (k + 0.5) / n[2]};
        const Vec3 p = box.lower + hadamard(extent, share);
        if (solid.signed_distance(p) < 0.0) points.push_back(p);
      }
    }
  }
  return points;
}

double loss(double gap, double depth_cubed) { return gap * (gap * gap * gap + depth_cubed); }

double sum_of(const std::array<double, kLanes>& sums) {
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace

SphereFit::SphereFit(const Solid& solid, int most_spheres)
    : solid_{solid}, most_{static_cast<std::size_t>(most_spheres)} {
  make_samples(solid);
}

void SphereFit::make_samples(const Solid& solid) {
  const auto add = [&](const Vec3& p, double weight, double depth) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
    weight_.push_back(weight);
    depth_cubed_.push_back(depth * depth * depth);
    margin_.push_back(depth > kToleratedDepth ? kMargin : 0.0);
  };
  const std::vector<SurfaceSample> surface = sample_surface(solid, kSurfaceSamples);
  for (const SurfaceSample& s : surface) add(s.point, 1.0, 0.0);
  for (const Vec3& p : grid_inside(solid, kInteriorSamples)) add(p, kInteriorWeight, -solid.signed_distance(p));
  while (x_.size() % kLanes != 0) add({}, 0.0, 0.0);
  make_candidates(surface);
}

void SphereFit::make_candidates(const std::vector<SurfaceSample>& surface) {
  for (const Vec3& p : grid_inside(solid_, kCandidates)) candidates_.push_back({p, -solid_.signed_distance(p)});
  if (candidates_.size() < 50) add_candidates_below(surface);  // too thin and slanting for the grid
  // Below corners and edges, at a few depths: the small balls that a grid would miss.
  for (std::size_t i = static_cast<std::size_t>(kSurfaceSamples); i < surface.size(); i += 2) {
    for (const double way : {0.04, 0.1}) {
      const Vec3 p = surface[i].point - way * surface[i].normal;
      if (const double depth = -solid_.signed_distance(p); depth > 0.0) candidates_.push_back({p, depth});
    }
  }
}

void SphereFit::add_candidates_below(const std::vector<SurfaceSample>& surface) {
  for (const SurfaceSample& s : surface) {
    for (double way = 0.25; way > 1e-6; way *= 0.5) {
      const Vec3 p = s.point - way * s.normal;
      if (const double depth = -solid_.signed_distance(p); depth > 0.0) {
        candidates_.push_back({p, depth});
        break;
      }
    }
  }
}

double SphereFit::radius(const Ball& ball) const { return std::max(ball.depth + delta_, kLeastRadius); }

double SphereFit::loss_with(const Ball& ball, const std::vector<double>& others) const {
  const double r = radius(ball);
  std::array<double, kLanes> sums{};
  for (std::size_t j = 0; j < x_.size(); j += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double dx = x_[j + l] - ball.centre.x, dy = y_[j + l] - ball.centre.y, dz = z_[j + l] - ball.centre.z;
      const double gap = std::sqrt(dx * dx + dy * dy + dz * dz) - r;
      const double least = gap < others[j + l] ? gap : others[j + l];
      const double wanted = least + margin_[j + l];
      sums[l] += weight_[j + l] * loss(wanted > 0.0 ? wanted : 0.0, depth_cubed_[j + l]);
    }
  }
  return sum_of(sums);
}

double SphereFit::loss_of(const std::vector<double>& gaps) const {
  std::array<double, kLanes> sums{};
  for (std::size_t j = 0; j < x_.size(); j += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double wanted = gaps[j + l] + margin_[j + l];
      sums[l] += weight_[j + l] * loss(wanted > 0.0 ? wanted : 0.0, depth_cubed_[j + l]);
    }
  }
  return sum_of(sums);
}

void SphereFit::gaps_to(const Ball& ball, std::vector<double>& gaps) const {
  const double r = radius(ball);
  gaps.resize(x_.size());
  for (std::size_t j = 0; j < x_.size(); ++j) {
    const double dx = x_[j] - ball.centre.x, dy = y_[j] - ball.centre.y, dz = z_[j] - ball.centre.z;
    gaps[j] = std::sqrt(dx * dx + dy * dy + dz * dz) - r;
  }
}

void SphereFit::gaps_without(std::size_t skipped, std::vector<double>& gaps) const {
  gaps.assign(x_.size(), 1.0);  // nothing is further than the size
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    if (i == skipped) continue;
    for (std::size_t j = 0; j < gaps.size(); ++j) gaps[j] = gaps_[i][j] < gaps[j] ? gaps_[i][j] : gaps[j];
  }
}

SphereFit::Ball SphereFit::best_candidate(const std::vector<double>& gaps, std::vector<double>& bounds) const {
  const double before = loss_of(gaps);
  std::vector<bool> is_fresh(candidates_.size(), false);
  for (;;) {
    const auto best = static_cast<std::size_t>(std::ranges::max_element(bounds) - bounds.begin());
    if (is_fresh[best]) return candidates_[best];
    bounds[best] = before - loss_with(candidates_[best], gaps);
    is_fresh[best] = true;
  }
}

void SphereFit::choose_greedily(double delta) {
  delta_ = delta;
  balls_.clear();
  gaps_.clear();
  std::vector<double> gaps(x_.size(), 1.0), own;
  std::vector<double> bounds(candidates_.size(), std::numeric_limits<double>::infinity());
  while (balls_.size() < most_) {
    balls_.push_back(best_candidate(gaps, bounds));
    gaps_to(balls_.back(), own);
    for (std::size_t j = 0; j < gaps.size(); ++j) gaps[j] = std::min(gaps[j], own[j]);
    gaps_.push_back(own);
  }
}

void SphereFit::move_centres(int sweeps, double first_step) {
  double step = first_step;
  std::vector<double> others;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool moved = false;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      gaps_without(i, others);
      Ball best = balls_[i];
      double least = loss_with(best, others);
      const double start = least;
      for (int direction = 0; direction < 6; ++direction) {
        Ball trial = best;
        trial.centre[direction / 2] += direction % 2 == 0 ? step : -step;
        trial.depth = -solid_.signed_distance(trial.centre);
        if (trial.depth <= 0.0) continue;
        if (const double value = loss_with(trial, others); value < least * (1.0 - 1e-9)) {
          least = value;
          best = trial;
        }
      }
      if (least < start) {
        balls_[i] = best;
        gaps_to(best, gaps_[i]);
        moved = true;
      }
    }
    if (!moved || sweep % 2 == 1) step *= 0.6;
  }
}

void SphereFit::relocate(int most) {
  std::vector<double> all, others;
  for (int jump = 0; jump < most; ++jump) {
    gaps_without(balls_.size(), all);
    const double before = loss_of(all);
    std::size_t idle = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      gaps_without(i, others);
      if (const double value = loss_of(others); value < least) {
        least = value;
        idle = i;
      }
    }
    gaps_without(idle, others);
    std::vector<double> bounds(candidates_.size(), std::numeric_limits<double>::infinity());
    const Ball place = best_candidate(others, bounds);
    if (loss_with(place, others) >= before * (1.0 - 1e-6)) return;
    balls_[idle] = place;
    gaps_to(place, gaps_[idle]);
  }
}

double SphereFit::volume_at(double delta) const {
  std::vector<Sphere> spheres;
  double mean = 0.0;
  for (const Ball& b : balls_) {
    spheres.push_back({b.centre, std::max(b.depth + delta, kLeastRadius)});
    mean += spheres.back().radius / static_cast<double>(balls_.size());
  }
  return sphere_union_volume(spheres, {.least_interval = std::min(0.05, kCoarse * mean)});
}

void SphereFit::match_volume(double accuracy) {
  // Secant steps from the present delta; the first slope is the surface of the balls that one sees, about twice pi / 4.
  double a = delta_, fa = volume_at(a) / solid_.volume - 1.0;
  double b = a - fa * solid_.volume / 2.0;
  for (int step = 0; step < 8 && std::abs(fa) > accuracy; ++step) {
    b = std::clamp(b, a - 0.1, a + 0.1);
    const double fb = volume_at(b) / solid_.volume - 1.0;
    const double next = std::abs(fb - fa) > 1e-15 ? b - fb * (b - a) / (fb - fa) : b;
    a = b;
    fa = fb;
    b = next;
  }
  delta_ = a;
  for (std::size_t i = 0; i < balls_.size(); ++i) gaps_to(balls_[i], gaps_[i]);
}

double SphereFit::worst() const {
  std::vector<double> gaps;
  gaps_without(balls_.size(), gaps);
  double worst = std::abs(delta_);
  for (std::size_t j = 0; j < gaps.size(); ++j) worst = std::max(worst, weight_[j] > 0.0 ? gaps[j] : 0.0);
  return worst;
}

std::vector<Sphere> SphereFit::spheres() const {
  std::vector<Sphere> result;
  for (const Ball& b : balls_) result.push_back({b.centre, radius(b)});
  return result;
}

}  // namespace scree
