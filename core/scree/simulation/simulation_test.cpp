#include "scree/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/results/run_record.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;
using testing_parts::scene;

constexpr const char* kFedScene = R"(
[[force_field]]
type = 'push'
[[source]]
type = 'drip'
[[sink]]
type = 'gate'
limit = 0.5
)";

/// The text of the Error that a scene gives, or "" when it is accepted.
std::string refusal(const std::string& toml) {
  const Catalog catalog;
  try {
    const SceneDocument document = SceneDocument::parse(toml);
    Simulation simulation{document, catalog, {}};
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string with_balls(const char* positions) {
  return scene(
      std::string{"[[body]]\nname = 'a'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\n"
                  "[[body]]\nname = 'b'\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\nposition = "} +
      positions + "\n");
}

// Nothing vanishes: after every step, fed = present + removed, in number exactly and in mass to rounding.
TEST(Simulation, every_body_is_accounted_for) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  Simulation simulation{document, catalog, {}};
  std::size_t removed = 0;
  for (int step = 0; step < 30; ++step) {
    simulation.step();
    removed += simulation.removed().size();
    const Amount fed = simulation.feed().fed[0];
    const Amount gone = simulation.feed().removed[0];
    EXPECT_EQ(fed.count, simulation.bodies().size() + gone.count);
    EXPECT_EQ(gone.count, removed);
    EXPECT_NEAR(fed.mass, 2.0 * static_cast<double>(simulation.bodies().size()) + gone.mass, 1e-12);
  }
  EXPECT_GT(removed, 0u);
}

// x_n = a h^2 n (n + 1) / 2 for the scheme v += h a, x += h v: a body leaves at its 10th step (0.55 > 0.5).
TEST(Simulation, sinks_log_who_left_where_and_why) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  Simulation simulation{document, catalog, {}};
  for (int step = 0; step < 10; ++step) simulation.step();
  ASSERT_EQ(simulation.removed().size(), 1u);
  const RemovedBody& gone = simulation.removed()[0];
  EXPECT_EQ(gone.id, 0u);
  EXPECT_NEAR(gone.position.x, 0.55, 1e-12);
  EXPECT_NEAR(gone.time, 1.0, 1e-12);
  EXPECT_EQ(gone.sink, "gate");
  EXPECT_EQ(gone.reason, "passed the gate");
  EXPECT_TRUE(simulation.is_done());
}

// run(2N) = run(N), checkpoint, run(N), bit for bit, with a source whose random stream goes on.
TEST(Simulation, continues_from_a_checkpoint_bit_for_bit) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "scree_simulation_test.h5";
  Simulation whole{document, catalog, {}};
  for (int step = 0; step < 7; ++step) whole.step();
  whole.save(file);
  for (int step = 0; step < 9; ++step) whole.step();
  Simulation second{document, catalog, {}};
  second.resume(file);
  EXPECT_EQ(second.steps(), 7u);
  for (int step = 0; step < 9; ++step) second.step();
  EXPECT_EQ(second.state_hash(), whole.state_hash());
  EXPECT_EQ(second.feed().fed[0].count, whole.feed().fed[0].count);
  std::filesystem::remove(file);
}

// What fields did and what came and left make the kinetic energy, across a restart too.
TEST(Simulation, energy_is_accounted_for_through_sources_sinks_and_restarts) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "scree_energy_test.h5";
  Simulation whole{document, catalog, {}}, second{document, catalog, {}};
  for (int step = 0; step < 15; ++step) whole.step();
  whole.save(file);
  second.resume(file);
  for (int step = 0; step < 15; ++step) {
    const EnergyAccount energy = whole.step().energy, resumed = second.step().energy;
    ASSERT_FALSE(whole.removed().empty());
    // Bodies that a sink took are in the account and in `bodies` no more. Thirty sums of numbers near ten.
    EXPECT_NEAR(energy.kinetic, energy.work.force_work + energy.fed_kinetic, 1e-12);
    EXPECT_EQ(resumed.work.force_work, energy.work.force_work);
    EXPECT_EQ(resumed.fed_kinetic, energy.fed_kinetic);
  }
  std::filesystem::remove(file);
}

