// Networks of packings that can be counted by hand.
#include "network.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "contact_network.hpp"
#include "scree/config/validate.hpp"
#include "scree/model/material.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

constexpr double kStep = 1e-3, kFriction = 0.5;

/// n^3 spheres of diameter 1 on a cubic lattice, every neighbour pressed with 1 N.
struct Lattice {
  explicit Lattice(int n) : size{n} {
    materials.add({"stone", 1000.0, {.friction = kFriction}, {}});
    for (BodyId k = 0; k < static_cast<BodyId>(n) * static_cast<BodyId>(n * n); ++k) {
      const auto i = static_cast<int>(k);
      bodies.add_sphere(k, {0.0 + i % n, 0.0 + i / n % n, 0.0 + i / (n * n)}, 0.5, 1000.0);
    }
    for (int i = 0; i < n * n * n; ++i) {
      if (i / (n * n) + 1 < n) press(i, i + n * n, {0, 0, 1});
      if (i / n % n + 1 < n) press(i, i + n, {0, 1, 0});
      if (i % n + 1 < n) press(i, i + 1, {1, 0, 0});
    }
  }
  /// @param force [N] @param shear over normal force [1]
  void press(int a, int b, const Vec3& normal, double force = 1.0, double shear = 0.0) {
    contact.push_back(
        {static_cast<BodyIndex>(a), static_cast<BodyIndex>(b), 0, 0, contact.size(),
         0.5 * (bodies.position[static_cast<std::size_t>(a)] + bodies.position[static_cast<std::size_t>(b)]), normal,
         0.0});
    impulse.push_back({force * kStep, shear * force * kStep, 0.0});
    velocity.emplace_back();
  }
  [[nodiscard]] Network network(const Region& region = {}) const {
    Network out;
    build_network(bodies.view(), {contact, impulse, velocity, velocity}, kStep, materials, region, out);
    return out;
  }

  int size;
  Attributes attributes;
  test::TestBodies bodies{attributes};
  Materials materials;
  std::vector<Contact> contact;
  std::vector<Vec3> impulse, velocity;
};

