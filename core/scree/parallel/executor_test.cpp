#include "scree/parallel/executor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace scree {
namespace {

class ExecutorThreads : public testing::TestWithParam<int> {};

// Law: every index is visited exactly once, in chunks whose bounds depend on size and grain only.
TEST_P(ExecutorThreads, visits_every_index_once) {
  const Executor executor{GetParam()};
  std::vector<int> visits(1001, 0);
  std::atomic<int> chunks = 0;
  executor.for_chunks(visits.size(), 64, [&](std::size_t first, std::size_t last) {
    EXPECT_EQ(first % 64, 0u);
    ++chunks;
    for (std::size_t i = first; i < last; ++i) ++visits[i];
  });
  EXPECT_EQ(visits, std::vector<int>(1001, 1));
  EXPECT_EQ(static_cast<std::size_t>(chunks), Executor::chunk_count(1001, 64));
}

TEST_P(ExecutorThreads, passes_exceptions_on) {
  const Executor executor{GetParam()};
  EXPECT_THROW(executor.for_chunks(100, 1,
                                   [](std::size_t first, std::size_t) {
                                     if (first == 57) throw std::runtime_error{"chunk 57"};
                                   }),
               std::runtime_error);
}

TEST_P(ExecutorThreads, empty_loop_calls_nothing) {
  const Executor executor{GetParam()};
  executor.for_chunks(0, 8, [](std::size_t, std::size_t) { FAIL() << "no chunk exists"; });
}

INSTANTIATE_TEST_SUITE_P(threads, ExecutorThreads, testing::Values(1, 2, 4));

TEST(Executor, refuses_zero_threads) { EXPECT_THROW(Executor{0}, std::logic_error); }

}  // namespace
}  // namespace scree
