#include "coarse_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scree/math/contact_frame.hpp"
#include "scree/parallel/executor.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

const CellGrid kUnit{{{0, 0, 0}, {1, 1, 1}}, {10, 10, 10}};
constexpr double kCell = 1e-3;  // volume of a cell [m3]

/// Grains at random places between `low` and `high` in each direction, at rest.
std::vector<Grain> cloud(std::size_t count, double low, double high, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> place{low, high}, mass{0.5, 2.0};
  std::vector<Grain> grains(count);
  for (Grain& grain : grains) {
    grain.place = {place(random), place(random), place(random)};
    grain.mass = mass(random);
    grain.volume = 0.1 * grain.mass;
  }
  return grains;
}

/// `per_edge`^3 grains of equal mass at equal distances, far beyond the grid, so that it feels no border.
std::vector<Grain> lattice(int per_edge) {
  std::vector<Grain> grains;
  for (int k = 0; k < per_edge * per_edge * per_edge; ++k) {
    const auto at = [&](int i) { return -0.5 + 2.0 * (i + 0.5) / per_edge; };
    grains.push_back({{at(k % per_edge), at(k / per_edge % per_edge), at(k / per_edge / per_edge)}, {}, 1.0, 0.5});
  }
  return grains;
}

class CoarseFieldTest : public testing::TestWithParam<KernelKind> {
 protected:
  // A range of 0.3 for either kernel.
  [[nodiscard]] Kernel kernel() const { return {GetParam(), GetParam() == KernelKind::lucy ? 0.15 : 0.1}; }
  Executor executor{1};
};

// Sums of 1000 terms over 1000 cells: 1e-13 relative.
TEST_P(CoarseFieldTest, keeps_mass_volume_and_momentum) {
  CoarseField field{kUnit, kernel()};
  std::mt19937_64 random{1};
  std::normal_distribution<double> speed;
  double mass = 0.0, volume = 0.0;
  Vec3 momentum;
  for (std::uint64_t look = 0; look < 2; ++look) {
    std::vector<Grain> grains = cloud(500, 0.31, 0.69, look);
    for (Grain& grain : grains) {
      grain.velocity = {speed(random), speed(random), 3.0 + speed(random)};
      mass += 0.5 * grain.mass;
      volume += 0.5 * grain.volume;
      momentum += 0.5 * grain.mass * grain.velocity;
    }
    field.add(grains, {}, executor);
  }
  double found_mass = 0.0, found_volume = 0.0;
  Vec3 found_momentum;
  for (std::size_t k = 0; k < field.size(); ++k) {
    const CoarseCell cell = field.cell(k, true, 0.0);
    found_mass += cell.density * kCell;
    found_volume += cell.solid_fraction * kCell;
    if (cell.density > 0.0) found_momentum += cell.density * kCell * cell.velocity;
  }
  EXPECT_NEAR(found_mass, mass, 1e-12 * mass);
  EXPECT_NEAR(found_volume, volume, 1e-12 * volume);
  EXPECT_LT(norm(found_momentum - momentum), 1e-12 * mass * 3.0);
}

TEST_P(CoarseFieldTest, is_uniform_where_grains_are) {
  CoarseField field{kUnit, kernel()};
  field.add(lattice(40), {}, executor);  // a grain every 0.05: 8000 per unit of volume
  for (std::size_t k = 0; k < field.size(); ++k) {
    const CoarseCell cell = field.cell(k, true, 0.0);
    EXPECT_NEAR(cell.density, 8000.0, 0.02 * 8000.0);  // 6 grains in a range: sums are even to a percent
    EXPECT_NEAR(cell.solid_fraction, 4000.0, 0.02 * 4000.0);
  }
}

// Grains at random places that move with a linear field exactly: no temperature, to the rounding of the squares.
TEST_P(CoarseFieldTest, sees_no_temperature_in_a_shear_flow_without_its_gradient) {
  CoarseField field{kUnit, kernel()};
  std::vector<Grain> grains = cloud(4000, 0.0, 1.0, 3);
  for (Grain& grain : grains) grain.velocity = {5.0 + 2.0 * grain.place.z - grain.place.y, 3.0 * grain.place.x, 0.5};
  field.add(grains, {}, executor);
  for (std::size_t k = 0; k < field.size(); ++k) {
    EXPECT_LT(field.cell(k, true, 0.0).temperature, 1e-12);
    EXPECT_GT(field.cell(k, false, 0.0).temperature, 1e-3);
  }
}

// With its gradient a shear flow has T = shear^2 <z^2> / 3; <z^2> under Lucy's kernel is R^2 / 12 = w^2 / 3, under the cut
// Gaussian (at 3 w) w^2 P(5/2, 9/2) / P(3/2, 9/2), with the incomplete gamma functions 0.8909 / 0.9707 = 0.9178. The
// kernel is normalised over cells of a third of its range: 2 %.
TEST_P(CoarseFieldTest, sees_the_shear_as_temperature_if_it_is_left_in) {
  CoarseField field{kUnit, kernel()};
  std::vector<Grain> grains = lattice(40);
  for (Grain& grain : grains) grain.velocity = {2.0 * grain.place.z, 0, 0};
  field.add(grains, {}, executor);
  const double spread = GetParam() == KernelKind::lucy ? 0.15 * 0.15 / 3.0 : 0.9178 * 0.1 * 0.1;
  const CoarseCell cell = field.cell(555, false, 0.0);
  EXPECT_NEAR(cell.temperature, 4.0 * spread / 3.0, 0.03 * 4.0 * spread / 3.0);
  EXPECT_NEAR(cell.kinetic_stress.row0.x, 3.0 * cell.density * cell.temperature, 1e-9 * cell.density);
}

