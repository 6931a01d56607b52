// What a second look for contacts asks for, and what it takes.
#include "second_look.hpp"

#include <gtest/gtest.h>

#include <array>

#include "dvi_world.hpp"

namespace scree {
namespace {

using test::World;

/// Two spheres of 1 mm above a floor, 5 mm and 8 mm high.
struct TwoSpheres : World {
  TwoSpheres() {
    add_sphere({0, 0, 5e-3}, 1e-3);
    add_sphere({0, 0, 8e-3}, 1e-3);
  }
};

Contact contact(BodyIndex a, BodyIndex b, std::uint64_t feature, double gap) {
  Contact c;
  c.a = a;
  c.b = b;
  c.feature = feature;
  c.normal = {0, 0, 1};
  c.gap = gap;
  return c;
}

// Law: only a body that impulses move by more than half its radius asks for a second look; a wall never does.
TEST(second_look, slow_bodies_do_not_ask_for_it) {
  TwoSpheres w;
  const std::array<BodyIndex, 2> numbers{1, 2};
  const auto struck = [&](double speed) {
    const std::array<Twist, 2> change{Twist{}, Twist{{0, 0, -speed}, {}}};
    std::vector<BodyIndex> list;
    dvi::find_struck(w.host.state().view, numbers, change, 1e-3, list);
    return list;
  };
  EXPECT_TRUE(struck(0.49).empty());
  EXPECT_EQ(struck(0.51), std::vector<BodyIndex>{2});
  const std::array<BodyIndex, 1> wall{0};
  const std::array<Twist, 1> fast{Twist{{0, 0, 10}, {}}};
  std::vector<BodyIndex> list;
  dvi::find_struck(w.host.state().view, wall, fast, 1e-3, list);
  EXPECT_TRUE(list.empty());
}

// Law: of the contacts of a second look those with walls join that would be crossed, in order; neither those that are known,
// nor those of two grains, nor those that stay open or are crossed by less than a quarter of the radius.
TEST(second_look, takes_walls_that_would_be_crossed) {
  TwoSpheres w;
  const BodyView bodies = w.host.state().view;
  const std::array<Vec3, 3> velocity{Vec3{}, Vec3{0, 0, -5}, Vec3{0, 0, -1}}, spin{};
  std::vector<Contact> contacts{contact(0, 1, 4, 4e-3), contact(1, 2, 0, 1e-3)};
  const std::vector<Contact> found{contact(0, 1, 3, 4e-3), contact(0, 1, 4, 4e-3), contact(0, 1, 5, 4.8e-3),
                                   contact(0, 2, 0, 7e-3), contact(1, 2, 0, 1e-3), contact(1, 2, 1, 1e-3)};
  EXPECT_TRUE(dvi::add_crossed(bodies, found, {velocity, spin}, 1e-3, contacts));
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0].feature, 3u);
  EXPECT_EQ(contacts[1].feature, 4u);
  EXPECT_EQ(contacts[2].a, 1u);
  EXPECT_FALSE(dvi::add_crossed(bodies, found, {velocity, spin}, 1e-3, contacts)) << "all are known now";
}

}  // namespace
}  // namespace scree
