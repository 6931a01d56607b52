#include <cmath>
#include <random>

#include "analysis/testing_observer.hpp"
#include "mass_flow_observer.hpp"

namespace scree {
namespace {

constexpr const char* kFalling = "gate = {type = 'plane', point = [0, 0, 0], normal = [0, 0, -1]}\ninterval = 0.1\n";

class MassFlowTest : public test::ObserverTest<MassFlowObserver> {
 protected:
  // Every body moves on by its velocity.
  void move() {
    for (std::size_t i = 0; i < bodies.id.size(); ++i) bodies.position[i] += services.step * bodies.velocity[i];
  }
  std::size_t add(BodyId id, const Vec3& place, const Vec3& velocity, double mass, std::uint32_t material = 0) {
    const std::size_t i = bodies.add(id, Motion::dynamic, place, 1e-3, mass, {1, 1, 1}, velocity);
    bodies.material.back() = material;
    return i;
  }
};

TEST_F(MassFlowTest, counts_both_ways_by_material_and_knows_when) {
  const auto observer = make(std::string{kFalling} + "crossings = true");
  bodies.add_immovable(0, {0, 0, -1});
  add(1, {0, 0, 0.025}, {0, 0, -1}, 2.0);     // down at 0.025 s
  add(2, {0, 0, -0.035}, {1, 0, 1}, 3.0, 1);  // up at 0.035 s, at x = 0.035
  add(3, {0, 0, 1.0}, {0, 0, -1}, 5.0);       // not within the run
  for (std::uint64_t step = 1; step <= 20; ++step) {
    move();
    observer->observe(at(step), services.attributes());
  }
  observer->finish(at(20));
  const auto rows = csv("mass_flow.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0][6], "mass_rate [kg/s]");
  EXPECT_EQ(rows[0][9], "mass_steel [kg]");
  const auto value = [&](std::size_t row, std::size_t column) { return std::stod(rows[row][column]); };
  EXPECT_EQ(value(1, 2), 1.0);             // forward
  EXPECT_EQ(value(1, 3), 1.0);             // backward
  EXPECT_NEAR(value(1, 6), -10.0, 1e-12);  // (2 - 3) kg in 0.1 s
  EXPECT_NEAR(value(1, 8), 20.0, 1e-12);   // glass
  EXPECT_EQ(value(2, 9), -3.0);            // steel, up to now
  EXPECT_EQ(value(2, 6), 0.0);
  const auto crossings = csv("mass_flow_crossings.csv");
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_NEAR(std::stod(crossings[1][0]), 0.025, 1e-15);
  EXPECT_EQ(crossings[1][2], "glass");
  EXPECT_EQ(crossings[2][3], "backward");
  EXPECT_NEAR(std::stod(crossings[2][0]), 0.035, 1e-15);
  EXPECT_NEAR(std::stod(crossings[2][4]), 0.035, 1e-15);
  EXPECT_TRUE(has_figure("mass_flow"));
  EXPECT_TRUE(has_figure("mass_flow_total"));
}

// A wall of steel has no column; steel that was fed and is gone again, without passing the gate, has one.
TEST_F(MassFlowTest, ends_without_columns_of_materials_that_only_walls_have) {
  bodies.add_immovable(0, {0, 0, -1});
  bodies.material.back() = 1;
  add(1, {0, 0, 0.025}, {0, 0, -1}, 2.0);
  for (const bool steel_is_fed : {false, true}) {
    const auto observer = make(kFalling);
    if (steel_is_fed) add(2, {0, 0, 1.0}, {0, 0, 0}, 3.0, 1);
    observer->observe(at(1), services.attributes());
    if (steel_is_fed) erase(2);
    observer->observe(at(2), services.attributes());
    observer->finish(at(2));
    const std::string last = csv("mass_flow.csv").at(0).back();
    EXPECT_EQ(last, steel_is_fed ? "mass_rate_steel [kg/s]" : "mass_rate_glass [kg/s]");
    EXPECT_EQ(csv("mass_flow.csv").at(1).size(), csv("mass_flow.csv").at(0).size());
  }
}

// A body fed at the begin of a step that crosses within that step was not seen before it crossed.
TEST_F(MassFlowTest, sees_what_crosses_in_the_step_it_was_fed_in) {
  const auto observer = make(kFalling);
  add(1, {0, 0, -0.005}, {0, 0, -1}, 2.0);  // born at z = 0.005
  observer->observe(at(1), services.attributes());
  EXPECT_EQ(observer->report().front().rows.back()[1], "1");
}

// The gate is the mouth of a bucket that falls beside the grain: seen from it, the grain rises.
TEST_F(MassFlowTest, goes_along_with_a_body) {
  services.add_body("bucket", {0, {}, ""});
  const auto observer = make(std::string{kFalling} + "frame = 'bucket'");
  bodies.add_immovable(0, {0, 0, 0});
  add(1, {0, 0, -0.05}, {}, 2.0);
  for (std::uint64_t step = 1; step <= 10; ++step) {
    bodies.position[0].z = -0.01 * static_cast<double>(step);
    observer->observe(at(step), services.attributes());
  }
  EXPECT_EQ(observer->report().front().rows.back()[2], "1");
}

// Poisson arrivals of 1000 grains of 1 g a second on average: the interval of 95 % has to hold 1 kg/s in about 95 of 100
// runs; the chance that it does in fewer than 87 is below 1 in 1000.
TEST_F(MassFlowTest, finds_a_constant_rate_with_its_confidence) {
  int held = 0;
  double width = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto observer = make(kFalling, "");
    bodies = test::TestBodies{services.attributes()};
    std::mt19937_64 random{seed};
    std::poisson_distribution<int> arrivals{10.0};  // in a step of 0.01 s
    BodyId next = 1;
    for (std::uint64_t step = 1; step <= 200; ++step) {
      bodies = test::TestBodies{services.attributes()};
      for (int k = arrivals(random); k > 0; --k) add(next++, {0, 0, -0.001}, {0, 0, -1}, 1e-3);
      observer->observe(at(step), services.attributes());
    }
    const std::string rate = observer->report().front().rows.back()[5];
    const double value = std::stod(rate), error = std::stod(rate.substr(rate.find("+-") + 2));
    held += std::abs(value - 1.0) <= error ? 1 : 0;
    width += error / 100.0;
  }
  EXPECT_GE(held, 87);
  // t_9(95 %) sqrt(rate mass / time) = 2.262 sqrt(1 x 1e-3 / 2): the mean of the widths within 10 %.
  EXPECT_NEAR(width, 2.262 * std::sqrt(0.5e-3), 0.1 * 2.262 * std::sqrt(0.5e-3));
}

TEST_F(MassFlowTest, uses_the_window_of_the_fit_only) {
  const auto observer = make(std::string{kFalling} + "fit_from = 0.5\nfit_to = 1.5\nblocks = 5");
  BodyId next = 1;
  for (std::uint64_t step = 1; step <= 200; ++step) {
    bodies = test::TestBodies{services.attributes()};
    const int count = step <= 50 || step > 150 ? 7 : 2;  // grains of 1 kg in 0.01 s
    for (int k = 0; k < count; ++k) add(next++, {0, 0, -0.001}, {0, 0, -1}, 1.0);
    observer->observe(at(step), services.attributes());
  }
  const auto row = observer->report().front().rows.back();
  EXPECT_EQ(row[5].substr(0, 6), "200 +-");
  EXPECT_EQ(row[7], "0.5 to 1.5");
  EXPECT_EQ(row[8], "5");
}

TEST_F(MassFlowTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](MassFlowObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      move();
      std::mt19937_64 random{step};
      std::uniform_real_distribution<double> speed{-3.0, 3.0};
      add(100 + step, {0, 0, 0.1 * speed(random)}, {0, 0, speed(random)}, 0.1, step % 2);
      if (step % 3 == 0) erase(step % 20);
      observer.observe(at(step), services.attributes());
    }
  };
  const auto begin = [&] {
    for (BodyId id = 1; id <= 20; ++id) add(id, {0, 0, 0.01 * static_cast<double>(id)}, {0, 0, -1.0}, 1.0 / 3.0);
  };
  expect_checkpoints_to_keep_everything(std::string{kFalling} + "crossings = true", begin, run);
}

