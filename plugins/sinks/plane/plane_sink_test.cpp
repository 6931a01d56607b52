#include "plane_sink.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

TEST(plane_sink, takes_dynamic_bodies_beyond_the_plane_and_no_others) {
  PlaneSink sink{options_from_text("point = [0, '-60 cm', 0]\nnormal = [0, -3, 0]", PlaneSink::parameters())};
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_sphere(1, {0, -0.5, 0}, 1e-3, 1000.0);
  bodies.add_sphere(2, {9, -0.7, -4}, 1e-3, 1000.0);
  bodies.add_immovable(3, {0, -2, 0});
  bodies.add_sphere(4, {0, 5, 0}, 1e-3, 1000.0);
  std::vector<char> remove{0, 0, 0, 1};  // the last one was marked by another sink
  sink.mark(bodies.view(), 0.0, remove);
  EXPECT_EQ(remove, (std::vector<char>{0, 1, 0, 1}));
}

TEST(plane_sink, says_why_in_one_line) {
  const PlaneSink sink{options_from_text("point = [0, -0.6, 0]\nnormal = [0, -1, 0]", PlaneSink::parameters())};
  EXPECT_EQ(sink.reason(), "left through the plane at (0, -0.6, 0) m towards (0, -1, 0)");
}

TEST(plane_sink, refuses_a_normal_without_direction) {
  const Options options = options_from_text("point = [0, 0, 0]\nnormal = [0, 0, 0]", PlaneSink::parameters());
  EXPECT_THROW(PlaneSink{options}, Error);
}

}  // namespace
}  // namespace scree
