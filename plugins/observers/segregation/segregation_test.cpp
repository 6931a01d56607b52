#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/testing_observer.hpp"
#include "segregation_observer.hpp"

namespace scree {
namespace {

constexpr BodyClass kA = BodyClass::first, kB = BodyClass::second;

/// Particles at 0.5, 1.5, ... of unit mass; `of(k)` says the class of the k-th.
template <class Of>
std::vector<OnAxis> column(int count, Of&& of) {
  std::vector<OnAxis> particles;
  for (int k = 0; k < count; ++k) particles.push_back({k + 0.5, 1.0, 1.0, 1.0, of(k), 0});
  return particles;
}

// The first class on top of a column of height H: centres half a column apart, whatever the share.
TEST(separation, of_a_parted_column_is_one) {
  AxisProfile axis{0.0, 20.0, 20, 1};
  const Separation up = axis.look(column(20, [](int k) { return k >= 15 ? kA : kB; }));
  EXPECT_DOUBLE_EQ(up.difference, 10.0);
  EXPECT_DOUBLE_EQ(up.index, 1.0);
  EXPECT_DOUBLE_EQ(up.intensity, 1.0);
  const Separation down = axis.look(column(20, [](int k) { return k < 15 ? kA : kB; }));
  EXPECT_DOUBLE_EQ(down.difference, -10.0);
  EXPECT_DOUBLE_EQ(down.index, -1.0);
}

// Alternating pairs A B B A: no net difference, and bins of four hold the same everywhere.
TEST(separation, of_a_regular_mixture_is_none) {
  AxisProfile axis{0.0, 20.0, 5, 1};
  const Separation s = axis.look(column(20, [](int k) { return k % 4 == 0 || k % 4 == 3 ? kA : kB; }));
  EXPECT_NEAR(s.index, 0.0, 1e-15);
  EXPECT_NEAR(s.intensity, 0.0, 1e-15);
}

// A fraction f of the two halves changed places: the index is 1 - 2 f for any bed whose classes are alike along the axis.
TEST(separation, falls_with_what_is_exchanged) {
  AxisProfile axis{0.0, 40.0, 2, 1};
  std::vector<OnAxis> particles = column(40, [](int k) { return k < 20 ? kB : kA; });
  for (const std::size_t k : {0u, 5u, 10u, 15u}) std::swap(particles[k].of, particles[k + 20].of);
  const Separation s = axis.look(particles);
  EXPECT_NEAR(s.index, 1.0 - 2.0 * 0.2, 1e-14);
  EXPECT_NEAR(s.intensity, (1.0 - 2.0 * 0.2) * (1.0 - 2.0 * 0.2), 1e-14);
}

// Law: no arrangement is parted further than 1, with masses and places of any kind.
TEST(separation, never_exceeds_one) {
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  AxisProfile axis{0.0, 1.0, 10, 1};
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<OnAxis> particles;
    for (int k = 0; k < 12; ++k) {
      const double place = uniform(random);
      particles.push_back(
          {place, std::pow(uniform(random), 3), 1.0, 1.0, uniform(random) < 0.3 + 0.5 * place ? kA : kB, 0});
    }
    const Separation s = axis.look(particles);
    if (std::isfinite(s.index)) {
      EXPECT_LE(std::abs(s.index), 1.0 + 1e-12);
    }
  }
}

TEST(separation, knows_how_size_and_density_follow_the_place) {
  AxisProfile axis{0.0, 10.0, 2, 1};
  std::vector<OnAxis> particles = column(10, [](int) { return kA; });
  for (OnAxis& p : particles) {
    p.diameter = 3.0 - 0.1 * p.place;
    p.density = 2.0;
  }
  const Separation s = axis.look(particles);
  EXPECT_NEAR(s.size_correlation, -1.0, 1e-14);
  EXPECT_TRUE(std::isnan(s.density_correlation));
  EXPECT_TRUE(std::isnan(s.index)) << "there is one class only";
}

class SegregationTest : public test::ObserverTest<SegregationObserver> {};

constexpr const char* kScene =
    "classes = {type = 'size', threshold = '3 mm'}\naxis = [0, 0, 2]\nfrom = 0\nto = 1\nbins = 4\n";

TEST_F(SegregationTest, writes_profiles_by_size_density_and_material) {
  const auto observer = make(kScene);
  bodies.add_immovable(0, {0, 0, 0.5});
  bodies.add_sphere(1, {0, 0, 0.1}, 1e-3, 1000.0);
  bodies.add_sphere(2, {0, 0, 0.2}, 2e-3, 1000.0);
  bodies.material.back() = 1;
  bodies.add_sphere(3, {0, 0, 0.9}, 2e-3, 3000.0);
  observer->observe(at(1), services.attributes());
  observer->finish(at(1));
  const auto profile = csv("segregation_profile.csv");
  ASSERT_EQ(profile.size(), 5u);
  EXPECT_EQ(profile[0][7], "share_of_small");
  EXPECT_NEAR(std::stod(profile[1][5]), 3e-3, 1e-15);   // mean diameter
  EXPECT_NEAR(std::stod(profile[1][6]), 1000.0, 1e-9);  // density
  EXPECT_NEAR(std::stod(profile[1][7]), 1.0 / 9.0, 1e-14);
  EXPECT_NEAR(std::stod(profile[1][9]), 8.0 / 9.0, 1e-14);  // steel
  EXPECT_EQ(profile[2][7], "nan");
  EXPECT_NEAR(std::stod(profile[4][6]), 3000.0, 1e-9);
  const auto series = csv("segregation.csv");
  // By mass: small 1 at 0.1; large 8 at 0.2 and 24 at 0.9.
  EXPECT_NEAR(std::stod(series[1][3]), 0.1 - (8 * 0.2 + 24 * 0.9) / 32, 1e-14);
  EXPECT_NEAR(std::stod(series[1][4]), -1.0, 1e-14);
  EXPECT_TRUE(has_figure("segregation"));
  EXPECT_TRUE(has_figure("segregation_profile"));
}

TEST_F(SegregationTest, ends_without_the_share_of_a_material_that_only_walls_have) {
  const auto observer = make(kScene);
  bodies.add_immovable(0, {0, 0, 0.5});
  bodies.material.back() = 1;
  bodies.add_sphere(1, {0, 0, 0.1}, 1e-3, 1000.0);
  observer->observe(at(1), services.attributes());
  observer->finish(at(1));
  const auto profile = csv("segregation_profile.csv");
  EXPECT_EQ(profile.at(0).back(), "share_of_material_glass");
  EXPECT_EQ(std::stod(profile.at(1).back()), 1.0);
}

TEST_F(SegregationTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](SegregationObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      const double h = 0.02 * static_cast<double>(step);
      bodies.add_sphere(100 + step, {0, 0, h}, 1e-3 + 1e-3 * h, 1000.0);
      if (step % 3 == 0) erase(step % 20);
      for (Vec3& place : bodies.position) place.z = std::fmod(place.z * 1.37 + 0.1, 1.0);
      observer.observe(at(step), services.attributes());
    }
  };
  const auto begin = [&] {
    for (BodyId id = 1; id <= 20; ++id) {
      bodies.add_sphere(id, {0, 0, 0.04 * static_cast<double>(id)}, 1e-4 * static_cast<double>(id), 1000.0);
    }
  };
  const std::string scene = "classes = {type = 'side', point = [0, 0, 0.5], normal = [0, 0, 1]}\n";
  expect_checkpoints_to_keep_everything(scene + "axis = [0, 0, 1]\nfrom = 0\nto = 1\ninterval = 0.03", begin, run);
}

TEST_F(SegregationTest, refuses_axes_without_direction_or_length) {
  const std::string classes = "classes = {type = 'size', threshold = '3 mm'}\n";
  EXPECT_NE(refusal(classes + "axis = [0, 0, 0]\nfrom = 0\nto = 1").find("must not be zero"), std::string::npos);
  EXPECT_NE(refusal(classes + "axis = [0, 0, 1]\nfrom = 1\nto = 1").find("must be above from"), std::string::npos);
}

}  // namespace
}  // namespace scree
