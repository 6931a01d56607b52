#include "box_sink.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

constexpr const char* kBox = "lower = [-1, -2, -3]\nupper = [1, 2, 3]\n";

std::vector<char> marked(const std::string& toml) {
  BoxSink sink{options_from_text(toml, BoxSink::parameters())};
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_sphere(1, {0, 0, 0}, 1e-3, 1000.0);
  bodies.add_sphere(2, {1, 2, 3}, 1e-3, 1000.0);  // a corner belongs to the box
  bodies.add_sphere(3, {1.1, 0, 0}, 1e-3, 1000.0);
  bodies.add_sphere(4, {0, -2.1, 0}, 1e-3, 1000.0);
  bodies.add_sphere(5, {0, 0, 3.1}, 1e-3, 1000.0);
  bodies.add_immovable(6, {0, 0, 0}, Motion::fixed);
  bodies.add_immovable(7, {9, 0, 0});
  std::vector<char> remove(bodies.id.size(), 0);
  sink.mark(bodies.view(), 0.0, remove);
  return remove;
}

TEST(box_sink, takes_dynamic_bodies_outside_on_any_axis) {
  EXPECT_EQ(marked(kBox), (std::vector<char>{0, 0, 1, 1, 1, 0, 0}));
}

TEST(box_sink, takes_dynamic_bodies_inside_when_told) {
  EXPECT_EQ(marked(std::string{kBox} + "remove = 'inside'"), (std::vector<char>{1, 1, 0, 0, 0, 0, 0}));
}

TEST(box_sink, says_why_in_one_line) {
  const BoxSink sink{options_from_text(kBox, BoxSink::parameters())};
  EXPECT_EQ(sink.reason(), "left the box from (-1, -2, -3) m to (1, 2, 3) m");
}

TEST(box_sink, refuses_an_empty_box) {
  const Options options = options_from_text("lower = [0, 0, 0]\nupper = [1, 0, 1]", BoxSink::parameters());
  EXPECT_THROW(BoxSink{options}, Error);
}

}  // namespace
}  // namespace scree
