#include "scree/geometry/solid_deviation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scree/base/error.hpp"
#include "scree/geometry/signed_distance.hpp"
#include "scree/geometry/sphere_decomposition.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(sample_surface, points_lie_on_the_surface_and_cover_it) {
  testing_random::Random random{31};
  const double radius = 1.0, half_length = 0.5;
  const Solid solid = cylinder_solid(radius, half_length);
  const std::vector<SurfaceSample> samples = sample_surface(solid, 2000);
  for (const SurfaceSample& s : samples) {
    EXPECT_NEAR(solid.signed_distance(s.point), 0.0, 5e-3);  // edges of the prism lie below the arc by the sagitta
    EXPECT_NEAR(norm(s.normal), 1.0, 1e-12);
    EXPECT_GT(solid.signed_distance(s.point + 0.1 * s.normal), 0.05);
  }
  // 2000 samples on 3 pi r^2 stand 0.069 apart on average; no point is further than twice that from one.
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(0.0, 2.0 * kPi);
    const Vec3 p{radius * std::cos(angle), radius * std::sin(angle), random.uniform(-half_length, half_length)};
    double nearest = 1e300;
    for (const SurfaceSample& s : samples) nearest = std::min(nearest, norm(s.point - p));
    EXPECT_LT(nearest, 0.14);
  }
}

// A ball of radius r in a cube of half length h: the corners are sqrt(3) h - r away from it; its own furthest points
// from the surface are those on the diagonals, h - r / sqrt(3) deep. Samples miss the extremes by less than a spacing,
// and by far less where the distance is smooth.
TEST(measure_deviation, of_a_ball_in_a_cube_is_the_closed_form) {
  const double h = 0.5, r = 0.6;
  const SolidDeviation found = measure_deviation(box_solid({h, h, h}), std::vector<Sphere>{{{}, r}});
  EXPECT_NEAR(found.solid_to_cluster, std::sqrt(3.0) * h - r, 1e-12);  // corners are samples
  EXPECT_NEAR(found.cluster_to_solid, h - r / std::sqrt(3.0), 0.01);
  EXPECT_NEAR(found.volume_error, 4.0 / 3.0 * kPi * r * r * r - 1.0, 1e-12);
}

// Two balls at +-a on the axis of a cylinder: the crevice between them lies on the circle of radius sqrt(r^2 - a^2).
TEST(measure_deviation, finds_the_bottom_of_a_crevice) {
  const double a = 0.45, r = 0.5;
  const std::vector<Sphere> pair{{{0, 0, -a}, r}, {{0, 0, a}, r}};
  const SolidDeviation found = measure_deviation(cylinder_solid(r, a + r), pair);
  EXPECT_NEAR(found.cluster_to_solid, r - std::sqrt(r * r - a * a), 1e-12);
}

// Where balls meet in threes crevices are deepest; those points are computed, not sampled, so that few samples find what
// many do, to the 1 % of the size that the header states.
TEST(measure_deviation, few_samples_find_the_deepest_crevices) {
  const std::vector<Sphere> balls = decompose_box({1, 2, 3}, {.max_spheres = 20}).spheres;
  const Solid box = box_solid({1, 2, 3});
  const double few = measure_distances(box, balls, 100).cluster_to_solid;
  EXPECT_NEAR(few, measure_distances(box, balls, 30000).cluster_to_solid, 0.01 * box.size);
}

// A ball larger than the solid: from each point of the surface the way out leads through the ball.
TEST(measure_deviation, measures_balls_that_swallow_the_solid) {
  const double h = 0.5, r = 2.0;
  const SolidDeviation found = measure_deviation(box_solid({h, h, h}), std::vector<Sphere>{{{}, r}});
  EXPECT_NEAR(found.solid_to_cluster, r - h, 0.02);  // from the middles of the faces
  EXPECT_NEAR(found.cluster_to_solid, r - h, 0.02);
}

TEST(solid, volume_and_size_are_exact) {
  EXPECT_DOUBLE_EQ(box_solid({1, 2, 2}).size, 6.0);
  EXPECT_DOUBLE_EQ(cylinder_solid(3.0, 4.0).size, 10.0);
  EXPECT_DOUBLE_EQ(cylinder_solid(1.0, 2.0).volume, 4.0 * kPi);
  const ConvexHull hull = convex_hull(box_mesh({1, 2, 2}).vertices);
  EXPECT_NEAR(hull_solid(hull).size, 6.0, 1e-14);
  EXPECT_NEAR(hull_solid(hull).volume, 32.0, 1e-12);
  EXPECT_NEAR(mesh_solid(box_mesh({1, 2, 2})).volume, 32.0, 1e-12);
  TriangleMesh open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_THROW((void)mesh_solid(open), Error);
}

}  // namespace
}  // namespace scree
