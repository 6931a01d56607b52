#include "scree/config/describe_text.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(describe_text, columns_line_up_and_members_are_indented) {
  const std::vector<Variant> sizes{{"constant", "one size", {Parameter::number("value", "m", "diameter").above(0.0)}},
                                   {"point", "no size", {}}};
  const std::vector<Parameter> parameters{
      Parameter::number("radius", "m", "outer radius").above(0.0),
      Parameter::choice("law", {"stokes", "newton"}, "drag coefficient").by_default("stokes"),
      Parameter::vector("wind", "m/s", "of the air").by_default(Vec3{0, 0, 1}),
      Parameter::numbers("weights", "kg", "of the 2 stages").with_count(2).optional(),
      Parameter::variant("size", sizes, "of a grain").with_shorthand("constant", "value").by_default(0.003)};
  EXPECT_EQ(describe_parameters(parameters),
            R"(  radius               number [m]       required         above 0 m        outer radius
  law                  choice           "stokes"         stokes | newton  drag coefficient
  wind                 vector [m/s]     [0.0, 0.0, 1.0]                   of the air
  weights              numbers [kg]     optional         2 entries        of the 2 stages
  size                 table with type  0.003                             of a grain
    type = "constant"                                    or plain: value  one size
      value            number [m]       required         above 0 m        diameter
    type = "point"                                                        no size
)");
}

TEST(describe_text, nothing_gives_nothing) { EXPECT_EQ(describe_parameters({}), ""); }

}  // namespace
}  // namespace scree
