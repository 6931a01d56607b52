#include "log_watch.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

using Lines = std::vector<std::string>;

TEST(log_watch, tells_a_warning_once_and_other_lines_never) {
  LogWatch watch;
  Lines log{"warning: a.toml:3:1: the column is read by no part", "time_stepper:dem: 45 sub-steps"};
  EXPECT_EQ(watch.news(log), Lines{"a.toml:3:1: the column is read by no part"});
  EXPECT_EQ(watch.news(log), Lines{});
  log.emplace_back("time_stepper:dem: warning: contacts overlap");
  log.emplace_back("a joint broke");
  log.emplace_back("time_stepper:dem: warning: contacts overlap");  // another part, or another time: the same words
  EXPECT_EQ(watch.news(log), Lines{"time_stepper:dem: contacts overlap"});
  EXPECT_EQ(watch.news(log), Lines{});
  EXPECT_EQ(watch.untold(), 0U);
}

TEST(log_watch, keeps_the_rest_of_very_many_back_and_counts_them) {
  LogWatch watch;
  Lines log;
  std::size_t told = 0;
  for (std::size_t k = 0; k < LogWatch::kMost + 7; ++k) {
    log.push_back("warning: " + std::to_string(k));
    told += watch.news(log).size();
  }
  EXPECT_EQ(told, LogWatch::kMost);
  EXPECT_EQ(watch.untold(), 7U);
}

}  // namespace
}  // namespace scree
