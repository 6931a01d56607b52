// ObserverTest: what tests of observers share: a folder for results, bodies that come and go, and a run that is interrupted.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree::test {

/// A fixture for the observer class `Subject`. Steps take services.step = 0.01 s.
template <class Subject>
class ObserverTest : public ::testing::Test {
 public:
  ObserverTest() : folder{std::filesystem::temp_directory_path() / ("scree_observer_" + std::to_string(::getpid()))} {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    for (const char* name : {"glass", "steel"}) services.materials().add({name, 1000.0, {}, {}});
    services.step = 0.01;
  }
  ~ObserverTest() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    std::filesystem::remove_all(folder);
  }

 protected:
  [[nodiscard]] std::unique_ptr<Subject> make(const std::string& toml, const std::string& sub_folder = ".") {
    auto observer = std::make_unique<Subject>(options_from_text(toml, Subject::parameters()));
    std::filesystem::create_directories(folder / sub_folder);
    observer->setup(services, sub_folder.empty() ? std::filesystem::path{} : folder / sub_folder);
    return observer;
  }
  /// What the test's bodies look like after `step` steps.
  [[nodiscard]] Observation at(std::uint64_t step) const {
    return {bodies.view(), contacts, removed, services.step * static_cast<double>(step), services.step, step};
  }
  /// What a setting that is wrong is answered with.
  [[nodiscard]] std::string refusal(const std::string& toml) {
    try {
      (void)make(toml);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  }
  /// Takes a body out, if it is there.
  void erase(BodyId id) {
    const auto found = std::find(bodies.id.begin(), bodies.id.end(), id);
    if (found == bodies.id.end()) return;
    const auto i = found - bodies.id.begin();
    const auto drop = [&](auto& column) { column.erase(column.begin() + i); };
    drop(bodies.id), drop(bodies.motion), drop(bodies.shape), drop(bodies.material), drop(bodies.position);
    drop(bodies.orientation), drop(bodies.velocity), drop(bodies.angular_velocity), drop(bodies.mass);
    drop(bodies.inertia), drop(bodies.radius), drop(bodies.force), drop(bodies.torque);
    services.attributes().resize(bodies.id.size());
  }
  /// The cells of a table, header first.
  [[nodiscard]] std::vector<std::vector<std::string>> csv(const std::string& name) const {
    std::ifstream in{folder / name};
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(in, line);) {
      std::istringstream cells{line};
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
  }
  /// True when both pictures of that stem hold something; copies the PNG to the folder that SCREE_KEEP_FIGURES names.
  [[nodiscard]] bool has_figure(const std::string& stem) const {
    const auto png = folder / (stem + ".png"), svg = folder / (stem + ".svg");
    if (!std::filesystem::exists(png) || !std::filesystem::exists(svg)) return false;
    if (const char* keep = std::getenv("SCREE_KEEP_FIGURES")) {
      std::filesystem::copy_file(png, std::filesystem::path{keep} / png.filename(),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    return std::filesystem::file_size(png) > 1000 && std::filesystem::file_size(svg) > 1000;
  }

  using Run = std::function<void(Subject& observer, std::uint64_t first, std::uint64_t last)>;
  /// Law: run(2N) equals run(N), restart, run(N), in every table and every byte of CSV. `start` makes the bodies, `run`
  /// moves and shows them from step `first` to `last`.
  void expect_checkpoints_to_keep_everything(const std::string& toml, const std::function<void()>& start,
                                             const Run& run) {
    const auto begin = [&] {
      bodies = TestBodies{services.attributes()};
      removed.clear();
      start();
    };
    begin();
    const auto whole = make(toml, "whole");
    run(*whole, 1, 40);
    whole->finish(at(40));
    begin();
    const auto first = make(toml, "first");
    run(*first, 1, 17);
    MemoryState saved;
    first->save(saved.writer());
    const auto second = make(toml, "second");
    second->load(saved.reader());
    run(*second, 18, 40);
    second->finish(at(40));

    const auto expected = whole->report(), found = second->report();
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t t = 0; t < expected.size(); ++t) EXPECT_EQ(expected[t].rows, found[t].rows) << expected[t].title;
    const auto files = tables_in("whole");
    EXPECT_FALSE(files.empty());
    EXPECT_EQ(files, tables_in("second"));
  }

  std::filesystem::path folder;
  FakeSceneServices services;
  TestBodies bodies{services.attributes()};
  std::vector<RemovedBody> removed;
  ContactView contacts;

 private:
  [[nodiscard]] std::map<std::string, std::string> tables_in(const std::string& sub_folder) const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator{folder / sub_folder}) {
      if (entry.path().extension() != ".csv") continue;
      std::ostringstream text;
      text << std::ifstream{entry.path()}.rdbuf();
      texts[entry.path().filename()] = text.str();
    }
    return texts;
  }
};

}  // namespace scree::test
