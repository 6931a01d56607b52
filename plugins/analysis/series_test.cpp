#include "analysis/series.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"

namespace scree {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

TEST(schedule, is_due_in_whole_steps) {
  const Schedule schedule{options_from_text("interval = 0.025", {Schedule::parameter(0.1)}),
                          0.01};  // 2.5 steps: rounded up
  EXPECT_TRUE(schedule.is_due(3));
  EXPECT_FALSE(schedule.is_due(4));
  const Schedule always{options_from_text("interval = 0", {Schedule::parameter(0.1)}), 0.01};
  EXPECT_TRUE(always.is_due(7));
}

TEST(series, goes_on_from_a_checkpoint_with_the_rows_of_before) {
  const auto folder = std::filesystem::temp_directory_path() / ("scree_series_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::vector<SeriesColumn> columns{{"time", "s"}, {"mass", "kg"}};
  Series first;
  first.open(folder / "first.csv", columns);
  first.add({0.1, 1.0 / 3.0});
  MemoryState saved;
  first.save(saved.writer(), "rows");
  first.add({0.2, 7.0});
  Series second;
  second.open(folder / "second.csv", columns);
  second.load(saved.reader(), "rows");
  EXPECT_FALSE(second.wants(0.1));
  EXPECT_TRUE(second.wants(0.2));
  second.add({0.2, 7.0});
  EXPECT_EQ(text_of(folder / "second.csv"), text_of(folder / "first.csv"));
  EXPECT_EQ(text_of(folder / "first.csv").substr(0, 20), "time [s],mass [kg]\n0");
  EXPECT_EQ(second.column("mass"), (std::vector{1.0 / 3.0, 7.0}));
  std::filesystem::remove_all(folder);
}

TEST(series, leaves_columns_out_of_the_file_and_keeps_them_for_plots_and_checkpoints) {
  const auto folder = std::filesystem::temp_directory_path() / ("scree_series_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  Series series;
  series.open(folder / "all.csv", {{"time", "s"}, {"mass_a", "kg"}, {"mass_b", "kg"}});
  series.add({0.5, 0.0, 7.0});
  series.add({1.0, 0.0, 8.0});
  series.leave_out(std::vector<std::string>{"mass_a"});
  EXPECT_EQ(text_of(folder / "all.csv"), "time [s],mass_b [kg]\n0.5,7\n1,8\n");
  EXPECT_EQ(series.column("mass_a"), (std::vector{0.0, 0.0}));
  EXPECT_EQ(series.column("mass_b"), (std::vector{7.0, 8.0}));
  EXPECT_THROW(series.leave_out(std::vector<std::string>{"mass_c"}), std::logic_error);
  std::filesystem::remove_all(folder);
}

TEST(series, refuses_rows_and_columns_that_do_not_fit) {
  Series series;
  series.open("", {{"time", "s"}, {"mass", "kg"}});
  EXPECT_THROW(series.add({1.0}), std::logic_error);
  EXPECT_THROW((void)series.column("volume"), std::logic_error);
}

}  // namespace
}  // namespace scree
