// Pairs of single spheres in lists of any length, against the definition of a contact of two spheres.
#include "single_spheres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

/// Colliders that are spheres; names without any order.
struct Balls {
  std::vector<BoundingBall> ball;
  std::vector<BodyIndex> body;
  std::vector<std::uint32_t> ordinal;

  explicit Balls(RandomNumbers& random, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      ball.push_back({random.in_cube(0.3), random.uniform(0.05, 0.2)});
      body.push_back(static_cast<BodyIndex>(random.below(1000)));
      ordinal.push_back(static_cast<std::uint32_t>(random.below(10)));
    }
  }
  [[nodiscard]] ContactBuffer collide(std::span<const ColliderPair> pairs) const {
    ColliderView view;
    view.ball = ball;
    view.body = body;
    view.ordinal = ordinal;
    ContactBuffer out(1);  // what is there already stays
    sphere_cluster::collide_spheres(view, pairs, out);
    EXPECT_EQ(out.front().gap, 0.0);
    out.erase(out.begin());
    return out;
  }
};

// Law: two spheres touch where the gap of their surfaces is below the reach; the normal points from a to b, the point lies on it
// midway between the surfaces. Contacts come pair after pair, however many pairs there are.
TEST(SingleSpheres, every_pair_within_reach_once_in_order) {
  RandomNumbers random{5};
  std::size_t seen = 0, far = 0;
  for (std::size_t count = 0; count < 300; ++count) {
    const Balls balls{random, 40};
    std::vector<ColliderPair> pairs;
    for (std::size_t k = 0; k < count; ++k) {
      const auto a = static_cast<ColliderIndex>(random.below(39));
      const auto b = a + 1 + static_cast<ColliderIndex>(random.below(39 - a));
      pairs.push_back({a, b, random.uniform(0.0, 0.1)});
    }
    const ContactBuffer contacts = balls.collide(pairs);
    std::size_t at = 0;
    for (const ColliderPair& pair : pairs) {
      const BoundingBall &a = balls.ball[pair.a], &b = balls.ball[pair.b];
      const Vec3 way = b.centre - a.centre;
      const double gap = norm(way) - a.radius - b.radius;
      if (gap >= pair.reach) {
        ++far;
        continue;
      }
      ASSERT_LT(at, contacts.size());
      const Contact& contact = contacts[at++];
      EXPECT_EQ(contact.a, balls.body[pair.a]);
      EXPECT_EQ(contact.b, balls.body[pair.b]);
      EXPECT_EQ(contact.primitive_a, balls.ordinal[pair.a]);
      EXPECT_EQ(contact.primitive_b, balls.ordinal[pair.b]);
      EXPECT_EQ(contact.feature, 0u);
      // Rounding of lengths of one; the direction of centres a tenth apart loses a digit.
      EXPECT_NEAR(contact.gap, gap, 1e-15);
      EXPECT_LT(norm(contact.normal - normalized(way)), 1e-14);
      const Vec3 on_a = a.centre + a.radius * normalized(way), on_b = b.centre - b.radius * normalized(way);
      EXPECT_LT(norm(contact.point - 0.5 * (on_a + on_b)), 1e-14);
      ++seen;
    }
    EXPECT_EQ(at, contacts.size());
  }
  EXPECT_GT(seen, 5000u);
  EXPECT_GT(far, 5000u);
}

// Law: one centre for two spheres gives a unit normal; a sphere without a place hides none of those beside it.
TEST(SingleSpheres, odd_pairs_spoil_no_others) {
  RandomNumbers random{6};
  Balls balls{random, 6};
  balls.ball[1] = balls.ball[0];
  balls.ball[2].centre.x = std::numeric_limits<double>::quiet_NaN();
  balls.ball[4] = {balls.ball[3].centre + Vec3{0, 0, 0.1}, 0.1};
  balls.ball[3].radius = 0.1;
  const std::vector<ColliderPair> pairs{{0, 1, 0.0}, {0, 2, 0.0}, {3, 4, 0.0}, {3, 4, 0.0}, {3, 4, 0.0}};
  const ContactBuffer contacts = balls.collide(pairs);
  ASSERT_GE(contacts.size(), 4u);
  EXPECT_EQ(norm(contacts[0].normal), 1.0);
  EXPECT_EQ(contacts[0].gap, -2.0 * balls.ball[0].radius);
  for (std::size_t k = contacts.size() - 3; k < contacts.size(); ++k) {
    EXPECT_NEAR(contacts[k].gap, -0.1, 1e-15);
    EXPECT_EQ(contacts[k].normal, (Vec3{0, 0, 1}));
  }
}

}  // namespace
}  // namespace scree