// Observers hear of a removal in the step after it: the checkpoint between the two must not swallow it.
TEST(Simulation, a_checkpoint_keeps_the_removals_that_observers_have_not_heard_of) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "scree_removed_test.h5";
  Simulation whole{document, catalog, {}};
  for (int step = 0; step < 10; ++step) whole.step();
  whole.save(file);
  Simulation second{document, catalog, {}};
  second.resume(file);
  ASSERT_EQ(second.removed().size(), 1u);
  EXPECT_EQ(second.removed()[0].id, whole.removed()[0].id);
  EXPECT_EQ(second.removed()[0].position, whole.removed()[0].position);
  EXPECT_EQ(second.removed()[0].time, whole.removed()[0].time);
  EXPECT_EQ(second.removed()[0].sink, "gate");
  EXPECT_EQ(second.removed()[0].reason, "passed the gate");
  std::filesystem::remove(file);
}

TEST(Simulation, refuses_the_checkpoint_of_another_scene) {
  const Catalog catalog;
  const SceneDocument one = SceneDocument::parse(scene(kFedScene));
  const SceneDocument other =
      SceneDocument::parse(scene(std::string{kFedScene} + "\n[contacts]\nunlisted_pair = 'mean'\n"));
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "scree_other_scene_test.h5";
  Simulation{one, catalog, {}}.save(file);
  Simulation simulation{other, catalog, {}};
  EXPECT_THROW(simulation.resume(file), Error);
  std::filesystem::remove(file);
}

// The record of the run that wrote it says what differs; without it, or beside another run's, nothing is guessed.
TEST(Simulation, names_the_settings_in_which_a_checkpoint_differs) {
  const Catalog catalog;
  const std::string changed = "\n[contacts]\nunlisted_pair = 'mean'\n[output]\nsteps_every = 7\n";
  const SceneDocument one = SceneDocument::parse(scene(kFedScene));
  const SceneDocument other = SceneDocument::parse(scene(std::string{kFedScene} + changed));
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "scree_named_difference_test";
  std::filesystem::create_directories(folder);
  Simulation first{one, catalog, {}};
  first.save(folder / "checkpoint.h5");
  Simulation second{other, catalog, {}};
  const auto refusal_to_resume = [&]() -> std::string {
    try {
      second.resume(folder / "checkpoint.h5");
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal_to_resume().find(second.scene_hash() + "); only end_time"), std::string::npos);
  RunRecord record;
  record.scene_hash = first.scene_hash();
  record.resolved_scene = first.resolved_scene();
  write_run_record(record, folder / "run.json");
  EXPECT_NE(refusal_to_resume().find("): 'contacts.unlisted_pair' differs; only end_time"), std::string::npos)
      << refusal_to_resume();
  record.scene_hash = "0";
  write_run_record(record, folder / "run.json");
  EXPECT_NE(refusal_to_resume().find(second.scene_hash() + "); only end_time"), std::string::npos);
  // A record that is none, which somebody wrote or another program.
  for (const char* text : {"{\"scene_hash\": 5, \"resolved_scene\": {}}", "[]", "{"}) {
    std::ofstream{folder / "run.json"} << text;
    EXPECT_NE(refusal_to_resume().find(second.scene_hash() + "); only end_time"), std::string::npos) << text;
  }
  std::filesystem::remove_all(folder);
}

TEST(Simulation, a_body_that_flies_off_is_told_in_a_line_of_text) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(
      scene("[[force_field]]\ntype = 'push'\nacceleration = 1e150\n[[body]]\nshape = 'ball'\nmaterial = 'stone'\n"
            "motion = 'dynamic'\n"));
  Simulation simulation{document, catalog, {}};
  try {
    simulation.step();
    FAIL() << "1e149 m/s went unnoticed";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("body 0 moves at 1e+149 m/s at t = 0.1 s"), std::string::npos) << text;
    EXPECT_LT(text.size(), 200U) << text;
  }
}

