#include "scree/geometry/decomposition_cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "scree/base/error.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

/// A decomposition with numbers that have no short form.
SphereDecomposition answer() { return {{{{1.0 / 3.0, -0.1, 1e-300}, std::sqrt(2.0)}}, -1.0 / 7.0, 0.3, 0.7}; }

void expect_same(const SphereDecomposition& a, const SphereDecomposition& b) {
  EXPECT_EQ(a.spheres, b.spheres);
  EXPECT_EQ(a.volume_error, b.volume_error);
  EXPECT_EQ(a.hausdorff, b.hausdorff);
  EXPECT_EQ(a.hausdorff_of_equivalent, b.hausdorff_of_equivalent);
}

class DecompositionCacheOnDisk : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path only_file() const {
    const std::filesystem::directory_iterator files{folder_ / "decompositions"};
    return files == std::filesystem::directory_iterator{} ? "" : files->path();
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("scree_cache_" + std::to_string(::getpid()));
};

TEST(decomposition_cache, the_same_content_is_computed_once) {
  DecompositionCache cache;
  int calls = 0;
  const auto compute = [&] {
    ++calls;
    return answer();
  };
  for (int i = 0; i < 5; ++i) expect_same(cache.find_or("a", compute), answer());
  (void)cache.find_or("b", compute);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(cache.counts().computed, 2u);
  EXPECT_EQ(cache.counts().remembered, 4u);
  cache.forget();
  (void)cache.find_or("a", compute);
  EXPECT_EQ(calls, 3);
}

TEST(decomposition_cache, threads_that_want_the_same_wait_for_the_first) {
  DecompositionCache cache;
  std::atomic<int> calls = 0;
  const Executor executor{4};
  executor.for_chunks(200, 1, [&](std::size_t first, std::size_t) {
    (void)cache.find_or(std::to_string(first % 10), [&] {
      ++calls;
      return answer();
    });
  });
  EXPECT_EQ(calls, 10);
  EXPECT_EQ(cache.counts().remembered, 190u);
}

TEST(decomposition_cache, a_failure_is_not_kept) {
  DecompositionCache cache;
  EXPECT_THROW((void)cache.find_or("a", []() -> SphereDecomposition { throw Error{ErrorKind::usage, "thin"}; }), Error);
  expect_same(cache.find_or("a", answer), answer());
}

TEST_F(DecompositionCacheOnDisk, a_later_program_reads_every_bit_back) {
  DecompositionCache first, second;
  first.keep_in(folder_);
  second.keep_in(folder_);
  (void)first.find_or("a", answer);
  expect_same(second.find_or("a", []() -> SphereDecomposition { throw std::logic_error{"computed again"}; }), answer());
  EXPECT_EQ(second.counts().read, 1u);
  EXPECT_EQ(second.counts().computed, 0u);
}

TEST_F(DecompositionCacheOnDisk, a_damaged_file_is_passed_over_and_replaced) {
  DecompositionCache first;
  first.keep_in(folder_);
  (void)first.find_or("a", answer);
  std::ifstream in{only_file()};
  const std::string good{std::istreambuf_iterator<char>{in}, {}};
  for (const std::string& damaged : {std::string{}, std::string{"nonsense\n"}, good.substr(0, good.size() / 2),
                                     std::string{good}.replace(good.size() / 3, 1, "z"), good + good}) {
    std::ofstream{only_file()} << damaged;
    DecompositionCache later;
    later.keep_in(folder_);
    expect_same(later.find_or("a", answer), answer());
    EXPECT_EQ(later.counts().computed, 1u) << damaged;
  }
}

TEST_F(DecompositionCacheOnDisk, a_folder_that_cannot_be_written_costs_nothing_but_time) {
  DecompositionCache cache;
  cache.keep_in("/proc/no_such_folder");
  expect_same(cache.find_or("a", answer), answer());
}

TEST(decomposition_cache, solids_of_other_sizes_and_places_are_the_same_content) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  std::vector<Vec3> moved;
  for (const Vec3& p : corners) moved.push_back(1e-3 * (p + Vec3{4, 8, 16}));
  const SphereDecompositionOptions few{3, 0.0}, more{4, 0.0};
  DecompositionCache& cache = DecompositionCache::of_program();
  cache.forget();
  const std::size_t before = cache.counts().computed;
  const SphereDecomposition one = decompose_hull(convex_hull(corners), few);
  const SphereDecomposition other = decompose_hull(convex_hull(moved), few);
  EXPECT_EQ(cache.counts().computed, before + 1);
  EXPECT_EQ(one.volume_error, other.volume_error);
  (void)decompose_hull(convex_hull(corners), more);
  EXPECT_EQ(cache.counts().computed, before + 2) << "another number of spheres is another content";
}

}  // namespace
}  // namespace scree
