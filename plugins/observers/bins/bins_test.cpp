#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "bins_observer.hpp"
#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

// Bodies fall through y = 0 onto 10 bins between x = 0 and x = 1, 1 m deep.
constexpr const char* kBins =
    "origin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nu_bins = 10\nv_bins = 2\nseries_interval = 0.3\n";

/// A rain of bodies: fed above, falling one metre a step, with sinks below and aside.
class Rain {
 public:
  explicit Rain(std::uint64_t seed) : random_{seed} {}

  void feed(int count) {
    for (int i = 0; i < count; ++i) {
      bodies_[next_++] = {{uniform(-0.2, 1.3), uniform(-0.3, 3.0), uniform(-0.2, 1.2)},
                          {uniform(-0.3, 0.3), uniform(-1.5, 0.4), 0},
                          uniform(1e-6, 3e-3),
                          static_cast<std::uint32_t>(next_ % 3)};
      total_fed_ += bodies_[next_ - 1].mass;
    }
  }
  void step() {
    for (auto& [id, body] : bodies_) body.position += body.velocity;
  }
  // Takes some bodies out, wherever they are.
  void sink(double time) {
    removed.clear();
    for (auto body = bodies_.begin(); body != bodies_.end();) {
      const bool low = body->second.position.y < -2.0, unlucky = uniform(0, 1) < 0.02;
      if (low || unlucky) {
        const auto& b = body->second;
        removed.push_back({body->first, b.material, b.mass, time, b.position, low ? "floor" : "chance", "gone"});
        body = bodies_.erase(body);
      } else {
        ++body;
      }
    }
  }
  [[nodiscard]] test::TestBodies bodies(Attributes& attributes) const {
    test::TestBodies columns{attributes};
    columns.add_immovable(0, {0.5, -5, 0.5});
    for (const auto& [id, body] : bodies_) {
      columns.add(id, Motion::dynamic, body.position, 1e-3, body.mass, {1, 1, 1}, body.velocity);
      columns.material.back() = body.material;
    }
    return columns;
  }
  /// [kg]
  [[nodiscard]] double total_fed() const { return total_fed_; }

  std::vector<RemovedBody> removed;

 private:
  struct Body {
    Vec3 position, velocity;
    double mass;
    std::uint32_t material;
  };
  double uniform(double low, double high) { return std::uniform_real_distribution<double>{low, high}(random_); }
  std::mt19937_64 random_;
  std::map<BodyId, Body> bodies_;
  BodyId next_ = 1;
  double total_fed_ = 0.0;
};

std::vector<std::vector<std::string>> read_csv(const fs::path& file) {
  std::ifstream in{file};
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells{line};
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class BinsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_bins_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* name : {"copper", "plastic", "mixed"}) services.materials().add({name, 1000.0, {}, {}});
    services.step = 0.1;
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  [[nodiscard]] std::unique_ptr<BinsObserver> make(const std::string& more = "", bool writes = true) {
    auto observer = std::make_unique<BinsObserver>(options_from_text(kBins + more, BinsObserver::parameters()));
    observer->setup(services, writes ? folder : fs::path{});
    return observer;
  }
  [[nodiscard]] Observation at(std::uint64_t step, const test::TestBodies& bodies,
                               std::span<const RemovedBody> removed = {}) const {
    return {bodies.view(), {}, removed, 0.1 * static_cast<double>(step), 0.1, step};
  }
  [[nodiscard]] double column(std::size_t body) {
    return services.attributes().column(services.attributes().id("bin_bins"))[body];
  }
  // Observes `steps` steps of rain from `first` on; the bodies taken out after one step are seen at the next.
  void rain(BinsObserver& observer, Rain& rain, std::uint64_t first, std::uint64_t steps) {
    for (std::uint64_t step = first; step < first + steps; ++step) {
      rain.feed(5);
      rain.step();
      const test::TestBodies bodies = rain.bodies(services.attributes());
      observer.observe(at(step, bodies, rain.removed), services.attributes());
      rain.sink(0.1 * static_cast<double>(step));
    }
  }

  fs::path folder;
  test::FakeSceneServices services;
};

