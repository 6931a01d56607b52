#include "family.hpp"

#include <cmath>
#include <numbers>

#include "scree/base/error.hpp"
#include "testing_feed.hpp"

namespace scree {
namespace {

using testing_feed::FeedScene;
constexpr double kPi = std::numbers::pi;

Mixture mixture_of(FeedScene& scene, const std::string& families) {
  return Mixture{options_from_text("families = [" + families + "]", Mixture::parameters()), scene.services};
}

/// A particle of one family with this shape, its size 2 mm, of copper.
Particle particle_of(FeedScene& scene, const std::string& shape) {
  RandomStream random{3, "test"};
  return mixture_of(scene,
                    "{name = 'f', material = 'copper', size = {type = 'uniform', min = 2e-3, max = 2.001e-3}, "
                    "shape = " +
                        shape + "}")
      .draw(random);
}

std::string refusal(FeedScene& scene, const std::string& shape) {
  try {
    static_cast<void>(particle_of(scene, shape));
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

// Volume, first and second moments of a union of balls by a grid of n^3 points: independent of the slices of the core.
struct GridMoments {
  double volume = 0.0;
  Vec3 first, square, product;  // integrals of x; x^2; yz, zx, xy
};
GridMoments integrate(const std::vector<Sphere>& spheres, double half, int n) {
  GridMoments sum;
  const double h = 2.0 * half / n;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 p = h * Vec3{i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5} - Vec3{half, half, half};
    const bool inside = std::any_of(spheres.begin(), spheres.end(),
                                    [&](const Sphere& s) { return squared_norm(p - s.centre) <= s.radius * s.radius; });
    if (!inside) continue;
    sum.volume += h * h * h;
    sum.first += (h * h * h) * p;
    sum.square += (h * h * h) * hadamard(p, p);
    sum.product += (h * h * h) * Vec3{p.y * p.z, p.z * p.x, p.x * p.y};
  }
  return sum;
}

TEST(family, mass_and_inertia_of_a_box_are_those_of_the_box) {
  FeedScene scene;
  const Particle p = particle_of(scene, "{type = 'box', proportions = [1, 2, 3]}");
  const double d = 2.0 * p.body.radius, m = 8400.0 * kPi / 6.0 * d * d * d;
  const double edge = std::cbrt(kPi / 6.0 * d * d * d / 6.0);  // 1 : 2 : 3 edges of the volume of a ball of diameter d
  EXPECT_NEAR(p.body.mass, m, 1e-12 * m);
  const Vec3 expected = (m / 12.0 * edge * edge) * Vec3{4 + 9, 1 + 9, 1 + 4};
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p.body.inertia[axis], expected[axis], 1e-9 * expected[axis]);
}

TEST(family, mass_and_inertia_of_a_cylinder_are_those_of_the_cylinder) {
  FeedScene scene;
  const Particle p = particle_of(scene, "{type = 'cylinder', aspect = 2}");
  const double d = 2.0 * p.body.radius, m = 8400.0 * kPi / 6.0 * d * d * d;
  const double r = std::cbrt(d * d * d / 24.0), l = 4.0 * r;  // pi r^2 4 r = pi d^3 / 6
  const double across = m / 12.0 * (3.0 * r * r + l * l), along = 0.5 * m * r * r;
  EXPECT_NEAR(p.body.mass, m, 1e-12 * m);
  EXPECT_NEAR(p.body.inertia.x, across, 1e-9 * across);
  EXPECT_NEAR(p.body.inertia.y, across, 1e-9 * across);
  EXPECT_NEAR(p.body.inertia.z, along, 1e-9 * along);
}

TEST(family, mass_and_inertia_of_a_shaving_are_those_of_its_balls) {
  FeedScene scene;
  const Particle p = particle_of(scene, "{type = 'shaving', aspect = 4, bend = '120 deg', twist = '60 deg'}");
  const auto& spheres = p.shape->primitives[0].spheres;
  ASSERT_EQ(spheres.size(), 7U);  // one every half diameter over 3 diameters between the ends
  const GridMoments sum = integrate(spheres, p.bounding_radius, 120);
  const double d = 2.0 * p.body.radius, v = kPi / 6.0 * d * d * d;
  // 120 points an edge resolve the surface to half a cell of 3 %, whose errors cancel to some 1e-3.
  EXPECT_NEAR(sum.volume, v, 3e-3 * v);
  EXPECT_NEAR(norm(sum.first) / v, 0.0, 2e-3 * d);
  EXPECT_NEAR(norm(sum.product) / v, 0.0, 2e-3 * d * d);
  const Vec3 expected =
      8400.0 * Vec3{sum.square.y + sum.square.z, sum.square.x + sum.square.z, sum.square.x + sum.square.y};
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p.body.inertia[axis], expected[axis], 5e-3 * expected[axis]);
}

TEST(family, the_balls_of_a_box_lie_within_a_tenth_of_its_size) {
  FeedScene scene;
  const Particle p = particle_of(scene, "{type = 'box', proportions = [1, 1, 2]}");
  const double d = 2.0 * p.body.radius, limit = 0.1 * d * 1.01;  // a hundredth for what measured samples miss
  const double a = std::cbrt(kPi / 12.0) * d;
  const Vec3 half{0.5 * a, 0.5 * a, a};
  const auto& spheres = p.shape->primitives[0].spheres;
  EXPECT_LE(spheres.size(), 32U);
  RandomStream random{1, "surface"};
  for (int i = 0; i < 20000; ++i) {
    Vec3 on{random.uniform(-half.x, half.x), random.uniform(-half.y, half.y), random.uniform(-half.z, half.z)};
    const int axis = i % 3;
    on[axis] = i % 2 == 0 ? half[axis] : -half[axis];
    double outside = 1e300;
    for (const Sphere& s : spheres) outside = std::min(outside, norm(on - s.centre) - s.radius);
    ASSERT_LE(outside, limit);  // no part of the box is farther from the balls
    const Sphere& ball = spheres[static_cast<std::size_t>(i) % spheres.size()];
    const Vec3 tip = ball.centre + ball.radius * rotate(random.orientation(), {0, 0, 1});
    Vec3 beyond;
    for (int k = 0; k < 3; ++k) beyond[k] = std::max(0.0, std::abs(tip[k]) - half[k]);
    ASSERT_LE(norm(beyond), limit);  // and no ball sticks out farther
  }
}

TEST(family, fewer_balls_when_the_scene_wants_fewer_or_few_are_enough) {
  FeedScene scene;
  EXPECT_LE(particle_of(scene, "{type = 'cylinder', aspect = 1, max_spheres = 24}").shape->primitives[0].spheres.size(),
            24U);
  const std::string text = scene.services.log_lines().back();
  EXPECT_NE(text.find("spheres a particle"), std::string::npos) << text;
}

TEST(family, refuses_a_shape_that_balls_cannot_follow) {
  FeedScene scene;
  const std::string flake = refusal(scene, "{type = 'box', proportions = [1, 40, 40]}");
  EXPECT_NE(flake.find("family 'f'"), std::string::npos) << flake;
  EXPECT_NE(flake.find("10 % are needed; make it less thin"), std::string::npos) << flake;
  const std::string coarse = refusal(scene, "{type = 'box', max_spheres = 2}");
  EXPECT_NE(coarse.find("2 spheres come within"), std::string::npos) << coarse;
}

TEST(family, random_hulls_that_balls_cannot_follow_are_drawn_again) {
  FeedScene scene;
  RandomStream random{3, "test"};
  const Mixture hulls =
      mixture_of(scene,
                 "{name = 'chips', material = 'copper', size = {type = 'uniform', min = 1e-3, max = 2e-3}, "
                 "shape = {type = 'hull', corners = 14, variants = 2}}");
  for (int i = 0; i < 20; ++i) {
    const Particle p = hulls.draw(random);
    const double d = 2.0 * p.body.radius, v = kPi / 6.0 * d * d * d;
    EXPECT_NEAR(p.body.mass, 8400.0 * v, 1e-12 * 8400.0 * v);
    if (i > 3) continue;
    // The limit of the volume, and 1 % for the grid.
    EXPECT_NEAR(integrate(p.shape->primitives[0].spheres, p.bounding_radius, 60).volume, v, (kVolumeLimit + 0.01) * v);
  }
}

TEST(family, sizes_densities_and_attributes_follow_their_laws) {
  FeedScene scene;
  const Mixture mixture = mixture_of(
      scene,
      "{name = 'f', material = 'plastic', size = {type = 'uniform', min = 1e-3, max = 3e-3}, density = {type = "
      "'normal', mean = 2000, deviation = 100, min = 1000}, shape = 'sphere', attributes = {relative_permittivity "
      "= {type = 'uniform', min = 2, max = 4}, metal_fraction = 0.25}}");
  const AttributeId permittivity = scene.services.attributes().id("relative_permittivity");
  EXPECT_TRUE(scene.services.provides("relative_permittivity"));
  EXPECT_TRUE(scene.services.provides("metal_fraction"));
  RandomStream random{3, "test"};
  const int n = 20000;
  double size = 0.0, density = 0.0, er = 0.0;
  for (int i = 0; i < n; ++i) {
    const Particle p = mixture.draw(random);
    const double d = 2.0 * p.body.radius;
    ASSERT_GE(d, 1e-3);
    ASSERT_LT(d, 3e-3);
    EXPECT_EQ(p.bounding_radius, p.body.radius);
    size += d / n;
    density += p.body.mass / (kPi / 6.0 * d * d * d) / n;
    ASSERT_EQ(p.body.attributes.size(), 2U);
    for (const auto& [column, value] : p.body.attributes) {
      if (column == permittivity) er += value / n;
      if (column != permittivity) {
        ASSERT_EQ(value, 0.25);
      }
    }
  }
  // Five deviations of a mean of n.
  const double root = std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(size, 2e-3, 5.0 * 2e-3 / std::sqrt(12.0) / root);
  EXPECT_NEAR(density, 2000.0, 5.0 * 100.0 / root);
  EXPECT_NEAR(er, 3.0, 5.0 * 2.0 / std::sqrt(12.0) / root);
}

TEST(family, particles_of_one_size_share_a_shape) {
  FeedScene scene;
  const std::string text = "{name = 'f', material = 'plastic', size = '2 mm', shape = {type = 'shaving'}}";
  const Mixture mixture = mixture_of(scene, text);
  RandomStream random{3, "test"};
  for (int i = 0; i < 100; ++i) {
    const NewBody body = to_body(mixture.draw(random), scene.services.shapes());
    EXPECT_DOUBLE_EQ(scene.services.shapes().shapes()[body.shape].equivalent_radius, body.radius);
  }
  EXPECT_EQ(scene.services.shapes().shapes().size(), 1U);
}

TEST(family, refuses_sizes_that_may_be_negative_and_unknown_materials) {
  FeedScene scene;
  EXPECT_THROW(mixture_of(scene,
                          "{name = 'f', material = 'plastic', shape = 'sphere', size = {type = 'normal', mean = "
                          "1e-3, deviation = 1e-3}}"),
               Error);
  EXPECT_THROW(mixture_of(scene, "{name = 'f', material = 'plastic', shape = 'sphere', size = 0}"), Error);
  EXPECT_THROW(mixture_of(scene, "{name = 'f', material = 'gold', shape = 'sphere', size = 1e-3}"), Error);
}

}  // namespace
}  // namespace scree