TEST(Simulation, names_the_field_and_the_body_of_a_nan_and_keeps_the_last_good_state) {
  const Catalog catalog;
  const SceneDocument document =
      SceneDocument::parse(scene("[[force_field]]\ntype = 'push'\npoison_from = 0.45\n[[source]]\ntype = 'drip'\n"));
  Simulation simulation{document, catalog, {}};
  for (int step = 0; step < 5; ++step) simulation.step();
  const Vec3 before = simulation.bodies().view().position[1];
  try {
    simulation.step();
    FAIL() << "a NaN has to end the run";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 3);
    EXPECT_NE(std::string{error.what()}.find("force_field:push"), std::string::npos) << error.what();
    EXPECT_NE(std::string{error.what()}.find("body 1"), std::string::npos) << error.what();
  }
  EXPECT_EQ(simulation.bodies().view().position[1], before);
}

// 0 m/s2 times the infinite mass of a fixed body is NaN, and nobody's concern: entries of immovable bodies are ignored.
TEST(Simulation, a_field_may_multiply_by_the_mass_of_a_fixed_body) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(
      scene("[[force_field]]\ntype = 'push'\nacceleration = 0\n[[body]]\nshape = 'ball'\nmaterial = 'stone'\n"
            "[[body]]\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\nposition = [5, 0, 0]\n"));
  Simulation simulation{document, catalog, {}};
  EXPECT_NO_THROW(simulation.step());
  EXPECT_EQ(simulation.bodies().view().position[1], (Vec3{5, 0, 0}));
}

TEST(Simulation, too_fast_is_diverged) {
  const Catalog catalog;
  const SceneDocument document =
      SceneDocument::parse(scene("[[force_field]]\ntype = 'push'\nacceleration = 1e6\n[[source]]\ntype = 'drip'\n"));
  Simulation simulation{document, catalog, {}};
  EXPECT_THROW(simulation.step(), Error);
}

TEST(Simulation, overlapping_bodies_are_refused_and_touching_ones_are_not) {
  EXPECT_NE(refusal(with_balls("[0.15, 0, 0]")).find("body 'a' and body 'b' overlap by 0.05 m"), std::string::npos)
      << refusal(with_balls("[0.15, 0, 0]"));
  EXPECT_EQ(refusal(with_balls("[0.2, 0, 0]")), "");
}

TEST(Simulation, kinds_that_no_narrow_phase_supports_are_refused_when_the_scene_is_loaded) {
  const std::string text = scene(
      "[shape.brick]\ntype = 'box'\nsize = [1, 1, 1]\n[[body]]\nshape = 'brick'\nmaterial = "
      "'stone'\nmotion = 'dynamic'\n[[body]]\nshape = 'ball'\nmaterial = 'stone'\nposition = [5, 0, 0]\n");
  EXPECT_NE(refusal(text).find("box"), std::string::npos) << refusal(text);
}

/// The scene without its narrow phase.
std::string without_narrow_phase(std::string text) {
  const std::string section = "[[narrow_phase]]\ntype = 'spheres'\n";
  return text.erase(text.find(section), section.size());
}

TEST(Simulation, a_scene_without_a_narrow_phase_gets_those_that_have_a_place_in_the_chain) {
  const std::string text = without_narrow_phase(with_balls("[0.15, 0, 0]"));
  EXPECT_NE(refusal(text).find("bodies of the scene may touch, but the scene has no [[narrow_phase]]"),
            std::string::npos)
      << refusal(text);
  Catalog catalog;
  catalog.list().add<NarrowPhase, testing_parts::Spheres>("second", "").default_place = 7;
  catalog.list().add<NarrowPhase, testing_parts::Spheres>("first", "").default_place = 2;
  const SceneDocument document = SceneDocument::parse(without_narrow_phase(with_balls("[0.2, 0, 0]")));
  const Simulation simulation{document, catalog, {}};
  std::vector<std::string> chain;
  for (const PartInfo& part : simulation.parts()) {
    if (part.kind == NarrowPhase::kKind) chain.push_back(part.type);
  }
  EXPECT_EQ(chain, (std::vector<std::string>{"first", "second"}));
}

