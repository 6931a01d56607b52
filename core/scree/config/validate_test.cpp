#include "scree/config/validate.hpp"

#include <gtest/gtest.h>

#include "scree/config/scene_document.hpp"

namespace scree {
namespace {

std::vector<Parameter> field_parameters() {
  std::vector<Variant> sizes{{"constant", "one size", {Parameter::number("value", "m", "diameter").above(0.0)}},
                             {"uniform",
                              "between two sizes",
                              {Parameter::number("from", "m", "smallest").at_least(0.0),
                               Parameter::number("to", "m", "largest").by_default(1.0)}}};
  return {Parameter::number("radius", "m", "of the roll").above(0.0),
          Parameter::integer("steps", "of time").by_default(10).at_least(1).at_most(100),
          Parameter::boolean("two_way", "acts back").by_default(false),
          Parameter::choice("law", {"stokes", "schiller_naumann"}, "drag coefficient").by_default("stokes"),
          Parameter::vector("wind", "m/s", "of the air").by_default(Vec3{0, 0, 0}),
          Parameter::numbers("weights", "kg", "of the stages").with_count(2).optional(),
          Parameter::texts("groups", "acted on").optional(),
          Parameter::path("file", "with the table").optional(),
          Parameter::table("zone", {Parameter::number("width", "m", "of the zone").by_default(0.5)}, "of charging"),
          Parameter::tables("segments", {Parameter::number("length", "m", "of the segment")}, "in order").optional(),
          Parameter::variant("size", sizes, "of a grain").with_shorthand("constant", "value").by_default(0.003),
          Parameter::columns("attributes", sizes, "1", "of bodies").with_shorthand("constant", "value").optional()};
}

// Names of columns are names in checkpoints.
TEST(validate, a_column_name_with_a_slash_is_refused_where_it_stands) {
  const auto refusal = [](const std::string& name) -> std::string {
    try {
      (void)options_from_text("radius = 0.1\nattributes = { " + name + " = 1.0 }", field_parameters());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("'charge of the grain'"), "");
  EXPECT_NE(refusal("'a/b'").find("has the name 'a/b' in it"), std::string::npos) << refusal("'a/b'");
  EXPECT_NE(refusal("'a/b'").find(":2:"), std::string::npos) << refusal("'a/b'");
  EXPECT_NE(refusal("''").find("at least one sign"), std::string::npos);
}

TEST(validate, silence_gives_the_defaults) {
  const Options options = options_from_text("radius = 0.1", field_parameters());
  EXPECT_EQ(options.number("radius"), 0.1);
  EXPECT_TRUE(options.given("radius"));
  EXPECT_EQ(options.integer("steps"), 10);
  EXPECT_FALSE(options.given("steps"));
  EXPECT_EQ(options.text("law"), "stokes");
  EXPECT_FALSE(options.has("weights"));
  EXPECT_TRUE(options.tables("segments").empty());
  EXPECT_EQ(options.table("zone").number("width"), 0.5);
  EXPECT_EQ(options.table("size").type(), "constant");
  EXPECT_EQ(options.table("size").number("value"), 0.003);
  EXPECT_THROW((void)options.number("weights"), std::logic_error);
  EXPECT_THROW((void)options.number("undescribed"), std::logic_error);
  EXPECT_THROW((void)options.has("undescribed"), std::logic_error);
}

TEST(validate, every_kind_is_read) {
  const Options options = options_from_text(R"(
radius = "3 mm"
steps = 20.0
two_way = true
law = "schiller_naumann"
wind = [1, "20 cm/s", -0.5]
weights = ["5 g", 1]
groups = ["metal", "plastic"]
file = "/data/table.csv"
zone = { width = 2 }
size = { type = "uniform", from = "1 mm", to = "2 mm" }
attributes.small = "1 mm"
attributes.big = { type = "uniform", from = 1 }
[[segments]]
length = 1
[[segments]]
length = "1 cm"
)",
                                            field_parameters());
  EXPECT_EQ(options.number("radius"), 0.003);
  EXPECT_EQ(options.integer("steps"), 20);
  EXPECT_TRUE(options.boolean("two_way"));
  EXPECT_EQ(options.text("law"), "schiller_naumann");
  EXPECT_EQ(options.vector("wind").y, 0.2);
  EXPECT_EQ(options.numbers("weights"), (std::vector<double>{0.005, 1.0}));
  EXPECT_EQ(options.texts("groups"), (std::vector<std::string>{"metal", "plastic"}));
  EXPECT_EQ(options.path("file"), std::filesystem::path{"/data/table.csv"});
  EXPECT_EQ(options.table("zone").number("width"), 2.0);
  EXPECT_EQ(options.table("size").type(), "uniform");
  EXPECT_EQ(options.table("size").number("to"), 0.002);
  ASSERT_EQ(options.tables("segments").size(), 2U);
  EXPECT_EQ(options.tables("segments")[1].number("length"), 0.01);
  const Options& attributes = options.table("attributes");
  EXPECT_EQ(attributes.names(), (std::vector<std::string>{"big", "small"}));
  EXPECT_EQ(attributes.table("small").number("value"), 0.001);
  EXPECT_EQ(attributes.table("big").type(), "uniform");
  EXPECT_EQ(attributes.table("big").number("to"), 1.0);
}

TEST(validate, the_dimension_of_an_attribute_is_checked_once_its_unit_is_known) {
  const Options options = options_from_text("[attributes]\ncharge = '2 nC'\nwidth = '2 mm'\nplain = 3\n",
                                            {Parameter::columns("attributes", {}, "any", "of bodies")});
  const Options& attributes = options.table("attributes");
  EXPECT_EQ(attributes.number("charge"), attributes.number_in("charge", "C"));
  EXPECT_EQ(attributes.number_in("plain", "C"), 3.0);
  try {
    (void)attributes.number_in("width", "C");
    FAIL() << "accepted";
  } catch (const Error& failure) {
    EXPECT_STREQ(
        failure.what(),
        "scene.toml:3:9: 'width': \"2 mm\" is in mm, which cannot be converted to C; write for example \"2 nC\"");
  }
}

TEST(validate, copies_are_deep) {
  Options copy;
  {
    const Options options = options_from_text("radius = 1\nzone.width = 3", field_parameters());
    copy = options;
  }
  EXPECT_EQ(copy.table("zone").number("width"), 3.0);
}

}  // namespace
}  // namespace scree