// 5^3: 3 n^2 (n - 1) = 300 links, coordination 2 * 300 / 125 = 4.8; 8 corners have 3, 36 edges 4, 54 faces 5, 27 insiders 6.
TEST(network, simple_cubic_lattice_is_counted_by_hand) {
  const Lattice lattice{5};
  const Network network = lattice.network();
  ASSERT_EQ(network.links.size(), 300u);
  const Coordination grains = coordination(network, 3);
  EXPECT_DOUBLE_EQ(grains.mean, 4.8);
  EXPECT_EQ(grains.distribution, (std::vector<std::uint64_t>{0, 0, 0, 8, 36, 54, 27}));
  EXPECT_EQ(grains.rattlers, 0u);
  EXPECT_DOUBLE_EQ(grains.mean_without_rattlers, 4.8);
  const Fabric normals = fabric(network);
  EXPECT_NEAR(normals.tensor.row0.x, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(normals.tensor.row2.z, 1.0 / 3.0, 1e-15);
  EXPECT_EQ(normals.tensor.row0.y, 0.0);
  EXPECT_NEAR(normals.anisotropy, 0.0, 1e-14);
}

// The inner 3^3 of it: each has six links, those to grains outside of the region too.
TEST(network, grains_of_a_region_keep_their_links_to_others) {
  const Lattice lattice{5};
  test::FakeSceneServices services;
  const Region inside{
      options_from_text("region = { lower = [0.5, 0.5, 0.5], upper = [3.5, 3.5, 3.5] }", {Region::parameter()}),
      services};
  const Network network = lattice.network(inside);
  const Coordination grains = coordination(network, 3);
  EXPECT_EQ(grains.grains, 27u);
  EXPECT_DOUBLE_EQ(grains.mean, 6.0);
}

// Without the corners' three links, their neighbours on the edges have three left, and so on with `least` 4: nothing of the
// lattice's surface holds, and in the end nothing at all.
TEST(network, rattlers_go_until_none_is_left) {
  const Lattice lattice{3};
  const Coordination none = coordination(lattice.network(), 4);
  EXPECT_EQ(none.rattlers, 27u);
  EXPECT_EQ(none.mean_without_rattlers, 0.0);
  // Two corners that nothing touches are rattlers, and leave the rest with their links.
  Lattice loose{3};
  loose.bodies.add_sphere(27, {9, 9, 9}, 0.5, 1000.0);
  loose.bodies.add_sphere(28, {12, 9, 9}, 0.5, 1000.0);
  loose.press(26, 27, normalized(Vec3{1, 1, 1}));
  const Coordination some = coordination(loose.network(), 3);
  EXPECT_EQ(some.rattlers, 2u);
  EXPECT_DOUBLE_EQ(some.mean_without_rattlers, 2.0 * 54.0 / 27.0);
  EXPECT_DOUBLE_EQ(some.mean, 2.0 * 55.0 / 29.0);
}

// All normals along one axis: F = diag(0, 0, 1), D = 15/2 diag(-1/3, -1/3, 2/3), sqrt(3/2 D : D) = 15/2.
TEST(network, a_column_is_as_anisotropic_as_can_be) {
  Lattice column{1};
  for (BodyId k = 1; k < 6; ++k) {
    column.bodies.add_sphere(k, {0, 0, static_cast<double>(k)}, 0.5, 1000.0);
    column.press(static_cast<int>(k) - 1, static_cast<int>(k), {0, 0, 1});
  }
  const Fabric normals = fabric(column.network());
  EXPECT_EQ(normals.tensor.row2.z, 1.0);
  EXPECT_NEAR(normals.anisotropy, 7.5, 1e-14);
}

// Normals drawn by 1 + D : n n give D back: here integrated over a fine grid of directions, D = diag(-0.2, -0.2, 0.4).
TEST(network, the_anisotropy_is_the_coefficient_of_the_distribution) {
  Network network;
  network.grain = {1, 1};
  // As many normals as the density says, z uniform on the sphere: 1 - 0.2 + 0.6 z^2.
  for (int i = 0; i < 400; ++i) {
    const double z = -1.0 + (i + 0.5) / 200.0, r = std::sqrt(1.0 - z * z);
    const int times = static_cast<int>(std::lround(1000.0 * (0.8 + 0.6 * z * z)));
    for (int k = 0; k < times; ++k) {
      const double angle = 6.283185307179586 * k / times;
      Link link;
      link.b = 1;
      link.normal = {r * std::cos(angle), r * std::sin(angle), z};
      network.links.push_back(link);
    }
  }
  // D : D = 0.24, sqrt(1.5 * 0.24) = 0.6; rounding to whole links and the midpoint rule leave 1e-4.
  EXPECT_NEAR(fabric(network).anisotropy, 0.6, 1e-3);
}

// Two points of one pair are one link: forces add up, mobilisation is that of the worse point; 0.5 of 0.5 slides.
TEST(network, points_of_a_pair_are_one_link) {
  Lattice pair{1};
  pair.bodies.add_sphere(1, {0, 0, 1}, 0.5, 1000.0);
  pair.press(0, 1, {0, 0, 1}, 2.0, 0.1);
  pair.press(0, 1, {0, 0, 1}, 3.0, 0.5);
  pair.press(0, 1, {0, 0, 1}, 0.0);
  const Network network = pair.network();
  ASSERT_EQ(network.links.size(), 1u);
  EXPECT_DOUBLE_EQ(network.links[0].normal_force, 5.0);
  EXPECT_DOUBLE_EQ(network.links[0].tangential_force, 0.2 + 1.5);
  EXPECT_DOUBLE_EQ(network.links[0].mobilisation, 1.0);
  EXPECT_TRUE(network.links[0].slides);
  EXPECT_EQ(network.degree[0], 1u);
}

// Forces 1, 2, 3, 10 over their mean of 4: bins of 0.2; the density integrates to one.
TEST(network, forces_are_counted_over_their_mean) {
  Lattice many{1};
  const std::array force{1.0, 2.0, 3.0, 10.0};
  for (BodyId k = 1; k < 5; ++k) {
    many.bodies.add_sphere(k, {0, 0, static_cast<double>(k)}, 0.5, 1000.0);
    many.press(static_cast<int>(k) - 1, static_cast<int>(k), {0, 0, 1}, force[k - 1]);
  }
  ForceHistogram histogram{};
  histogram.add(many.network());
  EXPECT_EQ(histogram.total(), 4u);
  for (const double over_mean : {0.25, 0.5, 0.75, 2.5}) {
    EXPECT_EQ(histogram.count(static_cast<std::size_t>(over_mean / 0.2 + 1e-9)), 1u) << over_mean;
  }
  double integral = 0.0;
  for (std::size_t k = 0; k < ForceHistogram::kBins; ++k) {
    integral += histogram.density(k) * (ForceHistogram::edge(k + 1) - ForceHistogram::edge(k));
  }
  EXPECT_NEAR(integral, 1.0, 1e-14);
}

}  // namespace
}  // namespace scree