/// Looks for contacts, twice a step, and does nothing with them.
class Looker final : public TimeStepper {
 public:
  StepSummary step(StepServices& services, const BodyState& bodies, double, double dt) override {
    services.contacts(bodies.view, bodies.velocity, bodies.angular_velocity, dt);
    services.contacts(bodies.view, bodies.velocity, bodies.angular_velocity, dt);
    return {};
  }
  [[nodiscard]] ContactView contacts() const override { return {}; }
};

// Two balls with one centre stay so: a pair a search, counted by step and by phase.
TEST(Simulation, pairs_computed_by_a_fallback_are_counted) {
  Catalog catalog;
  catalog.list().add<TimeStepper, Looker>("looker", "");
  const std::vector<std::string> overlap{"simulation.allow_overlap=true", "time_stepper.type=looker"};
  const SceneDocument document = SceneDocument::parse(with_balls("[0, 0, 0]"), "scene.toml", overlap);
  Simulation simulation{document, catalog, {}};
  simulation.step();
  EXPECT_EQ(simulation.step().fallbacks, 2u);
  ASSERT_FALSE(simulation.report().empty());
  EXPECT_EQ(simulation.report()[0].rows, (std::vector<std::vector<std::string>>{{"spheres", "4"}}));
}

TEST(Simulation, unknown_sections_and_names_get_a_suggestion) {
  EXPECT_NE(refusal(scene("[[force_feild]]\ntype = 'push'\n")).find("'force_field'"), std::string::npos);
  EXPECT_NE(refusal(scene("[[body]]\nshape = 'bal'\nmaterial = 'stone'\n")).find("did you mean 'ball'"),
            std::string::npos);
  EXPECT_NE(refusal(scene("[[body]]\nshape = 'ball'\nmaterial = 'stome'\n")).find("did you mean 'stone'"),
            std::string::npos);
  EXPECT_NE(refusal(scene("[shape.cube]\ntype = 'boxx'\n")).find("did you mean 'box'"), std::string::npos);
}

TEST(Simulation, materials_in_a_list_are_told_how_to_be_written) {
  const std::string text = refusal("[simulation]\nend_time = 1\ntime_step = 1\n[[material]]\ndensity = 1000\n");
  EXPECT_NE(text.find("'material' must be written as [material.NAME]"), std::string::npos) << text;
  const std::string bare = refusal("[simulation]\nend_time = 1\ntime_step = 1\n[material]\ndensity = 1000\n");
  EXPECT_NE(bare.find("scene.toml:5:1: 'density' must be a table"), std::string::npos) << bare;
}

TEST(Simulation, no_two_observers_write_the_same_file) {
  const auto two = [](const std::string& one, const std::string& other) {
    return scene("[[observer]]\ntype = 'writer'\n" + one + "\n[[observer]]\ntype = 'writer'\n" + other + "\n");
  };
  EXPECT_EQ(refusal(two("name = 'a b'", "name = 'a c'")), "");
  const std::string alike = refusal(two("name = 'A b'", "name = 'a_b'"));
  EXPECT_NE(alike.find("observer:writer 'A b' and observer:writer 'a_b' would write the same files"), std::string::npos)
      << alike;
  const std::string file = refusal(two("file = 'x.csv'", "name = 'b'\nfile = 'x.csv'"));
  EXPECT_NE(file.find("would both write the file 'x.csv'"), std::string::npos) << file;
}