TEST_F(BinsTest, put_a_known_trajectory_into_its_bin_once) {
  const auto observer = make();
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {0.31, 1.0, 0.6}, 1e-3, 1000.0);  // crosses at x = 0.335: bin 3 of row 1
  bodies.add_sphere(2, {0.99, 0.5, 0.2}, 1e-3, 1000.0);  // crosses at x = 1.015: outside
  bodies.add_sphere(3, {0.15, 2.0, 0.2}, 1e-3, 1000.0);  // stays above
  observer->observe(at(0, bodies), services.attributes());
  EXPECT_EQ(column(0), 0.0);
  bodies.position[0] = {0.36, -1.0, 0.6};
  bodies.position[1] = {1.04, -0.5, 0.2};
  observer->observe(at(1, bodies), services.attributes());
  EXPECT_EQ(column(0), 1 * 10 + 3 + 1.0);
  EXPECT_EQ(column(1), -1.0);
  EXPECT_EQ(column(2), 0.0);
  bodies.position[0] = {0.86, 1.0, 0.6};  // thrown up again through another bin: it is counted already
  observer->observe(at(2, bodies), services.attributes());
  EXPECT_EQ(column(0), 14.0);
  const auto ledger = observer->report().front();
  EXPECT_EQ(ledger.rows.back()[1], "3");  // fed
  EXPECT_EQ(ledger.rows.back()[2], "2");  // in flight
  EXPECT_EQ(ledger.rows.back()[4], "1");  // collected
}

TEST_F(BinsTest, see_a_body_that_crosses_in_the_step_it_was_fed_in) {
  const auto observer = make();
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {0.55, -0.1, 0.5}, 1e-3, 1000.0, {0, -2.0, 0});  // it came from y = 0.1
  observer->observe(at(1, bodies), services.attributes());
  EXPECT_EQ(column(0), 16.0);
}

// Numbers exactly and masses to rounding, for every category, and against an independent count of the rain.
TEST_F(BinsTest, account_for_everything_in_any_rain) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto observer = make("target = [{name = 'metal', materials = ['copper', 'mixed']}]");
    Rain drops{seed};
    rain(*observer, drops, 1, 60);
    const test::TestBodies left = drops.bodies(services.attributes());
    observer->finish(at(60, left, drops.removed));
    const auto ledger = read_csv(folder / "bins_bins_ledger.csv");
    ASSERT_EQ(ledger.size(), 6u);  // header, three materials, a target, all
    for (std::size_t r = 1; r < ledger.size(); ++r) {
      const auto number = [&](std::size_t c) { return std::stoul(ledger[r][c]); };
      const auto mass = [&](std::size_t c) { return std::stod(ledger[r][c]); };
      EXPECT_EQ(number(1), number(2) + number(3) + number(4)) << ledger[r][0];
      // 300 terms, each sum rounded once: 300 times half a unit in the last place of the total.
      EXPECT_NEAR(mass(5), mass(6) + mass(7) + mass(8), 300 * 1.2e-16 * mass(5)) << ledger[r][0];
      EXPECT_GT(number(4), 0u) << ledger[r][0] << ": the test should collect something of everything";
      EXPECT_GT(number(3), 0u) << ledger[r][0] << ": and lose something";
    }
    EXPECT_EQ(ledger[5][1], "300");  // 60 steps of 5
    EXPECT_NEAR(std::stod(ledger[5][5]), drops.total_fed(), 300 * 1.2e-16 * drops.total_fed());
    EXPECT_EQ(std::stoul(ledger[4][1]), std::stoul(ledger[1][1]) + std::stoul(ledger[3][1]));
  }
}

