// The projections onto the Coulomb cone against brute-force minimisation and their optimality conditions.
#include "scree/ccp/cone3.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace scree {
namespace {

double weighted(const Vec3& d, double d_n, double d_t) { return d_n * d.x * d.x + d_t * (d.y * d.y + d.z * d.z); }

// The smallest distance over ever finer grids in polar coordinates of the cone, each around the best point so far. The
// apex, where the angle means nothing, is kept out of the grids.
double brute_force(const Vec3& g, double mu, double d_n, double d_t) {
  constexpr int kHalf = 12;
  double best = std::numeric_limits<double>::infinity();
  double best_n = 2.0 * norm(g), best_angle = 0.0, best_fill = 0.5;
  double span_n = best_n, span_angle = 3.15, span_fill = 0.5;
  for (int level = 0; level < 24; ++level) {
    const double n0 = best_n, angle0 = best_angle, fill0 = best_fill;
    for (int i = -kHalf; i <= kHalf; ++i) {
      const double n = std::max(1e-9, n0 + span_n * i / kHalf);
      for (int j = -kHalf; j <= kHalf; ++j) {
        const double angle = angle0 + span_angle * j / kHalf;
        for (int k = -kHalf; k <= kHalf; ++k) {
          const double fill = std::clamp(fill0 + span_fill * k / kHalf, 0.0, 1.0);
          const Vec3 p{n, fill * mu * n * std::cos(angle), fill * mu * n * std::sin(angle)};
          const double distance = weighted(g - p, d_n, d_t);
          if (distance < best) best = distance, best_n = n, best_angle = angle, best_fill = fill;
        }
      }
    }
    span_n *= 0.5, span_angle *= 0.5, span_fill *= 0.5;
  }
  return std::min(best, weighted(g, d_n, d_t));
}

class Cone3 : public ::testing::Test {
 protected:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
  Vec3 draw() { return {normal_(random_), normal_(random_), normal_(random_)}; }
};

TEST_F(Cone3, projection_is_the_nearest_point_by_brute_force) {
  for (const double mu : {0.0, 0.1, 0.5, 2.0}) {
    for (int i = 0; i < 15; ++i) {
      const Vec3 g = draw();
      const double distance = squared_norm(g - project_cone3(g, mu));
      // The last grid is 2^-24 = 6e-8 of the first, 1e-8 of numbers of size one between its points.
      EXPECT_NEAR(distance, brute_force(g, mu, 1.0, 1.0), 1e-6);
    }
  }
}

TEST_F(Cone3, weighted_projection_is_the_nearest_point_in_its_norm_by_brute_force) {
  for (const double mu : {0.0, 0.3, 1.5}) {
    for (int i = 0; i < 15; ++i) {
      const Vec3 g = draw();
      const double d_n = 0.5 + std::abs(normal_(random_)), d_t = 0.5 + std::abs(normal_(random_));
      const double distance = weighted(g - project_cone3(g, mu, cone_weights(d_n, d_t, mu)), d_n, d_t);
      EXPECT_NEAR(distance, brute_force(g, mu, d_n, d_t), 1e-6);
    }
  }
}

// Moreau: g = p + q with p in K, q in -K* and p . q = 0. Holds to rounding: 1e-14 of numbers of size one.
TEST_F(Cone3, projection_splits_into_cone_and_polar_part) {
  for (int i = 0; i < 10000; ++i) {
    const Vec3 g = draw();
    const double mu = std::abs(normal_(random_)) * (i % 7 == 0 ? 100.0 : 1.0);
    const Vec3 p = project_cone3(g, mu);
    const Vec3 q = g - p;
    const double size = norm(g);
    EXPECT_LE(std::hypot(p.y, p.z), mu * p.x + 1e-14 * size);
    EXPECT_LE(mu * std::hypot(q.y, q.z), -q.x + 1e-14 * size * (1.0 + mu));
    EXPECT_NEAR(dot(p, q), 0.0, 1e-14 * size * size);
  }
}

TEST_F(Cone3, projection_without_friction_keeps_the_positive_normal_part) {
  EXPECT_EQ(project_cone3({2.0, 3.0, -4.0}, 0.0), (Vec3{2.0, 0.0, 0.0}));
  EXPECT_EQ(project_cone3({-2.0, 3.0, -4.0}, 0.0), Vec3{});
  EXPECT_EQ(project_cone3({0.0, 0.0, 0.0}, 0.5), Vec3{});
}

TEST_F(Cone3, projection_without_friction_of_a_purely_normal_pull_is_zero) {
  EXPECT_EQ(project_cone3({-1.0, 0.0, 0.0}, 0.0), Vec3{});
  EXPECT_EQ(project_cone3({-1.0, 0.0, 0.0}, 0.0, cone_weights(2.0, 3.0, 0.0)), Vec3{});
}

TEST_F(Cone3, projection_leaves_points_of_the_cone_untouched) {
  const Vec3 inside{1.0, 0.3, -0.2};
  EXPECT_EQ(project_cone3(inside, 0.5), inside);
  const Vec3 once = project_cone3({1.0, 3.0, -4.0}, 0.5);
  const Vec3 twice = project_cone3(once, 0.5);
  EXPECT_NEAR(norm(twice - once), 0.0, 4e-16 * norm(once));
}

}  // namespace
}  // namespace scree
