#include "neighbour_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr BodyClass kA = BodyClass::first, kB = BodyClass::second;

std::vector<Placed> cloud(std::size_t count, double share, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  std::vector<Placed> particles;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 place{uniform(random), uniform(random), uniform(random)};
    particles.push_back({place, 0.02 + 0.03 * uniform(random), uniform(random) < share ? kA : kB});
  }
  return particles;
}

/// The definition, word by word, over all pairs.
NeighbourIndex by_definition(const std::vector<Placed>& particles, const Neighbourhood& rule) {
  double neighbours = 0.0, unlike = 0.0, first = 0.0;
  for (const Placed& a : particles) {
    std::vector<std::pair<double, const Placed*>> others;
    for (const Placed& b : particles) {
      const double distance = norm(b.position - a.position);
      if (&a != &b && (rule.nearest > 0 || distance <= rule.reach * (a.radius + b.radius)))
        others.emplace_back(distance, &b);
    }
    std::sort(others.begin(), others.end());
    if (rule.nearest > 0) others.resize(std::min(rule.nearest, others.size()));
    neighbours += static_cast<double>(others.size());
    for (const auto& [distance, b] : others) unlike += a.of != b->of ? 1.0 : 0.0;
    first += a.of == kA ? 1.0 : 0.0;
  }
  const auto n = static_cast<double>(particles.size());
  return {unlike / neighbours / (2.0 * first * (n - first) / (n * (n - 1.0))), neighbours / n};
}

TEST(neighbour_index, is_what_its_definition_says) {
  const Executor executor{1};
  const std::vector<Placed> particles = cloud(400, 0.3, 1);
  for (const Neighbourhood& rule :
       {Neighbourhood{12, 0.0}, Neighbourhood{1, 0.0}, Neighbourhood{0, 1.1}, Neighbourhood{0, 2.5}}) {
    const NeighbourIndex found = neighbour_index(particles, rule, executor), expected = by_definition(particles, rule);
    EXPECT_NEAR(found.value, expected.value, 1e-13);
    EXPECT_NEAR(found.coordination, expected.coordination, 1e-13);
  }
}

// 4000 particles with 12 neighbours each; a bond is shared by up to two, so at least 24 000 independent bonds: the scatter
// of the index is below 0.5 / sqrt(24 000) / 0.42 = 0.8 %; 4 of them.
TEST(neighbour_index, is_one_for_a_random_mixture) {
  const Executor executor{1};
  EXPECT_NEAR(neighbour_index(cloud(4000, 0.3, 2), {12, 0.0}, executor).value, 1.0, 0.032);
}

TEST(neighbour_index, is_zero_for_two_clouds_apart) {
  const Executor executor{1};
  std::vector<Placed> particles = cloud(500, 0.5, 3);
  for (Placed& particle : particles) particle.position.x += particle.of == kA ? 5.0 : 0.0;
  EXPECT_EQ(neighbour_index(particles, {12, 0.0}, executor).value, 0.0);
}

// A chequered cubic lattice, neighbours at the lattice distance: all of them are of the other class.
TEST(neighbour_index, is_two_for_a_chequered_lattice) {
  const Executor executor{1};
  std::vector<Placed> particles;
  for (int k = 0; k < 1000; ++k) {
    const int x = k % 10, y = k / 10 % 10, z = k / 100;
    particles.push_back({{1.0 * x, 1.0 * y, 1.0 * z}, 0.5, (x + y + z) % 2 == 0 ? kA : kB});
  }
  const NeighbourIndex found = neighbour_index(particles, {0, 1.1}, executor);
  EXPECT_NEAR(found.value, 2.0 * 999.0 / 1000.0, 1e-12);  // (N - 1) / N for classes of equal size
  EXPECT_NEAR(found.coordination, 6.0 * 0.9, 1e-12);      // a tenth of the bonds end at the faces
}

TEST(neighbour_index, does_not_depend_on_threads) {
  const Executor one{1}, two{2};
  const std::vector<Placed> particles = cloud(5000, 0.5, 4);
  EXPECT_EQ(neighbour_index(particles, {12, 0.0}, one).value, neighbour_index(particles, {12, 0.0}, two).value);
}

TEST(neighbour_index, is_none_without_two_classes_or_neighbours) {
  const Executor executor{1};
  EXPECT_TRUE(std::isnan(neighbour_index({}, {12, 0.0}, executor).value));
  EXPECT_TRUE(std::isnan(neighbour_index(cloud(50, 2.0, 1), {12, 0.0}, executor).value));
  EXPECT_TRUE(std::isnan(neighbour_index(cloud(50, 0.5, 1), {0, 1e-6}, executor).value));
}

}  // namespace
}  // namespace scree