TEST_F(BinsTest, tables_close_with_the_ledger_and_with_the_time_series) {
  const auto observer = make();
  Rain drops{3};
  rain(*observer, drops, 1, 50);
  const test::TestBodies left = drops.bodies(services.attributes());
  observer->finish(at(50, left, drops.removed));
  const auto table = read_csv(folder / "bins_bins.csv");
  const auto series = read_csv(folder / "bins_bins_series.csv");
  ASSERT_EQ(table.size(), 21u);
  EXPECT_EQ(table[0][1], "u_lower [m]");
  EXPECT_EQ(table[0][9], "mass_copper [kg]");
  EXPECT_EQ(series[0], (std::vector<std::string>{"time [s]", "material", "bin", "number", "mass [kg]"}));
  const auto ledger = observer->report().front();
  const std::vector<std::string> names{"copper", "plastic", "mixed", "all"};
  for (std::size_t c = 0; c < names.size(); ++c) {
    for (std::size_t bin = 0; bin < 20; ++bin) {
      std::uint64_t number = 0;
      double mass = 0.0;
      for (const auto& row : series) {
        if (row[1] != names[c] || row[2] != std::to_string(bin)) continue;
        number += std::stoul(row[3]);
        mass += std::stod(row[4]);
      }
      EXPECT_EQ(std::to_string(number), table[bin + 1][8 + 2 * c]);
      EXPECT_NEAR(mass, std::stod(table[bin + 1][9 + 2 * c]), 1e-15);  // about ten terms of at most 3e-3 kg
    }
    std::uint64_t collected = 0;
    for (std::size_t bin = 0; bin < 20; ++bin) collected += std::stoul(table[bin + 1][8 + 2 * c]);
    EXPECT_EQ(std::to_string(collected), ledger.rows[c][4]);
  }
}

TEST_F(BinsTest, go_on_from_a_checkpoint_as_if_there_had_been_none) {
  const auto whole = make("", false);
  Rain drops{5}, same_drops{5};
  rain(*whole, drops, 1, 40);
  whole->finish(at(40, drops.bodies(services.attributes()), drops.removed));

  const auto first = make();
  rain(*first, same_drops, 1, 20);
  MemoryState saved;
  first->save(saved.writer());
  const auto second = make();
  second->load(saved.reader());
  rain(*second, same_drops, 21, 20);
  second->finish(at(40, same_drops.bodies(services.attributes()), same_drops.removed));

  const auto expected = whole->report(), found = second->report();
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t t = 0; t < expected.size(); ++t) EXPECT_EQ(expected[t].rows, found[t].rows) << expected[t].title;
  const auto series = read_csv(folder / "bins_bins_series.csv");
  EXPECT_LT(std::stod(series[1][0]), 2.0) << "rows from before the checkpoint are kept";
}

// A checkpoint may lie after the end of a run has been reported: the removals told then are told once more.
TEST_F(BinsTest, count_a_removal_once_however_often_they_hear_of_it) {
  const auto observer = make("", false);
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(7, {0.5, 1, 0.5}, 1e-3, 1000.0);
  observer->observe(at(1, bodies), services.attributes());
  const test::TestBodies none{services.attributes()};
  const std::vector<RemovedBody> gone{{7, 0, bodies.mass[0], 0.1, {}, "floor", "fell"},
                                      {8, 0, bodies.mass[0], 0.1, {}, "floor", "fell"}};  // 8 was never seen
  for (std::uint64_t step = 2; step < 5; ++step) observer->observe(at(step, none, gone), services.attributes());
  const auto ledger = observer->report().front();
  EXPECT_EQ(ledger.rows.back()[1], "2");
  EXPECT_EQ(ledger.rows.back()[3], "2");
}

TEST_F(BinsTest, divide_at_the_splitter_and_judge_the_products) {
  const auto observer =
      make("splitters = ['55 cm']\nproducts = ['light', 'heavy']\nproduct_targets = ['plastic', 'copper']\n", false);
  test::TestBodies bodies{services.attributes()};
  const std::vector<std::pair<double, std::uint32_t>> drops{{0.05, 1}, {0.25, 1}, {0.54, 0}, {0.56, 0}, {0.95, 0}};
  for (std::size_t i = 0; i < drops.size(); ++i) {
    bodies.add(i + 1, Motion::dynamic, {drops[i].first, 1, 0.5}, 1e-3, 2.0, {1, 1, 1}, {});
    bodies.material.back() = drops[i].second;
  }
  observer->observe(at(0, bodies), services.attributes());
  for (Vec3& p : bodies.position) p.y = -1;
  observer->observe(at(1, bodies), services.attributes());
  observer->finish(at(1, bodies));
  const auto tables = observer->report();
  ASSERT_EQ(tables.size(), 3u);
  const auto& products = tables[1];
  // light: 2 plastic and 1 copper of 2 kg each; heavy: 2 copper.
  EXPECT_EQ(products.rows[0],
            (std::vector<std::string>{"light", "0", "0.55", "6", "2", "33.33", "33.33", "4", "66.67", "100.00"}));
  EXPECT_EQ(products.rows[1],
            (std::vector<std::string>{"heavy", "0.55", "1", "4", "4", "100.00", "66.67", "0", "0.00", "0.00"}));
  // A splitter at an edge of a bin between 0.3 and 0.5 parts them perfectly.
  const auto& best = tables[2].rows.front();
  EXPECT_EQ(best[0], "plastic | copper");
  EXPECT_GE(std::stod(best[1]), 0.3);
  EXPECT_LE(std::stod(best[1]), 0.5);
  EXPECT_EQ(best[3], "100.00");
}

