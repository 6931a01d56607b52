#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scree/base/error.hpp"
#include "scree/model/material.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/results/run_record.hpp"
#include "scree/results/step_log.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

class ResultsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_results_" + std::to_string(::getpid()));
    fs::remove_all(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  static std::string read(const fs::path& file) {
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
  }
  static std::string message(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      return error.what();
    }
    return "no error";
  }

  fs::path folder;
};

TEST_F(ResultsTest, a_new_folder_is_made_with_its_parents) {
  const ResultFolder made = ResultFolder::create(folder / "a" / "b", false);
  EXPECT_TRUE(fs::is_directory(made.path()));
}

TEST_F(ResultsTest, an_older_run_is_kept_unless_overwriting_is_asked_for) {
  const ResultFolder first = ResultFolder::create(folder, false);
  std::ofstream{first.file("run.json")} << "{}";
  const std::string said = message([&] { (void)ResultFolder::create(folder, false); });
  EXPECT_NE(said.find(folder.string()), std::string::npos);
  EXPECT_NE(said.find("--overwrite"), std::string::npos);
  EXPECT_EQ(read(first.file("run.json")), "{}");
}

TEST_F(ResultsTest, overwriting_removes_what_a_run_wrote_and_nothing_else) {
  const ResultFolder first = ResultFolder::create(folder, false);
  const std::vector<const char*> ours{"run.json", "steps.csv", "a plugin's own.xyz", "checkpoint.h5"};
  const std::vector<const char*> theirs{"notes.txt", "my_run.json", "bins_end.csv", "run.json.bak"};
  for (const char* name : ours) replace_file(first.file(name), std::string_view{name});
  OutputFile{first.file("track_ball.csv")}.write("opened, and the run was killed");
  std::ofstream{first.file("run.json.part")} << "the run was killed while it wrote run.json";
  for (const char* name : theirs) std::ofstream{first.file(name)} << name;
  (void)ResultFolder::create(folder, true);
  for (const char* name : ours) EXPECT_FALSE(fs::exists(first.file(name))) << name;
  for (const char* name : {"track_ball.csv", "run.json.part"}) EXPECT_FALSE(fs::exists(first.file(name))) << name;
  for (const char* name : theirs) EXPECT_EQ(read(first.file(name)), name);
}

TEST_F(ResultsTest, overwriting_removes_nothing_outside_of_the_folder) {
  const ResultFolder results = ResultFolder::create(folder / "run", false);
  std::ofstream{folder / "precious"} << "x";
  std::ofstream{results.file(".scree_results"), std::ios::app} << "../precious\n..\n\n"
                                                               << (folder / "precious").string();
  (void)ResultFolder::create(results.path(), true);
  EXPECT_EQ(read(folder / "precious"), "x");
}

TEST_F(ResultsTest, a_file_is_listed_once_however_often_it_is_replaced) {
  const ResultFolder results = ResultFolder::create(folder, false);
  const std::string before = read(results.file(".scree_results"));
  for (int i = 0; i < 3; ++i) replace_file(results.file("run.pvd"), std::string_view{"x"});
  EXPECT_EQ(read(results.file(".scree_results")), before + "run.pvd\n");
}

TEST_F(ResultsTest, parts_with_a_name_have_files_of_their_own) {
  EXPECT_EQ(result_stem("particles", "vtk", "vtk"), "particles");
  EXPECT_EQ(result_stem("particles", "vtk", ""), "particles");
  EXPECT_EQ(result_stem("particles", "vtk", "Fine ones/2"), "particles_fine_ones_2");
}

TEST_F(ResultsTest, overwriting_refuses_a_folder_that_no_run_wrote) {
  fs::create_directories(folder);
  std::ofstream{folder / "steps.csv"} << "a table of somebody else";
  EXPECT_NE(message([&] { (void)ResultFolder::create(folder, true); }).find("no results of scree"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "steps.csv"));
}

TEST_F(ResultsTest, a_file_in_the_way_is_named) {
  std::ofstream{folder} << "x";
  EXPECT_NE(message([&] { (void)ResultFolder::create(folder, true); }).find("is a file"), std::string::npos);
  EXPECT_NE(message([&] { (void)ResultFolder::create(folder / "sub", true); }).find(folder.string()),
            std::string::npos);
}

