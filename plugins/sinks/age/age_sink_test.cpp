#include "age_sink.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

AgeSink make_sink() { return AgeSink{options_from_text("age = '300 ms'", AgeSink::parameters())}; }

// The ids that a sink marks among spheres with these ids, and a fixed body with id 99.
std::vector<BodyId> taken(AgeSink& sink, const std::vector<BodyId>& ids, double time) {
  Attributes attributes;
  test::TestBodies bodies{attributes};
  for (const BodyId id : ids) bodies.add_sphere(id, {}, 1e-3, 1000.0);
  bodies.add_immovable(99, {});
  std::vector<char> remove(bodies.id.size(), 0);
  sink.mark(bodies.view(), time, remove);
  std::vector<BodyId> marked;
  for (std::size_t i = 0; i < remove.size(); ++i) {
    if (remove[i] != 0) marked.push_back(bodies.id[i]);
  }
  return marked;
}

TEST(age_sink, takes_each_dynamic_body_when_its_own_time_is_over) {
  AgeSink sink = make_sink();
  EXPECT_EQ(taken(sink, {1, 2}, 0.0), (std::vector<BodyId>{}));
  EXPECT_EQ(taken(sink, {1, 2, 5}, 0.1), (std::vector<BodyId>{}));
  EXPECT_EQ(taken(sink, {2, 5}, 0.2), (std::vector<BodyId>{}));            // 1 went another way
  EXPECT_EQ(taken(sink, {2, 5, 7}, 0.1 + 0.2), (std::vector<BodyId>{2}));  // 0.30000000000000004
  EXPECT_EQ(taken(sink, {5, 7}, 0.4), (std::vector<BodyId>{5}));
}

TEST(age_sink, goes_on_from_a_checkpoint) {
  AgeSink sink = make_sink();
  (void)taken(sink, {1}, 0.0);
  (void)taken(sink, {1, 2}, 0.2);
  MemoryState saved;
  sink.save(saved.writer());
  AgeSink resumed = make_sink();
  resumed.load(saved.reader());
  EXPECT_EQ(taken(resumed, {1, 2}, 0.35), (std::vector<BodyId>{1}));
}

TEST(age_sink, says_why_in_one_line) { EXPECT_EQ(make_sink().reason(), "older than 0.3 s"); }

}  // namespace
}  // namespace scree