TEST_F(BinsTest, targets_may_depend_on_an_attribute_at_first_sight) {
  const auto observer =
      make("target = [{name = 'rich', materials = ['mixed'], attribute = 'metal_fraction', at_least = 0.4}]", false);
  test::TestBodies bodies{services.attributes()};
  for (BodyId i = 0; i < 4; ++i) {
    bodies.add_sphere(i + 1, {0.5, 1, 0.5}, 1e-3, 1000.0);
    bodies.material.back() = i == 3 ? 0 : 2;
    services.attributes().column(services.attributes().id("metal_fraction")).back() = 0.3 * static_cast<double>(i);
  }
  observer->observe(at(0, bodies), services.attributes());
  const auto ledger = observer->report().front();
  EXPECT_EQ(ledger.rows[2][0], "rich");
  EXPECT_EQ(ledger.rows[2][1], "1") << "0.6 of three mixed ones; copper does not belong whatever its fraction";
}

TEST_F(BinsTest, may_have_a_material_as_target_under_its_own_name) {
  const auto observer = make("target = [{name = 'plastic', materials = ['plastic']}]", false);
  Rain drops{2};
  rain(*observer, drops, 1, 50);
  observer->finish(at(50, drops.bodies(services.attributes()), drops.removed));
  const auto tables = observer->report();
  EXPECT_EQ(tables[0].rows.size(), 4u);  // three materials and all: the target is no row of its own
  const ReportTable& products = tables[2];
  EXPECT_EQ(products.header.size(), 7u) << "only the target is judged";
  EXPECT_EQ(products.header[5], "plastic grade [%]");
}

TEST_F(BinsTest, write_a_figure_of_the_output) {
  const auto observer = make("splitters = [0.3, 0.7]\nproducts = ['plastic', 'middlings', 'metal']\n");
  Rain drops{11};
  rain(*observer, drops, 1, 200);
  observer->finish(at(200, drops.bodies(services.attributes()), drops.removed));
  EXPECT_GT(fs::file_size(folder / "bins_bins.png"), 1000u);
  EXPECT_GT(fs::file_size(folder / "bins_bins.svg"), 1000u);
  if (const char* keep = std::getenv("SCREE_KEEP_FIGURE")) {
    fs::copy_file(folder / "bins_bins.png", keep, fs::copy_options::overwrite_existing);
  }
}

TEST_F(BinsTest, refuse_what_cannot_be_counted_in_one_sentence) {
  const auto said = [&](const std::string& more) -> std::string {
    try {
      (void)make(more, false);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(said("splitters = [0.7, 0.3]").find("must ascend"), std::string::npos);
  EXPECT_NE(said("splitters = [1.5]").find("between 0 and 1 m"), std::string::npos);
  EXPECT_NE(said("products = ['a', 'b']").find("has 2 names"), std::string::npos);
  EXPECT_NE(said("product_targets = ['gold']").find("'gold'"), std::string::npos);
  EXPECT_NE(said("target = [{name = 'copper', materials = ['mixed']}]").find("names must differ"), std::string::npos);
  EXPECT_NE(said("target = [{name = 'x'}]").find("needs `materials`"), std::string::npos);
}

}  // namespace
}  // namespace scree
