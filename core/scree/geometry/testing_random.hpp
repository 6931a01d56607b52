// Random points and rotations for the tests of this folder; fixed seeds, so that a failure repeats.
#pragma once

#include <random>
#include <vector>

#include "scree/math/quat.hpp"

namespace scree::testing_random {

class Random {
 public:
  explicit Random(unsigned seed) : engine_{seed} {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>{low, high}(engine_); }
  Vec3 in_box(const Vec3& low, const Vec3& high) {
    const double x = uniform(low.x, high.x), y = uniform(low.y, high.y), z = uniform(low.z, high.z);
    return {x, y, z};
  }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(engine_), y = normal(engine_), z = normal(engine_);
    return normalized(Vec3{x, y, z});
  }
  Quat rotation() {
    std::normal_distribution<double> normal;
    const double w = normal(engine_), x = normal(engine_), y = normal(engine_), z = normal(engine_);
    return normalized(Quat{w, x, y, z});
  }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

}  // namespace scree::testing_random
