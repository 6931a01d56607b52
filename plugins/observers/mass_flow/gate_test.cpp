#include "gate.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"

namespace scree {
namespace {

Gate gate(const std::string& toml) { return Gate{options_from_text("gate = " + toml, {Gate::parameter()})}; }

std::string refusal(const std::string& toml) {
  try {
    (void)gate(toml);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(gate, finds_where_and_when_a_way_meets_the_plane) {
  const Gate plane = gate("{type = 'plane', point = [0, 0, 1], normal = [0, 0, -3]}");
  const auto down = plane.passage({0, 0, 4}, {4, 8, 0});
  ASSERT_TRUE(down);
  EXPECT_TRUE(down->forward);
  EXPECT_DOUBLE_EQ(down->fraction, 0.75);
  EXPECT_EQ(down->place, (Vec3{3, 6, 1}));
  const auto up = plane.passage({0, 0, 0}, {0, 0, 2});
  ASSERT_TRUE(up);
  EXPECT_FALSE(up->forward);
  EXPECT_FALSE(plane.passage({0, 0, 2}, {5, 5, 1.5}));
}

TEST(gate, is_open_within_its_edge) {
  const Gate disc = gate("{type = 'disc', centre = [1, 0, 0], normal = [0, 0, 1], radius = 0.5}");
  EXPECT_TRUE(disc.passage({1.49, 0, -1}, {1.49, 0, 1}));
  EXPECT_FALSE(disc.passage({1.4, 0.4, -1}, {1.4, 0.4, 1}));
  const Gate skew = gate("{type = 'rectangle', corner = [1, 1, 0], u = [2, 0, 0], v = [1, 1, 0]}");
  EXPECT_TRUE(skew.passage({3.5, 1.9, -1}, {3.5, 1.9, 1})->forward);
  EXPECT_TRUE(skew.passage({1.1, 1.05, -1}, {1.1, 1.05, 1}));
  EXPECT_FALSE(skew.passage({1.1, 1.9, -1}, {1.1, 1.9, 1})) << "left of the slanted edge";
  EXPECT_FALSE(skew.passage({3.5, 2.1, -1}, {3.5, 2.1, 1}));
}

// Law: whatever way a body takes, passages forward less passages backward are the change of side. Steps end on the plane too.
TEST(gate, sees_every_change_of_side_once) {
  const Gate plane = gate("{type = 'plane', point = [0, 0, 0], normal = [0, 0, 1]}");
  std::mt19937_64 random{1};
  std::uniform_int_distribution<int> height{-2, 2};
  Vec3 place{0, 0, -1};
  int net = 0, seen = 0;
  for (int step = 0; step < 10000; ++step) {
    const Vec3 next{0, 0, 1.0 * height(random)};
    if (const auto passage = plane.passage(place, next)) {
      net += passage->forward ? 1 : -1;
      ++seen;
    }
    place = next;
    ASSERT_EQ(net, place.z >= 0.0 ? 1 : 0);
  }
  EXPECT_GT(seen, 1000);
}

TEST(gate, refuses_what_spans_no_plane) {
  EXPECT_NE(refusal("{type = 'plane', point = [0, 0, 0], normal = [0, 0, 0]}").find("must not be zero"),
            std::string::npos);
  EXPECT_NE(refusal("{type = 'rectangle', corner = [0, 0, 0], u = [1, 0, 0], v = [2, 0, 0]}").find("parallel"),
            std::string::npos);
  EXPECT_NE(refusal("{type = 'disc', centre = [0, 0, 0], normal = [0, 0, 1], radius = 0}").find("radius"),
            std::string::npos);
}

}  // namespace
}  // namespace scree