// Grains with random velocities of variance 0.09 per direction on top of a shear flow; 24 looks. The mean over all cells rests
// on 24 x 2000 grains and three directions: 0.4 %. The plane takes 4 grains' freedoms of the 270 samples in a corner and of 2000
// in the middle: less than a percent of the mean. Together 2.5 %.
TEST_P(CoarseFieldTest, finds_the_temperature_of_random_velocities_on_a_shear_flow) {
  CoarseField field{kUnit, kernel()};
  std::mt19937_64 random{5};
  std::normal_distribution<double> speed{0.0, 0.3};
  for (std::uint64_t look = 0; look < 24; ++look) {
    std::vector<Grain> grains = cloud(2000, 0.0, 1.0, look);
    for (Grain& grain : grains) {
      grain.velocity = Vec3{4.0 * grain.place.y, 0, 1.0} + Vec3{speed(random), speed(random), speed(random)};
    }
    field.add(grains, {}, executor);
  }
  double mean = 0.0;
  for (std::size_t k = 0; k < field.size(); ++k) mean += field.cell(k, true, 0.0).temperature / 1000.0;
  EXPECT_NEAR(mean, 0.09, 0.025 * 0.09);
}

TEST_P(CoarseFieldTest, removes_gradients_of_a_single_layer_too) {
  CoarseField field{kUnit, kernel()};
  std::vector<Grain> grains = cloud(2000, 0.0, 1.0, 7);
  for (Grain& grain : grains) {
    grain.place.y = 0.5;
    grain.velocity = {2.0 * grain.place.z, 0, 0};
  }
  field.add(grains, {}, executor);
  const CoarseCell cell = field.cell(555, true, 0.0);
  EXPECT_GT(cell.density, 0.0);
  EXPECT_LT(cell.temperature, 1e-12);
}

TEST_P(CoarseFieldTest, is_the_same_to_the_bit_for_any_number_of_threads) {
  const Executor two{2};
  CoarseField one_field{kUnit, kernel()}, two_field{kUnit, kernel()};
  const std::vector<Grain> grains = cloud(3000, -0.2, 1.2, 9);
  one_field.add(grains, {}, executor);
  two_field.add(grains, {}, two);
  for (std::size_t k = 0; k < one_field.size(); ++k) {
    EXPECT_EQ(one_field.cell(k, true, 0.0).density, two_field.cell(k, true, 0.0).density);
  }
}

TEST_P(CoarseFieldTest, knows_nothing_of_motion_where_nothing_is) {
  CoarseField field{kUnit, kernel()};
  field.add(std::vector<Grain>{{{0.9, 0.9, 0.9}, {}, 1.0, 1.0}, {{50, 0, 0}, {}, 1.0, 1.0}}, {}, executor);
  const CoarseCell empty = field.cell(0, true, 0.0), one = field.cell(999, true, 2.0);
  EXPECT_EQ(empty.density, 0.0);
  EXPECT_TRUE(std::isnan(empty.velocity.x));
  EXPECT_GT(one.density, 0.0);
  EXPECT_TRUE(std::isnan(one.temperature)) << "one grain is fewer than two";
}

INSTANTIATE_TEST_SUITE_P(kernels, CoarseFieldTest, testing::Values(KernelKind::lucy, KernelKind::gaussian));

// A ball on a table, another on it: each contact gives - f b per ball, and the field holds their sum. The lower contact counts
// for one ball only, since the table has no centre.
TEST(coarse_stress, of_all_cells_is_the_sum_of_force_times_branch) {
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_immovable(0, {0.5, 0.5, 0.4});
  bodies.add_sphere(1, {0.5, 0.5, 0.45}, 0.05, 1000.0);
  bodies.add_sphere(2, {0.55, 0.5, 0.53}, 0.05, 1000.0);
  std::vector<Contact> contacts(2);
  contacts[0].a = 0, contacts[0].b = 1, contacts[0].point = {0.5, 0.5, 0.4}, contacts[0].normal = {0, 0, 1};
  contacts[1].a = 1, contacts[1].b = 2, contacts[1].point = {0.525, 0.5, 0.49}, contacts[1].normal = {0.6, 0, 0.8};
  const std::vector<Vec3> impulse{{0.02, 0, 0}, {0.01, 0.001, 0}};  // in the contact frame [N s]
  Observation now{bodies.view(), {}, {}, 0.0, 1e-3, 1};
  now.contacts.contact = contacts;
  now.contacts.impulse = impulse;
  std::vector<BranchPoint> branches;
  append_branches(now, branches);
  CoarseField field{kUnit, {KernelKind::lucy, 0.1}};
  field.add({}, branches, Executor{1});
  Mat3 found;
  for (std::size_t k = 0; k < field.size(); ++k) {
    const Mat3 s = field.cell(k, true, 0.0).contact_stress;
    found = found + Mat3{kCell * s.row0, kCell * s.row1, kCell * s.row2};
  }
  // The lower one: 20 N upwards, branch 0.05 m downwards.
  const Vec3 f = to_world(contact_frame(contacts[1].normal), impulse[1]) / 1e-3, apart{0.05, 0, 0.08};
  EXPECT_NEAR(found.row0.x, f.x * apart.x, 1e-12);
  EXPECT_NEAR(found.row0.z, f.x * apart.z, 1e-12);
  EXPECT_NEAR(found.row2.x, f.z * apart.x, 1e-12);
  EXPECT_NEAR(found.row2.z, 20.0 * 0.05 + f.z * apart.z, 1e-12);
  EXPECT_NEAR(found.row1.y, f.y * apart.y, 1e-12);
}

}  // namespace
}  // namespace scree
