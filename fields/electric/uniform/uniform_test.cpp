#include "uniform.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"

namespace scree {
namespace {

TEST(uniform_field, is_the_same_everywhere_and_its_potential_falls_along_it) {
  const UniformField uniform{
      options_from_text("field = [2.0, -4.0, 8.0]\norigin = [1.0, 0.0, 0.0]", UniformField::parameters())};
  const Vec3 position[] = {{1.0, 0.0, 0.0}, {1.5, 0.0, 0.0}, {1.0, 0.25, 0.5}};
  Vec3 field[3];
  double potential[3];
  uniform.evaluate(position, 0.0, field, potential);
  for (const Vec3& e : field) EXPECT_EQ(e, (Vec3{2.0, -4.0, 8.0}));
  // Powers of two: exact.
  EXPECT_EQ(potential[0], 0.0);
  EXPECT_EQ(potential[1], -1.0);
  EXPECT_EQ(potential[2], -3.0);
}

}  // namespace
}  // namespace scree
