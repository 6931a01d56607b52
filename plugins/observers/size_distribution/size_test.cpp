#include <cmath>
#include <random>

#include "analysis/testing_observer.hpp"
#include "size_observer.hpp"

namespace scree {
namespace {

double cubed(double d) { return d * d * d; }

// Diameters uniform by number in [1, 3] mm, at the middles of 20 000 equal parts, with masses d^3: by mass Q3 = (d^4 - 1) / 80
// in mm, and the Sauter mean is (80 / 4) / (26 / 3) mm. Sums over middles err by the squared part, 1e-8.
TEST(sizes, of_a_uniform_distribution_are_those_of_the_closed_form) {
  std::vector<Sized> particles;
  for (int k = 0; k < 20000; ++k) {
    const double d = 1e-3 + 2e-3 * (k + 0.5) / 20000.0;
    particles.push_back({d, 1e6 * cubed(d)});
  }
  Sizes sizes;
  sizes.assign(particles);
  const SizeNumbers n = sizes.numbers();
  for (const auto& [found, p] : {std::pair{n.d10, 0.1}, std::pair{n.d50, 0.5}, std::pair{n.d90, 0.9}}) {
    EXPECT_NEAR(found, 1e-3 * std::pow(1.0 + 80.0 * p, 0.25), 1e-10);
  }
  EXPECT_NEAR(n.d10_number, 1.2e-3, 1e-10);
  EXPECT_NEAR(n.d90_number, 2.8e-3, 1e-10);
  EXPECT_NEAR(n.d32, 1e-3 * 20.0 / (26.0 / 3.0), 1e-10);
}

TEST(sizes, of_equal_particles_are_all_one) {
  const std::vector<Sized> particles(7, {2e-3, 1.0});
  Sizes sizes;
  sizes.assign(particles);
  const SizeNumbers n = sizes.numbers();
  EXPECT_EQ(n.d10, 2e-3);
  EXPECT_EQ(n.d90_number, 2e-3);
  EXPECT_NEAR(n.d32, 2e-3, 1e-18);
  EXPECT_EQ(n.mass, 7.0);
  sizes.assign({});
  EXPECT_TRUE(std::isnan(sizes.numbers().d50));
  EXPECT_TRUE(std::isnan(sizes.numbers().d32));
}

TEST(sizes, classes_hold_every_particle_once) {
  const std::vector<double> edges = size_classes(1.0, 4.0, 2, true);
  EXPECT_NEAR(edges[1], 2.0, 1e-15);
  const std::vector<Sized> particles{{0.5, 1}, {1.0, 2}, {1.9, 3}, {edges[1], 4}, {4.0, 5}, {4.1, 6}};
  SizeHistogram histogram;
  fill_histogram(particles, edges, histogram);
  EXPECT_EQ(histogram.below.mass, 1.0);
  EXPECT_EQ(histogram.in_class[0].mass, 5.0);
  EXPECT_EQ(histogram.in_class[1].mass, 9.0);
  EXPECT_EQ(histogram.in_class[1].number, 2.0);
  EXPECT_EQ(histogram.above.number, 1.0);
}

class SizeTest : public test::ObserverTest<SizeObserver> {};

constexpr const char* kHalf =
    "region = {lower = [0, 0, 0], upper = [1, 1, 1]}\nclasses = {smallest = '1 mm', largest = '5 mm', count = 4}\n";

TEST_F(SizeTest, counts_the_materials_in_the_region) {
  const auto observer = make(std::string{kHalf} + "materials = ['steel']");
  bodies.add_immovable(0, {0.5, 0.5, 0.5});
  for (BodyId id = 1; id <= 8; ++id) {
    bodies.add_sphere(id, {id % 2 == 0 ? 0.5 : 1.5, 0.5, 0.5}, 0.5e-3 * static_cast<double>(id), 1000.0);
    bodies.material.back() = id <= 2 ? 0 : 1;  // steel in the region: 4, 6, 8, of which 4 mm lies in a class
  }
  observer->observe(at(1), services.attributes());
  observer->finish(at(1));
  const auto rows = csv("size_distribution.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1][1], "3");
  EXPECT_EQ(rows[1][13], "2");
  EXPECT_NEAR(std::stod(rows[1][9]), (64.0 + 216.0 + 512.0) / (16.0 + 36.0 + 64.0) * 1e-3, 1e-15);
  const auto classes = csv("size_distribution_histogram.csv");
  ASSERT_EQ(classes.size(), 5u);
  EXPECT_EQ(classes[4][3], "1");
  EXPECT_NEAR(std::stod(classes[4][8]), 64.0 / 792.0, 1e-15);
  EXPECT_TRUE(has_figure("size_distribution"));
  EXPECT_TRUE(has_figure("size_distribution_over_time"));
}

TEST_F(SizeTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](SizeObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      bodies.add_sphere(100 + step, {0.5, 0.5, 0.5}, 1e-4 * static_cast<double>(step), 1000.0);
      if (step % 3 == 0) erase(step % 20);
      observer.observe(at(step), services.attributes());
    }
  };
  const auto begin = [&] {
    for (BodyId id = 1; id <= 20; ++id) bodies.add_sphere(id, {0.5, 0.5, 0.5}, 1e-4 * static_cast<double>(id), 1000.0);
  };
  expect_checkpoints_to_keep_everything(std::string{kHalf} + "interval = 0.03", begin, run);
}

TEST_F(SizeTest, refuses_classes_upside_down_and_unknown_materials) {
  EXPECT_NE(refusal("classes = {smallest = '5 mm', largest = '1 mm'}").find("must be above smallest"),
            std::string::npos);
  EXPECT_NE(refusal(std::string{kHalf} + "materials = ['gold']").find("'gold'"), std::string::npos);
}

}  // namespace
}  // namespace scree