// A name is a group in a checkpoint and a part of the names of files: a run must not die of it when it writes them.
TEST(Simulation, a_name_with_a_slash_is_refused_where_it_stands) {
  for (const char* part : {"[[observer]]\ntype = 'writer'", "[[force_field]]\ntype = 'push'"}) {
    const auto named = [&](const std::string& name) { return refusal(scene(std::string{part} + "\nname = " + name)); };
    EXPECT_EQ(named("'in and out (2) \xc3\xa9'"), "");
    const std::string slash = named("'in/out'"), lines = named("\"in\\nout\"");
    EXPECT_NE(slash.find("'name' is 'in/out', which has a slash in it"), std::string::npos) << slash;
    EXPECT_EQ(slash.find("scene.toml:"), 0u) << slash;
    EXPECT_NE(lines.find("control character"), std::string::npos) << lines;
  }
}

TEST(Simulation, planes_cannot_move_by_forces) {
  const std::string text =
      scene("[shape.floor]\ntype = 'plane'\n[[body]]\nshape = 'floor'\nmaterial = 'stone'\nmotion = 'dynamic'\n");
  EXPECT_NE(refusal(text).find("a plane has no mass"), std::string::npos) << refusal(text);
}

TEST(Simulation, attributes_have_the_dimension_that_their_reader_states) {
  const auto charged = [](const std::string& charge) {
    return scene(
        "[[force_field]]\ntype = 'charged'\n[[body]]\nshape = 'ball'\nmaterial = 'stone'\n"
        "attributes = { charge = " +
        charge + " }\n");
  };
  EXPECT_EQ(refusal(charged("'2 nC'")), "");
  EXPECT_EQ(refusal(charged("2e-9")), "");
  EXPECT_NE(refusal(charged("'2 mm'")).find("\"2 mm\" is in mm, which cannot be converted to C"), std::string::npos)
      << refusal(charged("'2 mm'"));
}

// A column that a part reads and no part writes has to come with every body: none gets a silent zero.
TEST(Simulation, a_body_without_an_attribute_that_is_read_is_refused) {
  const std::string reader = "[[force_field]]\ntype = 'weigher'\n";
  const std::string body = "[[body]]\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\n";
  EXPECT_NE(refusal(scene(reader)).find("which nothing in the scene provides"), std::string::npos);
  EXPECT_EQ(refusal(scene(reader + body + "attributes = { ballast = 2 }\n")), "");
  const std::string other = "[[body]]\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\nposition = [5, 0, 0]\n";
  const std::string text = refusal(scene(reader + body + "attributes = { ballast = 2 }\n" + other));
  EXPECT_NE(text.find("material 'stone' has no value for the attribute 'ballast'"), std::string::npos) << text;
}

TEST(Simulation, an_attribute_that_no_part_reads_is_warned_of) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(
      scene("[[force_field]]\ntype = 'weigher'\n[[body]]\nshape = 'ball'\nmaterial = 'stone'\nmotion = 'dynamic'\n"
            "attributes = { ballast = 2, balast = 3 }\n"));
  const Simulation simulation{document, catalog, {}};
  ASSERT_EQ(simulation.warnings().size(), 1u);
  EXPECT_NE(simulation.warnings()[0].find("'balast', given by body '', is read by no part; did you mean 'ballast'?"),
            std::string::npos)
      << simulation.warnings()[0];
  ASSERT_FALSE(simulation.log().empty());
  EXPECT_EQ(simulation.log().back(), "warning: " + simulation.warnings()[0]);
}

TEST(Simulation, the_resolved_scene_shows_defaults_and_pairs) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene(kFedScene));
  const Simulation simulation{document, catalog, {}};
  const std::string json = simulation.resolved_scene();
  EXPECT_NE(json.find("\"max_speed\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"material_pair\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"poison_from\""), std::string::npos) << json;
}

}  // namespace
}  // namespace scree
