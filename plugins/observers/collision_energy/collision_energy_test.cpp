// Collisions against mechanics, from contacts written by hand: a floor (id 0) and balls.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "collision_energy.hpp"
#include "scree/config/validate.hpp"
#include "scree/model/material.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

class CollisionEnergyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_collisions_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "second");
    for (const char* name : {"floor", "glass", "steel"}) services.materials().add({name, 2500.0, {}, {}});
    services.set_part_name("collision_energy");
    bodies.add_immovable(0, {});
    for (BodyId k = 1; k < 3; ++k) {
      bodies.add_sphere(k, {0, 0, static_cast<double>(k)}, 0.01, 2500.0);
      bodies.material.back() = static_cast<std::uint32_t>(k);
    }
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  [[nodiscard]] std::unique_ptr<CollisionEnergy> make(const std::string& options, const fs::path& results = {}) {
    auto part = std::make_unique<CollisionEnergy>(options_from_text(options, CollisionEnergy::parameters()));
    part->setup(services, results);
    return part;
  }
  /// Impulse and velocities in the contact frame [N s], [m/s].
  void touch(BodyIndex a, BodyIndex b, const Vec3& impulse, const Vec3& before, const Vec3& after,
             std::uint64_t feature = 0) {
    contact.push_back({a, b, 0, 0, feature, {}, {0, 0, 1}, 0.0});
    impulses.push_back(impulse);
    befores.push_back(before);
    afters.push_back(after);
  }
  /// `works`: what a stepper says that contacts took [J].
  void look(CollisionEnergy& part, std::uint64_t step, const std::vector<double>& works = {}) {
    ContactView seen{contact, impulses, befores, afters};
    seen.work = works;
    part.observe({bodies.view(), seen, {}, 1e-3 * static_cast<double>(step), 1e-3, step}, services.attributes());
    contact.clear();
    impulses.clear();
    befores.clear();
    afters.clear();
  }
  void finish(CollisionEnergy& part, std::uint64_t step) {
    part.finish({bodies.view(), {}, {}, 1e-3 * static_cast<double>(step), 1e-3, step});
  }
  [[nodiscard]] std::string read(const fs::path& name) const {
    std::ifstream in{folder / name};
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  std::vector<Contact> contact;
  std::vector<Vec3> impulses, befores, afters;
};

const PairSpectra& pair_of(const CollisionEnergy& part, const std::string& name) {
  for (const PairSpectra& pair : part.spectra().pairs()) {
    if (pair.name == name) return pair;
  }
  throw std::out_of_range{name};
}

// Dropped from 1 m with restitution 0.6: m g h at the first bounce, e^2 of it at the next; each takes 1 - e^2 of its own.
TEST_F(CollisionEnergyTest, bounces_of_a_ball_fall_into_their_bins) {
  const auto part = make("");
  const double m = bodies.mass[1], e = 0.6, g = 9.81;
  double v = std::sqrt(2.0 * g);
  std::uint64_t step = 0;
  for (int bounce = 0; bounce < 3; ++bounce) {
    touch(0, 1, {m * v * (1 + e), 0, 0}, {-v, 0, 0}, {e * v, 0, 0});
    look(*part, ++step);
    look(*part, ++step);
    v *= e;
  }
  const PairSpectra& pair = pair_of(*part, "floor - glass");
  EXPECT_EQ(pair.normal.total_count(), 3u);
  EXPECT_NEAR(pair.normal.total_weight(), m * g * (1 + e * e + std::pow(e, 4)), 1e-14);
  EXPECT_NEAR(pair.dissipated.total_weight(), m * g * (1 - std::pow(e, 6)), 1e-14);
  for (const double energy : {m * g, m * g * e * e, m * g * std::pow(e, 4)}) {
    std::size_t k = 0;
    while (pair.normal.edges()[k + 1] <= energy) ++k;
    EXPECT_EQ(pair.normal.count(k), 1u) << energy;
  }
  EXPECT_EQ(pair_of(*part, "glass - steel").normal.total_count(), 0u);
}

