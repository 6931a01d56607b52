#include "analysis/body_memory.hpp"

#include <gtest/gtest.h>

#include "scree/state/memory_state.hpp"
#include "support/allocation_count.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

struct Seen {
  static constexpr std::size_t kNumbers = 1;
  double times = 0.0;
  [[nodiscard]] std::array<double, 1> numbers() const { return {times}; }
  static Seen of(std::span<const double> n) { return {n[0]}; }
};

test::TestBodies bodies_with(Attributes& attributes, std::initializer_list<BodyId> ids) {
  test::TestBodies bodies{attributes};
  bodies.add_immovable(0, {});
  for (const BodyId id : ids) bodies.add_sphere(id, {}, 1e-3, 1000.0);
  return bodies;
}

TEST(body_memory, follows_bodies_that_come_and_go) {
  Attributes attributes;
  BodyMemory<Seen> memory;
  std::vector<BodyId> fresh, gone;
  const auto walk = [&](std::initializer_list<BodyId> ids) {
    const test::TestBodies bodies = bodies_with(attributes, ids);
    fresh.clear();
    gone.clear();
    memory.walk(
        bodies.view(),
        [&](BodyIndex i, Seen& seen, bool is_new) {
          seen.times += 1.0;
          if (is_new) fresh.push_back(bodies.id[i]);
        },
        [&](BodyId id, const Seen&) { gone.push_back(id); });
  };
  walk({2, 3, 5});
  EXPECT_EQ(fresh, (std::vector<BodyId>{2, 3, 5}));
  walk({3, 5, 8});
  EXPECT_EQ(fresh, std::vector<BodyId>{8});
  EXPECT_EQ(gone, std::vector<BodyId>{2});
  MemoryState saved;
  memory.save(saved.writer());
  memory.load(saved.reader());
  walk({3});
  EXPECT_EQ(gone, (std::vector<BodyId>{5, 8}));
  ASSERT_EQ(memory.entries().size(), 1u);
  EXPECT_EQ(memory.entries()[0].value.times, 3.0);
}

TEST(body_memory, needs_no_memory_from_step_to_step) {
  Attributes attributes;
  const test::TestBodies bodies = bodies_with(attributes, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  const BodyView view = bodies.view();
  BodyMemory<Seen> memory;
  const auto look = [&] { memory.walk(view, [](BodyIndex, Seen& seen, bool) { seen.times += 1.0; }); };
  look();
  look();
  const std::uint64_t before = test::allocation_count();
  for (int step = 0; step < 100; ++step) look();
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace scree
