#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <random>

#include "analysis/testing_observer.hpp"
#include "mixing_observer.hpp"

namespace scree {
namespace {

constexpr const char* kScene =
    "classes = {type = 'side', point = [0, 0, 0.5], normal = [0, 0, 1]}\n"
    "grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [4, 4, 4]}\ninterval = 0.1\n";

class MixingTest : public test::ObserverTest<MixingObserver> {
 protected:
  // Spheres in a box, in two halves; from then on each jumps to a random place at the rate 1 / `time_constant`.
  void start(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) bodies.add_sphere(i + 1, place(), 0.01, 1000.0);
  }
  Vec3 place() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  void jump(double chance) {
    for (Vec3& position : bodies.position) {
      if (uniform_(random_) < chance) position = place();
    }
  }
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

// Each sphere keeps its first place with the chance q = exp(-t / tau). With n particles a cell the variance is then
// (q^2 + (1 - q^2) / n) / 4, and 1 - M = q^2 = exp(-2 t / tau). Of 40 000 spheres the share q is known to about 1 % while it
// matters: 5 % on the time constant.
TEST_F(MixingTest, finds_the_rate_at_which_particles_jump) {
  const auto observer = make(std::string{kScene} + "neighbours = {type = 'none'}");
  start(40000);
  constexpr double kTau = 1.0;
  for (std::uint64_t step = 1; step <= 300; ++step) {
    observer->observe(at(step), services.attributes());
    jump(1.0 - std::exp(-services.step / kTau));
  }
  const ReportTable table = observer->report().front();
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_NEAR(std::stod(table.rows[0][1]), 0.0, 1e-12) << "no cell is cut by the plane";
  EXPECT_NEAR(std::stod(table.rows[0][2]), 1.0, 0.02);
  EXPECT_NEAR(std::stod(table.rows[0][4]), 0.5 * kTau, 0.05 * 0.5 * kTau);
}

TEST_F(MixingTest, writes_a_table_and_a_figure) {
  const auto observer = make(kScene);
  start(2000);
  for (std::uint64_t step = 1; step <= 295; ++step) {
    observer->observe(at(step), services.attributes());
    jump(0.02);
  }
  observer->finish(at(295));
  const auto rows = csv("mixing.csv");
  EXPECT_EQ(rows[0][0], "time [s]");
  EXPECT_EQ(rows[0][1], "lacey_index");
  ASSERT_EQ(rows.size(), 1u + 1u + 29u + 1u) << "header, the first step, every tenth, the end";
  EXPECT_EQ(rows[31][11], "2000");
  EXPECT_EQ(rows[31][10], "12");
  // By neighbours the plane's own bonds count: of 2000 in a unit cube a ball of 12 has the radius 0.11 and a tenth of all
  // spheres lie so near to the plane.
  EXPECT_LT(std::stod(rows[1][9]), 0.2);
  EXPECT_NEAR(std::stod(rows[31][9]), 1.0, 0.05);
  EXPECT_TRUE(has_figure("mixing"));
}

TEST_F(MixingTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](MixingObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      random_.seed(step);
      jump(0.05);
      bodies.add_sphere(1000 + step, place(), 0.01, 1000.0);
      if (step % 3 == 0) erase(step % 50);
      observer.observe(at(step), services.attributes());
    }
  };
  const auto begin = [&] {
    random_.seed(0);
    start(500);
  };
  expect_checkpoints_to_keep_everything(kScene, begin, run);
}

TEST_F(MixingTest, refuses_a_window_that_ends_before_it_begins) {
  EXPECT_NE(refusal(std::string{kScene} + "fit_from = 1.0\nfit_to = 0.5").find("later than fit_from"),
            std::string::npos);
  EXPECT_NE(refusal("classes = {type = 'side', normal = [0, 0, 1]}").find("grid"), std::string::npos);
}

}  // namespace
}  // namespace scree