// Two free bodies: the effective mass; a slip that friction takes: the tangential part.
TEST_F(CollisionEnergyTest, free_bodies_collide_with_their_effective_mass) {
  const auto part = make("");
  bodies.mass[2] = 3.0 * bodies.mass[1];
  const double m = 0.75 * bodies.mass[1];
  touch(1, 2, {2.0 * m, 0.4 * m, 0}, {-2, -1, 0}, {0, -0.5, 0});
  look(*part, 1);
  look(*part, 2);
  const PairSpectra& pair = pair_of(*part, "glass - steel");
  EXPECT_NEAR(pair.normal.total_weight(), 2.0 * m, 1e-15);
  EXPECT_NEAR(pair.tangential.total_weight(), 0.5 * m, 1e-15);
  EXPECT_NEAR(pair.dissipated.total_weight(), 2.0 * m * 1.0 + 0.4 * m * 0.75, 1e-15);
}

// A contact of three steps (a soft one) is one collision with all that it took; resting contacts are none.
TEST_F(CollisionEnergyTest, a_collision_lasts_from_the_first_to_the_last_loaded_step) {
  const auto part = make("");
  const double m = bodies.mass[1];
  touch(0, 1, {0.5 * m, 0, 0}, {-1, 0, 0}, {-0.5, 0, 0});
  touch(0, 2, {1e-3, 0, 0}, {-0.01, 0, 0}, {});
  look(*part, 1);
  touch(0, 1, {1.0 * m, 0, 0}, {-0.5, 0, 0}, {0.5, 0, 0});
  touch(0, 2, {1e-3, 0, 0}, {-0.01, 0, 0}, {});
  look(*part, 2);
  touch(0, 1, {0.2 * m, 0, 0}, {0.5, 0, 0}, {0.7, 0, 0});
  look(*part, 3);
  look(*part, 4);
  const PairSpectra& pair = pair_of(*part, "floor - glass");
  EXPECT_EQ(pair.normal.total_count(), 1u);
  EXPECT_NEAR(pair.normal.total_weight(), 0.5 * m, 1e-15);
  EXPECT_NEAR(pair.dissipated.total_weight(), m * 0.5 * (1.0 - 0.49), 1e-15);
  EXPECT_EQ(pair_of(*part, "floor - steel").normal.total_count(), 0u);
}

// A stepper of many short steps knows what a contact took; velocities at the ends of a whole step do not tell.
TEST_F(CollisionEnergyTest, what_a_stepper_has_summed_up_is_what_is_dissipated) {
  const auto part = make("min_speed = 0.0");
  const double m = bodies.mass[1];
  touch(0, 1, {1.5 * m, 0, 0}, {-1, 0, 0}, {0.5, 0, 0});
  look(*part, 1, {0.375 * m});
  look(*part, 2);
  EXPECT_DOUBLE_EQ(pair_of(*part, "floor - glass").dissipated.total_weight(), 0.375 * m);
}

// A neck that pulls a ball in, presses it and holds it back is one collision, from the pull on: at 0.1 m/s.
TEST_F(CollisionEnergyTest, steps_in_which_a_contact_pulls_are_of_its_collision) {
  const auto part = make("min_speed = 0.05");
  const double m = bodies.mass[1], v = 0.1;
  touch(0, 1, {-0.1 * m * v, 0, 0}, {-v, 0, 0}, {-1.1 * v, 0, 0});
  look(*part, 1, {-1e-6});
  touch(0, 1, {2.2 * m * v, 0, 0}, {-1.1 * v, 0, 0}, {1.1 * v, 0, 0});
  look(*part, 2, {2e-7});
  touch(0, 1, {-0.3 * m * v, 0, 0}, {1.1 * v, 0, 0}, {0.8 * v, 0, 0});
  look(*part, 3, {4e-6});
  look(*part, 4);
  const PairSpectra& pair = pair_of(*part, "floor - glass");
  EXPECT_EQ(pair.normal.total_count(), 1u);
  EXPECT_NEAR(pair.normal.total_weight(), 0.5 * m * v * v, 1e-15 * m);
  EXPECT_NEAR(pair.dissipated.total_weight(), 3.2e-6, 1e-18);
}

