// RandomNumbers: poses, directions and sizes for property tests; a fixed seed, so that a failure repeats.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "scree/math/pose.hpp"

namespace scree::test {

/// Draws for one test.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_{seed} {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>{low, high}(engine_); }
  /// Uniform in the logarithm.
  double decades(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>{0, count - 1}(engine_); }
  Vec3 in_cube(double half_edge) {
    const double x = uniform(-half_edge, half_edge), y = uniform(-half_edge, half_edge);
    return {x, y, uniform(-half_edge, half_edge)};
  }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(engine_), y = normal(engine_);
    return normalized(Vec3{x, y, normal(engine_)});
  }
  Quat rotation() {
    std::normal_distribution<double> normal;
    const double w = normal(engine_), x = normal(engine_), y = normal(engine_);
    return normalized(Quat{w, x, y, normal(engine_)});
  }
  /// A random orientation at a place within the cube.
  Pose pose(double half_edge) {
    const Vec3 at = in_cube(half_edge);
    return {at, rotation()};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace scree::test
