#include "scree/ccp/anderson.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree {

namespace {

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// y += factor x
void add(double factor, std::span<const double> x, std::span<double> y) {
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += factor * x[k];
}

/// A difference that depends on newer ones but for this part says nothing new.
constexpr double kDependent = 1e-6;

}  // namespace

void AndersonMixing::restart(std::size_t size) {
  for (Difference& d : differences_) {
    d.s.resize(size);
    d.f.resize(size);
    d.direction.resize(size);
  }
  last_s_.resize(size);
  last_f_.resize(size);
  count_ = 0;
  begun_ = false;
}

// Gram and Schmidt, newest first; returns how many differences are of use.
std::size_t AndersonMixing::orthogonalise() {
  for (std::size_t j = 0; j < count_; ++j) {
    Difference& d = newest(j);
    d.direction = d.f;
    for (std::size_t i = 0; i < j; ++i) {
      triangle_[i][j] = product(newest(i).direction, d.direction);
      add(-triangle_[i][j], newest(i).direction, d.direction);
    }
    const double length = std::sqrt(product(d.direction, d.direction));
    if (!(length > kDependent * std::sqrt(product(d.f, d.f)))) return j;
    triangle_[j][j] = length;
    for (double& x : d.direction) x /= length;
  }
  return count_;
}

void AndersonMixing::advance(std::span<double> s, std::span<const double> f, double damping) {
  if (begun_) {
    Difference& d = differences_[next_];
    next_ = (next_ + 1) % kDepth;
    count_ = std::min(count_ + 1, kDepth);
    for (std::size_t k = 0; k < s.size(); ++k) {
      d.s[k] = s[k] - last_s_[k];
      d.f[k] = f[k] - last_f_[k];
    }
  }
  std::copy(s.begin(), s.end(), last_s_.begin());
  std::copy(f.begin(), f.end(), last_f_.begin());
  begun_ = true;
  const std::size_t used = orthogonalise();
  std::array<double, kDepth> c{};
  for (std::size_t i = 0; i < used; ++i) c[i] = product(newest(i).direction, f);
  for (std::size_t i = used; i-- > 0;) {
    for (std::size_t j = i + 1; j < used; ++j) c[i] -= triangle_[i][j] * c[j];
    c[i] /= triangle_[i][i];
  }
  add(damping, f, s);
  for (std::size_t i = 0; i < used; ++i) {
    add(-c[i], newest(i).s, s);
    add(-c[i] * damping, newest(i).f, s);
  }
}

}  // namespace scree
