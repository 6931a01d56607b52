#include "residence_observer.hpp"

#include <cmath>
#include <random>

#include "analysis/testing_observer.hpp"

namespace scree {
namespace {

TEST(residence, of_plug_flow_has_no_variance) {
  const std::vector<Weighted> times(100, {2.5, 1.0});
  const Residence r = residence_of(times);
  EXPECT_DOUBLE_EQ(r.mean, 2.5);
  EXPECT_EQ(r.variance, 0.0);
  EXPECT_TRUE(std::isinf(r.tanks));
  EXPECT_EQ(r.t50, 2.5);
}

// Three tanks in a row: the sum of three exponential times, mean 3 s and variance 3 s2 for a time constant of 1 s each.
// 40 000 bodies know the mean to 0.3 %, the variance to 1.4 % (its kurtosis is 2): 4 of each.
TEST(residence, of_three_tanks_is_that_of_three_tanks) {
  std::mt19937_64 random{1};
  std::exponential_distribution<double> tank{1.0};
  std::vector<Weighted> times;
  for (int k = 0; k < 40000; ++k) times.push_back({tank(random) + tank(random) + tank(random), 2.0});
  const Residence r = residence_of(times);
  EXPECT_NEAR(r.mean, 3.0, 4 * std::sqrt(3.0 / 40000));
  EXPECT_NEAR(r.error, std::sqrt(3.0 / 40000), 0.05 * r.error);
  EXPECT_NEAR(r.variance, 3.0, 0.06 * 3.0);
  EXPECT_NEAR(r.tanks, 3.0, 0.06 * 3.0);
  EXPECT_NEAR(r.t50, 2.674, 0.04);  // median of the gamma distribution of shape 3
  // The density in bins of 0.5 s against the closed form: at most 6000 in a bin, 1.3 % of it; and the curve bends.
  std::vector<double> edges;
  for (int e = 0; e <= 40; ++e) edges.push_back(0.5 * e);
  const std::vector<double> density = density_of(times, edges);
  for (std::size_t b = 0; b < 12; ++b) {
    EXPECT_NEAR(density[b], tanks_in_series(0.25 + 0.5 * static_cast<double>(b), 3.0, 3.0), 0.012);
  }
}

TEST(residence, tanks_in_series_are_the_exponential_for_one_and_hold_all) {
  EXPECT_NEAR(tanks_in_series(2.0, 4.0, 1.0), std::exp(-0.5) / 4.0, 1e-15);
  double sum = 0.0;
  for (int k = 0; k < 100000; ++k) sum += 1e-4 * tanks_in_series(1e-4 * (k + 0.5), 1.0, 5.5);
  EXPECT_NEAR(sum, 1.0, 1e-7);  // the midpoint rule errs by the squared step; beyond 10 times the mean lies nothing
}

TEST(residence, density_holds_every_stay_once) {
  const std::vector<Weighted> times{{0.0, 1.0}, {0.5, 2.0}, {1.0, 1.0}};
  const std::vector<double> edges{0.0, 0.5, 1.0};
  EXPECT_EQ(density_of(times, edges), (std::vector{0.5, 1.5}));
}

class ResidenceTest : public test::ObserverTest<ResidenceObserver> {
 protected:
  std::size_t add(BodyId id, const Vec3& place, const Vec3& velocity, std::uint32_t material = 0) {
    const std::size_t i = bodies.add(id, Motion::dynamic, place, 1e-3, 1.0, {1, 1, 1}, velocity);
    bodies.material.back() = material;
    return i;
  }
  void move() {
    for (std::size_t i = 0; i < bodies.id.size(); ++i) bodies.position[i] += services.step * bodies.velocity[i];
  }
  [[nodiscard]] double value(const std::string& file, std::size_t row, std::size_t column) const {
    return std::stod(csv(file).at(row).at(column));
  }
};

constexpr const char* kBox = "region = {lower = [0, -1, -1], upper = [1, 1, 1]}\n";

// A body at 4 m/s through a box 1 m long stays 0.25 s, though steps of 0.01 s end at neither border.
TEST_F(ResidenceTest, is_exact_between_steps) {
  const auto observer = make(kBox);
  add(1, {-0.033, 0, 0}, {4, 0, 0});
  add(2, {-0.033, 0, 0}, {400, 0, 0});  // in and out within one step
  add(3, {-0.033, 5, 0}, {4, 0, 0});    // passes by
  add(4, {0.5, 0, 0}, {});              // stays
  for (std::uint64_t step = 1; step <= 40; ++step) {
    move();
    observer->observe(at(step), services.attributes());
  }
  observer->finish(at(40));
  ASSERT_EQ(csv("residence_time_stays.csv").size(), 3u);
  EXPECT_NEAR(value("residence_time_stays.csv", 1, 5), 1.0 / 400, 1e-14);
  EXPECT_NEAR(value("residence_time_stays.csv", 2, 5), 0.25, 1e-14);
  EXPECT_NEAR(value("residence_time_stays.csv", 2, 4), 0.033 / 4, 1e-14);
  EXPECT_EQ(value("residence_time.csv", 1, 1), 2.0) << "two are inside after 0.05 s";
  EXPECT_NE(observer->report().front().title.find("1 bodies inside at the end, the longest for 0.4 s"),
            std::string::npos);
}

TEST_F(ResidenceTest, without_a_region_lasts_from_birth_to_removal) {
  const auto observer = make("");
  add(1, {}, {});
  observer->observe(at(1), services.attributes());  // born at 0
  add(2, {}, {}, 1);                                // born at 0.01 s
  for (std::uint64_t step = 2; step <= 5; ++step) observer->observe(at(step), services.attributes());
  erase(1);  // taken out at the end of step 5
  observer->observe(at(6), services.attributes());
  erase(2);  // taken out at the end of step 6, which nobody looks at any more
  observer->finish(at(6));
  EXPECT_NEAR(value("residence_time_stays.csv", 1, 5), 0.05, 1e-15);
  EXPECT_NEAR(value("residence_time_stays.csv", 2, 5), 0.05, 1e-15);
  const auto rows = observer->report().front().rows;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2][0], "steel");
  EXPECT_EQ(rows[0][1], "2");
}

