#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "scree/model/body_store.hpp"
#include "support/memory_state.hpp"

namespace scree {
namespace {

NewBody at(double x) {
  NewBody body;
  body.pose.position = {x, 0, 0};
  return body;
}

TEST(BodyStore, ids_are_stable_while_bodies_come_and_go) {
  BodyStore bodies;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bodies.add(at(i)), static_cast<BodyId>(i));
  const std::vector<char> remove{0, 1, 0, 1, 0};
  bodies.remove(remove);
  EXPECT_EQ(bodies.add(at(9)), 5u) << "an id is never used twice";
  const BodyView view = bodies.view();
  ASSERT_EQ(view.size(), 4u);
  EXPECT_EQ(std::vector<BodyId>(view.id.begin(), view.id.end()), (std::vector<BodyId>{0, 2, 4, 5}));
  EXPECT_EQ(view.position[2].x, 4.0);
  EXPECT_EQ(bodies.find(4), 2);
  EXPECT_EQ(bodies.find(3), -1);
}

TEST(BodyStore, attributes_follow_their_bodies) {
  BodyStore bodies;
  const AttributeId charge = bodies.attributes().declare({"charge", "C", "", 1.0, {}});
  for (int i = 0; i < 3; ++i) {
    NewBody body = at(i);
    if (i == 2) body.attributes = {{charge, 7.0}};
    bodies.add(body);
  }
  const AttributeId late = bodies.attributes().declare({"age", "s", "", -1.0, {}});
  const std::vector<char> remove{1, 0, 0};
  bodies.remove(remove);
  EXPECT_EQ(bodies.attributes().column(charge)[0], 1.0);
  EXPECT_EQ(bodies.attributes().column(charge)[1], 7.0);
  EXPECT_EQ(bodies.attributes().column(late)[1], -1.0) << "a late column reaches the bodies that exist";
}

TEST(BodyStore, hash_sees_a_single_bit) {
  BodyStore bodies;
  bodies.add(at(1.0));
  const std::uint64_t before = bodies.hash();
  bodies.state().position[0].x = std::nextafter(1.0, 2.0);
  EXPECT_NE(bodies.hash(), before);
}

// I_world = R diag(I) R^T: turned by 90 degrees about z, x and y change places.
TEST(Body, inverse_inertia_turns_with_the_body) {
  BodyStore bodies;
  NewBody body = at(0);
  body.inertia = {1.0, 2.0, 4.0};
  body.pose.orientation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  bodies.add(body);
  const Mat3 inverse = inverse_inertia(bodies.view(), 0);
  EXPECT_NEAR(inverse.row0.x, 0.5, 1e-15);
  EXPECT_NEAR(inverse.row1.y, 1.0, 1e-15);
  EXPECT_NEAR(inverse.row2.z, 0.25, 1e-15);
  EXPECT_NEAR(inverse.row0.y, 0.0, 1e-15);
}

TEST(Attributes, unknown_names_are_refused) {
  Attributes attributes;
  EXPECT_THROW(static_cast<void>(attributes.id("charge")), std::out_of_range);
}

// A wrong charge went unnoticed where states were compared. What only observers write does not count.
TEST(BodyStore, the_hash_sees_attributes_but_not_what_observers_write) {
  const auto hash = [](double charge, double seen, bool is_observed) {
    BodyStore store;
    AttributeId bin = 0;
    if (is_observed) bin = store.attributes().declare({"bin", "1", "where it fell", 0.0, {"observer:bins"}});
    const AttributeId column = store.attributes().declare({"charge", "C", "", 0.0, {"force_field:corona"}});
    store.add({});
    store.attributes().column(column)[0] = charge;
    if (is_observed) store.attributes().column(bin)[0] = seen;
    return store.hash();
  };
  EXPECT_NE(hash(1e-9, 0.0, false), hash(2e-9, 0.0, false));
  EXPECT_EQ(hash(1e-9, 0.0, true), hash(1e-9, 0.0, false));
  EXPECT_EQ(hash(1e-9, 7.0, true), hash(1e-9, 0.0, true));
}

// A column that most scenes do without: there from the first body that has one, for all bodies.
TEST(BodyStore, surface_motions_exist_from_the_first_conveyor_and_follow_their_bodies) {
  BodyStore store;
  store.add(at(0));
  EXPECT_TRUE(store.view().surface_motion.empty());
  EXPECT_EQ(surface_motion(store.view(), 0), Twist{});
  NewBody belt = at(1);
  belt.surface_motion = {{1, 0, 0}, {0, 0, 2}};
  belt.pose.orientation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  store.add(belt);
  store.add(at(2));
  ASSERT_EQ(store.view().surface_motion.size(), 3u);
  EXPECT_EQ(store.view().surface_motion[0], Twist{});
  EXPECT_EQ(store.view().surface_motion[1], belt.surface_motion);
  // World: x of the body is y.
  EXPECT_NEAR(surface_motion(store.view(), 1).linear.y, 1.0, 1e-15);
  EXPECT_NEAR(surface_motion(store.view(), 1).angular.z, 2.0, 1e-15);

  test::MemoryState state;
  test::MemoryWriter writer{state};
  store.save(writer);
  BodyStore loaded;
  loaded.load(test::MemoryReader{state});
  EXPECT_EQ(loaded.hash(), store.hash());
  store.remove(std::vector<char>{1, 0, 0});
  EXPECT_EQ(store.view().surface_motion[0], belt.surface_motion);
  EXPECT_NE(loaded.hash(), store.hash());
}

}  // namespace
}  // namespace scree