// A run that goes on may have an observer that the part before had not: its first interval begins where it began to look.
TEST_F(MassFlowTest, takes_its_first_rate_from_where_it_began_to_look) {
  const auto observer = make(kFalling);
  for (std::uint64_t step = 106; step <= 110; ++step) {
    bodies = test::TestBodies{services.attributes()};
    add(step, {0, 0, -0.001}, {0, 0, -1}, 0.5);
    observer->observe(at(step), services.attributes());
  }
  const auto rows = csv("mass_flow.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(std::stod(rows[1][1]), 1.05, 1e-12);
  EXPECT_NEAR(std::stod(rows[1][6]), 50.0, 1e-9);  // 0.5 kg in every step of 0.01 s
}

TEST_F(MassFlowTest, says_why_there_is_no_constant_rate) {
  services.end = 0.2;
  const auto observer = make(std::string{kFalling} + "fit_from = 100.0");
  for (std::uint64_t step = 1; step <= 20; ++step) observer->observe(at(step), services.attributes());
  observer->finish(at(20));
  ASSERT_EQ(services.log_lines().size(), 1u);
  EXPECT_NE(services.log_lines()[0].find("fit_from = 100 s is not before the end of the run at 0.2 s"),
            std::string::npos);
  const ReportTable table = observer->report().front();
  EXPECT_NE(table.title.find("no constant rate"), std::string::npos) << table.title;
  EXPECT_EQ(table.rows.back()[7], "none");
}

// The error of a mean needs two values.
TEST_F(MassFlowTest, a_single_interval_gives_no_constant_rate) {
  for (const std::uint64_t steps : {10U, 20U}) {  // ten an interval
    const auto observer = make(kFalling, "");
    for (std::uint64_t step = 1; step <= steps; ++step) observer->observe(at(step), services.attributes());
    observer->finish(at(steps));
    const ReportTable table = observer->report().front();
    EXPECT_EQ(table.title.find("no constant rate: a single interval") != std::string::npos, steps == 10) << table.title;
    EXPECT_EQ(table.rows.back()[5], steps == 10 ? "none" : "0 +- 0");
    for (const std::string& cell : table.rows.back()) EXPECT_EQ(cell.find("nan"), std::string::npos) << cell;
  }
}

TEST_F(MassFlowTest, refuses_a_window_that_ends_before_it_begins) {
  EXPECT_NE(refusal(std::string{kFalling} + "fit_from = 1.0\nfit_to = 0.5").find("later than fit_from"),
            std::string::npos);
}

}  // namespace
}  // namespace scree
