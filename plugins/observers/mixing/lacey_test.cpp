#include "lacey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace scree {
namespace {

constexpr BodyClass kA = BodyClass::first, kB = BodyClass::second;

/// `cells` cells of `each` particles; the classes as dealt by `of`, which gets cell and place.
template <class Of>
std::vector<Lacey::Particle> bed(std::int64_t cells, int each, Of&& of) {
  std::vector<Lacey::Particle> particles;
  for (std::int64_t c = 0; c < cells; ++c) {
    for (int k = 0; k < each; ++k) particles.push_back({c, of(c, k), 1.0});
  }
  return particles;
}

void deal_again(std::vector<Lacey::Particle>& particles, std::mt19937_64& random) {
  for (std::size_t i = particles.size() - 1; i > 0; --i) {
    const std::size_t j = std::uniform_int_distribution<std::size_t>{0, i}(random);
    std::swap(particles[i].of, particles[j].of);
    std::swap(particles[i].mass, particles[j].mass);
  }
}

TEST(lacey, is_zero_for_a_bed_in_two_halves) {
  Lacey lacey{10, 5, false};
  const LaceyIndex found = lacey.index(bed(10, 20, [](std::int64_t c, int) { return c < 4 ? kA : kB; }));
  EXPECT_NEAR(found.value, 0.0, 1e-14);
  EXPECT_NEAR(found.variance_segregated, 0.4 * 0.6, 1e-15);
  EXPECT_EQ(found.cells, 10u);
}

// Every cell holds the very same: s = 0, M = s0^2 / (s0^2 - sr^2) = 1 / (1 - (m - 1) / (N - 1)).
TEST(lacey, is_above_one_for_an_ordered_bed) {
  Lacey lacey{10, 5, false};
  const LaceyIndex found = lacey.index(bed(10, 20, [](std::int64_t, int k) { return k % 2 == 0 ? kA : kB; }));
  EXPECT_NEAR(found.value, 1.0 / (1.0 - 9.0 / 199.0), 1e-14);
}

// Law: over random deals the mean index is 1, for cells of unequal filling too, and its scatter is the stated width.
// 2000 deals: the mean's error is width / 45, so 4 of them; the scatter is known to 1.6 %, and the chi-square width is that
// of many particles per cell: 10 %.
TEST(lacey, is_one_within_its_width_for_a_random_mixture) {
  std::mt19937_64 random{3};
  std::vector<Lacey::Particle> particles =
      bed(30, 15, [](std::int64_t c, int k) { return (c + k) % 3 == 0 ? kA : kB; });
  for (int k = 0; k < 300; ++k) particles.push_back({k % 7, k % 2 == 0 ? kA : kB, 1.0});
  Lacey lacey{30, 5, false};
  double mean = 0.0, squares = 0.0, width = 0.0;
  constexpr int kDeals = 2000;
  for (int deal = 0; deal < kDeals; ++deal) {
    deal_again(particles, random);
    const LaceyIndex found = lacey.index(particles);
    mean += found.value / kDeals;
    squares += (found.value - 1.0) * (found.value - 1.0) / kDeals;
    width = found.width;
  }
  EXPECT_NEAR(mean, 1.0, 4.0 * width / std::sqrt(kDeals));
  // The cells have unequal weights, so that fewer than m - 1 of them count in full: the scatter is larger than the width.
  EXPECT_GT(std::sqrt(squares), 0.9 * width);
  EXPECT_LT(std::sqrt(squares), 1.6 * width);
}

TEST(lacey, scatters_by_its_width_when_all_cells_are_equal) {
  std::mt19937_64 random{5};
  std::vector<Lacey::Particle> particles = bed(40, 25, [](std::int64_t, int k) { return k % 2 == 0 ? kA : kB; });
  Lacey lacey{40, 5, false};
  double squares = 0.0, width = 0.0;
  constexpr int kDeals = 2000;
  for (int deal = 0; deal < kDeals; ++deal) {
    deal_again(particles, random);
    const LaceyIndex found = lacey.index(particles);
    squares += (found.value - 1.0) * (found.value - 1.0) / kDeals;
    width = found.width;
  }
  EXPECT_NEAR(std::sqrt(squares) / width, 1.0, 0.1);
}

// By mass, with the first class eight times as heavy. The formula is of first order in 1 / N_c with factors of the spread of
// masses, here about 2.5: 1.6 % for 160 particles a cell; 1000 deals know the mean to 0.7 %. Together 4 %; by the formula for
// equal masses it would be off by 60 %.
TEST(lacey, by_mass_is_one_for_a_random_mixture_of_unequal_particles) {
  std::mt19937_64 random{7};
  std::vector<Lacey::Particle> particles = bed(40, 160, [](std::int64_t, int k) { return k % 4 == 0 ? kA : kB; });
  for (Lacey::Particle& particle : particles) particle.mass = particle.of == kA ? 8.0 : 1.0;
  Lacey lacey{40, 5, true};
  double ratio = 0.0;
  constexpr int kDeals = 1000;
  for (int deal = 0; deal < kDeals; ++deal) {
    deal_again(particles, random);
    const LaceyIndex found = lacey.index(particles);
    ratio += found.variance / found.variance_random / kDeals;
    EXPECT_NEAR(found.share, 8.0 / 11.0, 1e-12);
  }
  EXPECT_NEAR(ratio, 1.0, 0.04);
}

TEST(lacey, leaves_out_thin_cells_and_what_belongs_to_no_class) {
  std::vector<Lacey::Particle> particles = bed(4, 10, [](std::int64_t c, int) { return c < 2 ? kA : kB; });
  for (int k = 0; k < 4; ++k) particles.push_back({4, kA, 1.0});  // one too few
  particles.push_back({0, BodyClass::neither, 1.0});
  particles.push_back({-1, kB, 1.0});
  Lacey lacey{5, 5, false};
  const LaceyIndex found = lacey.index(particles);
  EXPECT_EQ(found.cells, 4u);
  EXPECT_EQ(found.particles, 40u);
  EXPECT_NEAR(found.value, 0.0, 1e-14);
}

TEST(lacey, has_no_index_without_two_cells_and_two_classes) {
  Lacey lacey{3, 1, false};
  EXPECT_TRUE(std::isnan(lacey.index({}).value));
  EXPECT_TRUE(std::isnan(lacey.index(bed(3, 5, [](std::int64_t, int) { return kA; })).value));
  EXPECT_TRUE(std::isnan(lacey.index(bed(1, 5, [](std::int64_t, int k) { return k < 2 ? kA : kB; })).value));
}

}  // namespace
}  // namespace scree
