// Which quantity of attraction a law reads, and which it leaves unread.
#include "granular/cohesion.hpp"

#include <gtest/gtest.h>

namespace scree::granular {
namespace {

constexpr ContactMaterial kSurface{.surface_energy = 0.05}, kDensity{.cohesion_energy_density = 1e5},
    kBoth{.surface_energy = 0.05, .cohesion_energy_density = 1e5};

TEST(cohesion, leaves_the_other_quantity_unread) {
  ASSERT_TRUE(unread_cohesion(Cohesion::sced, kSurface, true));
  EXPECT_EQ(unread_cohesion(Cohesion::sced, kSurface, true)->key, "surface_energy");
  for (const Cohesion model : {Cohesion::dmt, Cohesion::jkr}) {
    ASSERT_TRUE(unread_cohesion(model, kDensity, true));
    EXPECT_EQ(unread_cohesion(model, kDensity, true)->key, "cohesion_energy_density");
  }
}

TEST(cohesion, is_content_with_the_quantity_that_it_reads) {
  EXPECT_FALSE(unread_cohesion(Cohesion::sced, kDensity, true));
  for (const Cohesion model : {Cohesion::dmt, Cohesion::jkr}) EXPECT_FALSE(unread_cohesion(model, kSurface, true));
  // A scene that compares models states both.
  for (const Cohesion model : {Cohesion::sced, Cohesion::dmt, Cohesion::jkr}) {
    EXPECT_FALSE(unread_cohesion(model, kBoth, true));
    EXPECT_FALSE(unread_cohesion(model, {.friction = 0.5}, true));
  }
}

TEST(cohesion, of_none_leaves_both_unread_and_says_what_reads_them) {
  for (const ContactMaterial& pair : {kSurface, kBoth}) {
    ASSERT_TRUE(unread_cohesion(Cohesion::none, pair, true));
    EXPECT_EQ(unread_cohesion(Cohesion::none, pair, true)->key, "surface_energy");
    EXPECT_NE(unread_cohesion(Cohesion::none, pair, true)->sentence.find("\"dmt\" or \"jkr\""), std::string::npos);
  }
  ASSERT_TRUE(unread_cohesion(Cohesion::none, kDensity, false));
  EXPECT_EQ(unread_cohesion(Cohesion::none, kDensity, false)->key, "cohesion_energy_density");
  EXPECT_NE(unread_cohesion(Cohesion::none, kDensity, false)->sentence.find("\"sced\""), std::string::npos);
  EXPECT_FALSE(unread_cohesion(Cohesion::none, {.friction = 0.5}, true));
}

TEST(cohesion, warns_when_nothing_says_how_strong_it_is) {
  const auto warns = [](Cohesion cohesion, const ContactMaterial& contact) {
    Materials materials;
    Material material;
    material.name = "a";
    material.contact = contact;
    materials.add(material);
    return idle_cohesion(cohesion, materials, {"scene.toml", 3, 1}).value_or("");
  };
  for (const Cohesion model : {Cohesion::dmt, Cohesion::jkr}) {
    EXPECT_EQ(warns(model, kSurface), "");
    EXPECT_NE(warns(model, kDensity).find("surface_energy of all pairs of materials is 0"), std::string::npos);
  }
  EXPECT_EQ(warns(Cohesion::sced, kDensity), "");
  EXPECT_TRUE(warns(Cohesion::sced, {}).starts_with("warning: scene.toml:3:1: cohesion = \"sced\" has no effect"));
  EXPECT_EQ(warns(Cohesion::none, {}), "");
}

// A law without a modulus has no jkr, and does not advise it.
TEST(cohesion, advises_what_the_law_has) {
  EXPECT_EQ(unread_cohesion(Cohesion::sced, kSurface, false)->sentence.find("jkr"), std::string::npos);
  EXPECT_NE(unread_cohesion(Cohesion::sced, kSurface, true)->sentence.find("jkr"), std::string::npos);
}

}  // namespace
}  // namespace scree::granular
