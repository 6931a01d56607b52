// The non-monotone line search: its condition, its safeguards, its memory.
#include "line_search.hpp"

#include <gtest/gtest.h>

namespace scree::test {

using spg::LineSearch;

// f(1) - f(0) = s + c / 2 = -1 + 0.5: enough.
TEST(line_search, full_step_is_taken_where_it_descends) {
  LineSearch search;
  search.start(10);
  EXPECT_EQ(search.step(-1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(search.change(), -0.5);
  EXPECT_EQ(search.reductions(), 0);
}

// At the start all the memory knows is the start itself: a step uphill is refused, and the parabola's minimum -s / c taken.
TEST(line_search, step_uphill_at_the_start_becomes_the_minimum_of_the_parabola) {
  LineSearch search;
  search.start(10);
  EXPECT_DOUBLE_EQ(search.step(-1.0, 4.0), 0.25);
  EXPECT_DOUBLE_EQ(search.change(), -0.125);
  EXPECT_EQ(search.reductions(), 1);
}

// The minimum lies at 1e-3: three trials shrink by 0.1 at most each.
TEST(line_search, trials_never_shrink_by_more_than_ten) {
  LineSearch search;
  search.start(1);
  const double lambda = search.step(-1.0, 1000.0);
  EXPECT_DOUBLE_EQ(lambda, 1e-3);
  EXPECT_EQ(search.reductions(), 3);
}

// After a descent of 8, a rise of 1 is allowed as long as the memory reaches back to the start, and refused after that.
TEST(line_search, rise_is_allowed_below_the_highest_remembered_iterate_only) {
  for (const int memory : {1, 3}) {
    LineSearch search;
    search.start(memory);
    search.step(-16.0, 16.0);  // f: -8
    const double lambda = search.step(-1.0, 4.0);
    if (memory == 1) {
      EXPECT_DOUBLE_EQ(lambda, 0.25);
      continue;
    }
    EXPECT_EQ(lambda, 1.0);  // f: -7
    EXPECT_DOUBLE_EQ(search.change(), -7.0);
    search.step(-1e-6, 0.0);  // the start drops out of the memory: -7 is the highest now
    EXPECT_DOUBLE_EQ(search.step(-1.0, 4.0), 0.25);
  }
}

}  // namespace scree::test