TEST_F(CollisionEnergyTest, points_of_one_impact_share_its_energy) {
  const auto part = make("");
  for (std::uint64_t k = 0; k < 4; ++k) touch(0, 1, {0.25, 0, 0}, {-1, 0, 0}, {}, k);
  look(*part, 1);
  look(*part, 2);
  EXPECT_NEAR(pair_of(*part, "floor - glass").normal.total_weight(), 0.5 * bodies.mass[1], 1e-15);
}

// Ends with an interval: what is still in contact is in the last row as it is in the spectra.
TEST_F(CollisionEnergyTest, the_series_and_the_spectra_have_the_same_collisions) {
  for (const std::uint64_t end : {8U, 10U}) {
    const auto part = make("interval = 0.004", folder);
    const double m = bodies.mass[1];
    for (std::uint64_t step = 1; step <= end; ++step) {
      if (step == 2 || step == 4) touch(0, 1, {2.0 * m, 0, 0}, {-1, 0, 0}, {1, 0, 0});
      if (step >= end - 1) touch(0, 2, {2.0 * m, 0, 0}, {-1, 0, 0}, {1, 0, 0});
      look(*part, step);
    }
    finish(*part, end);
    std::istringstream rows{read("collision_energy_series.csv")};
    double collisions = 0.0, last = 0.0;
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
      last = std::stod(row);
      collisions += std::stod(row.substr(row.find(',') + 1));
    }
    EXPECT_EQ(collisions, 3.0);
    EXPECT_DOUBLE_EQ(last, 1e-3 * static_cast<double>(end));
  }
}

TEST_F(CollisionEnergyTest, a_resumed_run_writes_what_one_run_writes) {
  const char* options = "interval = 0.004\nfrom = 0.003";
  const auto whole = make(options, folder), first = make(options), second = make(options, folder / "second");
  const auto run = [&](CollisionEnergy& a, CollisionEnergy& b, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t step = from; step <= to; ++step) {
      for (CollisionEnergy* part : {&a, &b}) {
        std::mt19937_64 random{step};
        std::uniform_real_distribution<double> draw{0.0, 1.0};
        for (BodyIndex k = 1; k < 3; ++k) {
          if (draw(random) < 0.6)
            touch(0, k, {draw(random), 0.1, 0}, {-draw(random), draw(random), 0}, {draw(random), 0, 0});
        }
        if (draw(random) < 0.5) touch(1, 2, {draw(random), 0, 0.1}, {-draw(random), 0, 0}, {draw(random), 0, 0});
        look(*part, step);
      }
    }
  };
  run(*whole, *first, 1, 14);
  MemoryState state;
  first->save(state.writer());
  second->load(state.reader());
  run(*whole, *second, 15, 31);
  finish(*whole, 31);
  finish(*second, 31);
  for (const char* name : {"collision_energy.csv", "collision_energy_series.csv"}) {
    EXPECT_GT(read(name).size(), 100u);
    EXPECT_EQ(read(name), read(fs::path{"second"} / name));
  }
  EXPECT_EQ(whole->report()[0].rows, second->report()[0].rows);
  EXPECT_TRUE(fs::exists(folder / "collision_energy.svg"));
}

TEST_F(CollisionEnergyTest, a_range_inside_out_is_refused) {
  EXPECT_THROW(static_cast<void>(make("lower = 1.0\nupper = 0.1")), Error);
}

}  // namespace
}  // namespace scree