TEST_F(ResultsTest, a_full_device_is_an_error_that_names_file_and_reason) {
  const std::string said = message([] {
    OutputFile out{"/dev/full"};
    out.write("x");
    out.close();
  });
  EXPECT_NE(said.find("/dev/full: No space left on device"), std::string::npos) << said;
}

TEST_F(ResultsTest, a_file_size_limit_is_an_error_at_the_row_that_met_it) {
  fs::create_directories(folder);
  std::signal(SIGXFSZ, SIG_IGN);
  CsvWriter table{folder / "steps.csv", {{"x", "m"}}};
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{64, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = message([&] {
    for (int i = 0; i < 100; ++i) table.cell(0.125).end_row();
  });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(said.find("steps.csv: File too large"), std::string::npos) << said;
}

TEST_F(ResultsTest, a_table_reads_back_to_the_same_bits) {
  fs::create_directories(folder);
  CsvWriter table{folder / "t.csv", {{"x", "m/s"}, {"n", ""}, {"text", ""}}};
  const double x = 0.1 + 0.2;
  table.cell(x).cell(std::uint64_t{3}).cell("say \"a, b\"").end_row();
  EXPECT_THROW(table.cell(1.0).end_row(), std::logic_error);
  std::ifstream in{folder / "t.csv"};
  std::string header, row;
  std::getline(in, header);
  std::getline(in, row);
  EXPECT_EQ(header, "x [m/s],n,text");
  EXPECT_EQ(std::stod(row), x);
  EXPECT_EQ(row.substr(row.find(',')), ",3,\"say \"\"a, b\"\"\"");
}

TEST_F(ResultsTest, steps_and_removed_bodies_have_units_in_their_headers) {
  fs::create_directories(folder);
  Materials materials;
  materials.add({"copper", 8900.0, {}, {}});
  StepLog steps{folder / "steps.csv", {"collision", "solver"}};
  StepRecord record;
  record.step = 3;
  record.time = 0.25;
  record.status = "converged";
  record.fallbacks = 4;
  record.energy = {1.5, -2.5, {3.5, 4.5, 5.5, 7.5}, 6.5};
  steps.add(record, std::vector<double>{0.5, 0.75});
  EXPECT_EQ(read(folder / "steps.csv"),
            "step,time [s],bodies,contacts,iterations,residual [m/s],status,mean_penetration [1],max_penetration [m],"
            "kinetic_energy [J],potential_energy [J],contact_loss [J],boundary_work [J],force_work [J],"
            "joint_work [J],fed_kinetic_energy [J],fallbacks,seconds_collision [s],seconds_solver [s]\n"
            "3,0.25,0,0,0,0,converged,0,0,1.5,-2.5,3.5,4.5,5.5,7.5,6.5,4,0.5,0.75\n");
  RemovedLog removed{folder / "removed.csv", materials};
  removed.add(std::vector<RemovedBody>{{17, 0, 0.5, 1.5, {1, 2, 3}, "floor", "left through z = 0"}});
  EXPECT_EQ(read(folder / "removed.csv"),
            "id,material,mass [kg],time [s],x [m],y [m],z [m],sink,reason\n"
            "17,copper,0.5,1.5,1,2,3,floor,left through z = 0\n");
}

TEST_F(ResultsTest, run_json_holds_what_a_reader_looks_for) {
  fs::create_directories(folder);
  RunRecord record;
  record.simulated_time = 0.1 + 0.2;
  record.state_hash = 0xabcULL;
  record.resolved_scene = R"({"simulation": {"end_time": 5.0}})";
  record.plugins = {{"observer", "bins", "1.0.0", "bins.so"}};
  record.phase_seconds = {{"solver", 1.5}};
  record.outcome = "bad bytes: \xff";
  write_run_record(record, folder / "run.json");
  const auto json = nlohmann::json::parse(read(folder / "run.json"));
  for (const char* key : {"exit_status", "simulated_time", "steps", "wall_time", "bodies", "contacts", "state_hash"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["simulated_time"].get<double>(), record.simulated_time);
  EXPECT_EQ(json["state_hash"], "0000000000000abc");
  EXPECT_EQ(json["resolved_scene"]["simulation"]["end_time"], 5.0);
  EXPECT_EQ(json["plugins"][0]["file"], "bins.so");
  EXPECT_EQ(json["phase_seconds"]["solver"], 1.5);
}

}  // namespace
}  // namespace scree
