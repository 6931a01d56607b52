#include "progress.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(progress, a_line_tells_share_speed_and_time_left) {
  // A quarter done in 60 s: three quarters take 180 s more; 1.25 s in 60 s is 0.021 of real time.
  const ProgressState now{1.25, 5.0, 12034, 30211, 100, 3.1e-4, 60.0};
  EXPECT_EQ(progress_line(now, 0.0),
            "1.25 of 5 s (25 %), 12034 bodies, 30211 contacts, 100 iterations, residual 3.1e-04 m/s, 0.021 x real "
            "time, 3 min 0 s left");
}

TEST(progress, a_line_of_soft_contacts_tells_sub_steps) {
  const ProgressState now{1.25, 5.0, 12034, 30211, 45, 0.0, 60.0, true};
  EXPECT_EQ(progress_line(now, 0.0),
            "1.25 of 5 s (25 %), 12034 bodies, 30211 contacts, 45 sub-steps, 0.021 x real time, 3 min 0 s left");
}

TEST(progress, a_line_counts_one_thing_as_one) {
  EXPECT_EQ(progress_line({1.25, 5.0, 1, 1, 1, 0.0, 0.0}, 0.0),
            "1.25 of 5 s (25 %), 1 body, 1 contact, 1 iteration, residual 0.0e+00 m/s");
  EXPECT_EQ(progress_line({1.25, 5.0, 1, 1, 1, 0.0, 0.0, true}, 0.0),
            "1.25 of 5 s (25 %), 1 body, 1 contact, 1 sub-step");
}

TEST(progress, a_resumed_run_counts_from_where_it_began) {
  // From 4 s to 5 s, half of it done in 10 s: 10 s more, 0.05 of real time.
  const ProgressState now{4.5, 5.0, 1, 0, 0, 0.0, 10.0};
  EXPECT_NE(progress_line(now, 4.0).find("(50 %)"), std::string::npos);
  EXPECT_TRUE(progress_line(now, 4.0).ends_with("0.05 x real time, 10 s left"));
}

TEST(progress, nothing_is_predicted_before_the_first_step) {
  const ProgressState now{0.0, 5.0, 1, 0, 0, 0.0, 0.0};
  EXPECT_EQ(progress_line(now, 0.0).find("left"), std::string::npos);
}

TEST(progress, a_fast_run_prints_ten_lines_in_a_pipe) {
  ProgressPace pace{0.0, 1.0};
  int lines = 0;
  for (int step = 1; step <= 1000; ++step) lines += pace.due(1e-3 * step, 1e-4 * step) ? 1 : 0;
  EXPECT_EQ(lines, 10);
}

TEST(progress, a_slow_run_prints_every_ten_seconds_in_a_pipe) {
  ProgressPace pace{0.0, 1.0};
  int lines = 0;
  for (int step = 1; step <= 99; ++step) lines += pace.due(1e-6 * step, 1.0 * step) ? 1 : 0;
  EXPECT_EQ(lines, 9);  // at 10, 20, ..., 90 s
}

TEST(progress, durations_read_well) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(182), "3 min 2 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

}  // namespace
}  // namespace scree