TEST_F(ResidenceTest, may_leave_out_what_was_there_before) {
  const auto observer = make("count_initial = false");
  add(1, {}, {});
  observer->observe(at(1), services.attributes());
  add(2, {}, {});
  observer->observe(at(2), services.attributes());
  erase(1);
  erase(2);
  observer->observe(at(3), services.attributes());
  EXPECT_EQ(observer->report().front().rows[0][1], "1");
}

// A well-stirred tank: in every step each body leaves with the chance p = 0.05, half a step after the step's begin, and none in
// its first step. The number of steps is geometric: mean (1 / p + 1 / 2) dt, variance (1 - p) / p^2 dt^2, nearly one tank.
// 20 000 bodies know the mean to 0.7 % and the variance to 2 % (kurtosis 9): 4 of each.
TEST_F(ResidenceTest, of_a_stirred_tank_is_one_tank) {
  const auto observer = make("bins = 30\nregion = {lower = [0, -1, -1], upper = [1, 1, 1]}");
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  BodyId next = 1;
  std::uint64_t step = 1;
  for (; step <= 1500; ++step) {
    for (int k = 0; k < 20 && step <= 1000; ++k) add(next++, {0.5, 0, 0}, {});
    for (Vec3& place : bodies.position) {
      if (place.x == 0.5 && uniform(random) < 0.05) place.x = 1.5;
    }
    observer->observe(at(step), services.attributes());
    for (BodyId id = 1; id < next; ++id) {
      const auto i =
          static_cast<std::size_t>(std::lower_bound(bodies.id.begin(), bodies.id.end(), id) - bodies.id.begin());
      if (i < bodies.id.size() && bodies.id[i] == id && bodies.position[i].x > 1.0) erase(id);
    }
  }
  observer->finish(at(step - 1));
  const auto row = observer->report().front().rows[0];
  const double mean = 20.5 * services.step, variance = 380.0 * services.step * services.step;
  EXPECT_NEAR(std::stod(row[2]), mean, 0.027 * mean);
  EXPECT_NEAR(std::stod(row[3]), variance, 0.08 * variance);
  EXPECT_NEAR(std::stod(row[4]), mean * mean / variance, 0.1);
  EXPECT_TRUE(has_figure("residence_time"));
}

TEST_F(ResidenceTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](ResidenceObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      move();
      add(100 + step, {0.01 * static_cast<double>(step), 0, 0}, {static_cast<double>(step % 7) - 3.0, 0, 0}, step % 2);
      if (step % 3 == 0) erase(step % 20);
      observer.observe(at(step), services.attributes());
    }
  };
  const auto begin = [&] {
    for (BodyId id = 1; id <= 20; ++id) add(id, {0.1 * static_cast<double>(id), 0, 0}, {-2.0, 0, 0});
  };
  expect_checkpoints_to_keep_everything(kBox, begin, run);
}

}  // namespace
}  // namespace scree
