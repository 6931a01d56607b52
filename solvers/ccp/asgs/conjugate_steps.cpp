#include "conjugate_steps.hpp"

#include <algorithm>

#include "scree/math/mat3.hpp"

namespace scree {
namespace {

/// Directions closer to parallel than this share of their lengths' square span no plane.
constexpr double kParallel = 1e-12;
/// Of the bodies' energy: differences of velocities with less are rounding, and the impulses between them may be anything.
constexpr double kNoise = 1e-30;
/// Of the terms that make up a slope of the objective: slopes below are rounding, and so is the place of the minimum.
constexpr double kFlat = 1e-14;
/// Steps of so many pairs of sweeps must deliver this share of the gain that they promise, the test of trust regions.
constexpr double kFar = 30.0, kShare = 0.1;
/// A step that is so many times a pair of sweeps goes along impulses that change no velocity: the objective falls without end there, until
/// a cone says stop. Impulses of that size would leave nothing but rounding of all others.
constexpr double kFarthest = 1e8;

/// A body's share in products of the masses' norm.
class Weight {
 public:
  Weight(const sweep::Body& body, const Mat3* inertia) : inertia_{inertia} {
    if (body.linear[3] > 0.0) mass_ = 1.0 / body.linear[3];
    if (inertia == nullptr && body.angular[3] > 0.0) moment_ = 1.0 / body.angular[3];
  }
  [[nodiscard]] double operator()(const sweep::Body& p, const sweep::Body& q) const {
    const Vec3 angular{q.angular[0], q.angular[1], q.angular[2]};
    const Vec3 turned = inertia_ != nullptr ? *inertia_ * angular : moment_ * angular;
    return mass_ * (p.linear[0] * q.linear[0] + p.linear[1] * q.linear[1] + p.linear[2] * q.linear[2]) +
           dot(Vec3{p.angular[0], p.angular[1], p.angular[2]}, turned);
  }

 private:
  const Mat3* inertia_;
  double mass_ = 0.0, moment_ = 0.0;
};

sweep::Body difference(const sweep::Body& p, const sweep::Body& q) {
  return {p.linear - q.linear, p.angular - q.angular};
}

}  // namespace

bool PlaneStep::choose(const Products& products, double linear_z, double linear_y, double linear_old) {
  const auto [dd, dp, pp, yd, yp, zz] = products;
  const double along_d = yd + linear_z - linear_y, along_p = yp + linear_y - linear_old;
  const double determinant = dd * pp - dp * dp, noise = kNoise * zz;
  if (dd <= noise || std::abs(along_d) <= kFlat * (std::abs(linear_z) + std::abs(linear_y))) return false;
  if (pp > noise && determinant > kParallel * dd * pp) {
    a = (along_p * dp - along_d * pp) / determinant;
    b = (along_d * dp - along_p * dd) / determinant;
  } else {
    a = -along_d / dd;
    b = 0.0;
  }
  gain = -0.5 * (a * along_d + b * along_p) - (0.5 * dd + along_d);
  return a >= 1.0 && a <= kFarthest && std::abs(b) <= kFarthest;
}

bool PlaneStep::far() const { return std::max(a, std::abs(b)) > kFar; }

bool PlaneStep::delivers(double fallen, double rounding) const { return !far() || fallen + rounding >= kShare * gain; }

void ConjugateSteps::start(std::span<const sweep::Body> bodies, double linear) {
  y_.assign(bodies.begin(), bodies.end());
  old_ = y_;
  partial_.assign(Executor::chunk_count(bodies.size(), DelassusOperator::kGrain), Products{});
  linear_z_ = linear_y_ = linear_old_ = linear;
  plain();
}

double ConjugateSteps::measure(std::span<const sweep::Body> bodies, std::span<const Mat3> inertia,
                               const DelassusOperator& delassus) {
  const std::size_t n = delassus.problem().bodies();  // those that follow stand for none
  delassus.for_chunks(n, [&](std::size_t first, std::size_t last) {
    Products sum{};
    for (std::size_t k = first; k < last; ++k) {
      const Weight product{bodies[k], inertia.empty() ? nullptr : &inertia[k]};
      const sweep::Body d = difference(bodies[k], y_[k]), p = difference(y_[k], old_[k]);
      sum[0] += product(d, d);
      sum[1] += product(d, p);
      sum[2] += product(p, p);
      sum[3] += product(y_[k], d);
      sum[4] += product(y_[k], p);
      sum[5] += product(bodies[k], bodies[k]);
    }
    partial_[first / DelassusOperator::kGrain] = sum;
  });
  products_ = {};
  for (const Products& part : partial_) {
    for (std::size_t i = 0; i < part.size(); ++i) products_[i] += part[i];
  }
  return 0.5 * products_[5];
}

bool ConjugateSteps::choose(double linear) {
  linear_z_ = linear;
  return step_.choose(products_, linear_z_, linear_y_, linear_old_);
}

void ConjugateSteps::go(std::span<sweep::Body> bodies, const DelassusOperator& delassus) {
  delassus.for_chunks(bodies.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      // Lanes 3 are constants of the body: their differences are zero.
      const sweep::Body y = y_[k], d = difference(bodies[k], y), p = difference(y, old_[k]);
      bodies[k] = {y.linear + a() * d.linear + b() * p.linear, y.angular + a() * d.angular + b() * p.angular};
      old_[k] = y;
      y_[k] = bodies[k];
    }
  });
  const double next = linear_y_ + a() * (linear_z_ - linear_y_) + b() * (linear_y_ - linear_old_);
  linear_old_ = linear_y_;
  linear_y_ = next;
}

void ConjugateSteps::correct(std::size_t k, const Lanes& linear, const Lanes& angular) {
  for (std::vector<sweep::Body>* bodies : {&y_, &old_}) {
    (*bodies)[k].linear += linear;
    (*bodies)[k].angular += angular;
  }
}

}  // namespace scree
