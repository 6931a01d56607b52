// Golden sentences: what people read when a scene is wrong. Each names the place, the fault, and the way out.
#include <gtest/gtest.h>

#include "scree/config/scene_document.hpp"
#include "scree/config/validate.hpp"

namespace scree {
namespace {

std::vector<Parameter> drag_parameters() {
  const std::vector<Variant> sizes{
      {"constant", "one size", {Parameter::number("value", "m", "diameter").above(0.0)}},
      {"uniform", "between two sizes", {Parameter::number("from", "m", "smallest"), Parameter::number("to", "m", "")}}};
  return {Parameter::number("radius", "m", "of the roll").above(0.0).by_default(0.1),
          Parameter::number("share", "1", "of metal").at_least(0.0).at_most(1.0).by_default(0.5),
          Parameter::integer("steps", "of time").by_default(10).at_least(1),
          Parameter::boolean("two_way", "acts back").by_default(false),
          Parameter::choice("law", {"stokes", "schiller_naumann"}, "drag coefficient").by_default("stokes"),
          Parameter::vector("wind", "m/s", "of the air").by_default(Vec3{0, 0, 0}),
          Parameter::numbers("weights", "kg", "of stages").with_count(2).above(0.0).optional(),
          Parameter::numbers("times", "s", "of output").with_at_least_count(1).optional(),
          Parameter::texts("groups", "acted on").optional(),
          Parameter::path("file", "with the table").optional(),
          Parameter::table("zone", {Parameter::number("width", "m", "of the zone").by_default(0.5)}, "of charging"),
          Parameter::tables("segments", {Parameter::number("length", "m", "of it")}, "in order").optional(),
          Parameter::variant("size", sizes, "of grains").with_shorthand("constant", "value").by_default(0.003),
          Parameter::variants("mix", sizes, "of sizes").optional(),
          Parameter::columns("attributes", {}, "any", "of bodies").optional()};
}

std::string refusal(const std::string& toml, const std::vector<Parameter>& parameters = drag_parameters()) {
  try {
    const SceneDocument document = SceneDocument::parse(toml);
    (void)validate(document.root(), parameters, "force_field 'drag'");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::usage);
    return failure.what();
  }
  return "accepted";
}

TEST(messages, unknown_keys_get_a_suggestion_and_the_valid_keys) {
  const std::string keys =
      "alid keys: 'radius', 'share', 'steps', 'two_way', 'law', 'wind', 'weights', 'times', 'groups', 'file', 'zone', "
      "'segments', 'size', 'mix' and 'attributes'";
  EXPECT_EQ(refusal("share = 0.5\nraduis = 1"),
            "scene.toml:2:1: force_field 'drag' has no key 'raduis'; did you mean 'radius'? V" + keys);
  EXPECT_EQ(refusal("temperature = 1"), "scene.toml:1:1: force_field 'drag' has no key 'temperature'; v" + keys);
  EXPECT_EQ(
      refusal("[zone]\nwdth = 1"),
      "scene.toml:2:1: 'zone' of force_field 'drag' has no key 'wdth'; did you mean 'width'? Valid keys: 'width'");
  EXPECT_EQ(refusal("size = { type = 'uniform', form = 1 }"),
            "scene.toml:1:28: 'size' of force_field 'drag' has no key 'form'; did you mean 'from'? Valid keys: 'type', "
            "'from' and 'to'");
}

TEST(messages, missing_keys_are_named_with_an_example) {
  EXPECT_EQ(refusal("", {Parameter::number("radius", "m", "outer radius of the roll")}),
            "scene.toml:1:1: force_field 'drag' lacks the required key 'radius' (outer radius of the roll); add for "
            "example: radius = \"3 mm\"");
  EXPECT_EQ(refusal("[[segments]]"),
            "scene.toml:1:1: entry 0 of 'segments' of force_field 'drag' lacks the required key 'length' (of it); add "
            "for example: length = \"3 mm\"");
  EXPECT_EQ(refusal("\nsize = {}"),
            "scene.toml:2:8: 'size' of force_field 'drag' needs a 'type'; valid are 'constant' and 'uniform'");
}

TEST(messages, wrong_kinds_say_what_is_needed_and_what_is_there) {
  EXPECT_EQ(refusal("radius = true"),
            "scene.toml:1:10: 'radius' of force_field 'drag' must be a number in m or a quantity such as \"3 mm\", but "
            "is a boolean");
  EXPECT_EQ(refusal("steps = 'many'"),
            "scene.toml:1:9: 'steps' of force_field 'drag' must be an integer, but is a string");
  EXPECT_EQ(refusal("steps = 2.5"), "scene.toml:1:9: 'steps' of force_field 'drag' must be an integer, but is 2.5");
  EXPECT_EQ(refusal("two_way = 1"),
            "scene.toml:1:11: 'two_way' of force_field 'drag' must be true or false, but is an integer");
  EXPECT_EQ(refusal("wind = [1, 2]"),
            "scene.toml:1:8: 'wind' of force_field 'drag' must be a list of three numbers in m/s, such as [0, 0, 1], "
            "but is a list of 2");
  EXPECT_EQ(refusal("groups = ['metal', 3]"),
            "scene.toml:1:20: 'groups' of force_field 'drag', entry 1 must be a list of strings, but is an integer");
  EXPECT_EQ(refusal("file = ''"),
            "scene.toml:1:8: 'file' of force_field 'drag' is empty, but must be a string with the name of a file");
  EXPECT_EQ(refusal("zone = 1"),
            "scene.toml:1:8: 'zone' of force_field 'drag' must be a table [zone], but is an integer");
  EXPECT_EQ(refusal("segments = 'x'"),
            "scene.toml:1:12: 'segments' of force_field 'drag' must be a list of tables [[segments]], but is a string");
  EXPECT_EQ(refusal("attributes = 1"),
            "scene.toml:1:14: 'attributes' of force_field 'drag' must be a table [attributes] of names and their "
            "values, but is an integer");
  EXPECT_EQ(refusal("mix = [1.0]"),
            "scene.toml:1:8: entry 0 of 'mix' of force_field 'drag' must be a list of tables with a 'type', one of "
            "'constant' and 'uniform', but is a number");
  EXPECT_EQ(refusal("file = 1979-05-27"),
            "scene.toml:1:8: 'file' of force_field 'drag' must be a string with the name of a file, but is a date");
}

TEST(messages, units_are_refused_with_a_valid_one) {
  EXPECT_EQ(refusal("radius = '3 kg'"),
            "scene.toml:1:10: 'radius' of force_field 'drag': \"3 kg\" is in kg, which cannot be converted to m; write "
            "for example \"3 mm\"");
  EXPECT_EQ(refusal("wind = [0, '3', 0]"),
            "scene.toml:1:12: 'wind' of force_field 'drag', entry 1: \"3\" has no unit where a quantity in m/s is "
            "needed; write for example \"20 cm/s\"");
}

TEST(messages, ranges_say_what_is_valid) {
  EXPECT_EQ(refusal("radius = '-3 mm'"),
            "scene.toml:1:10: 'radius' of force_field 'drag' is -0.003 m, which is out of range; valid is above 0 m");
  EXPECT_EQ(refusal("radius = 0").substr(0, 55), "scene.toml:1:10: 'radius' of force_field 'drag' is 0 m,");
  EXPECT_EQ(refusal("share = '150 %'"),
            "scene.toml:1:9: 'share' of force_field 'drag' is 1.5, which is out of range; valid is from 0 to 1");
  EXPECT_EQ(refusal("steps = 0"),
            "scene.toml:1:9: 'steps' of force_field 'drag' is 0, which is out of range; valid is at least 1");
  EXPECT_EQ(refusal("weights = [1, 0]"),
            "scene.toml:1:15: 'weights' of force_field 'drag', entry 1 is 0 kg, which is out of range; valid is above "
            "0 kg");
  EXPECT_EQ(refusal("size = 0"),
            "scene.toml:1:8: 'size' of force_field 'drag' is 0 m, which is out of range; valid is above 0 m");
  for (const char* number : {"nan", "inf", "-inf"}) {
    EXPECT_EQ(refusal(std::string{"radius = "} + number),
              "scene.toml:1:10: 'radius' of force_field 'drag' must be a finite number");
  }
}

TEST(messages, counts_say_how_many) {
  EXPECT_EQ(refusal("weights = [1]"),
            "scene.toml:1:11: 'weights' of force_field 'drag' has 1 entry, but must be a list of numbers in kg with 2 "
            "entries");
  EXPECT_EQ(refusal("times = []"),
            "scene.toml:1:9: 'times' of force_field 'drag' has 0 entries, but must be a list of numbers in s with at "
            "least 1 entry");
}

TEST(messages, choices_and_types_get_a_suggestion) {
  EXPECT_EQ(refusal("law = 'stoks'"),
            "scene.toml:1:7: 'law' of force_field 'drag' is \"stoks\", but must be one of 'stokes' and "
            "'schiller_naumann'; did you mean 'stokes'?");
  EXPECT_EQ(refusal("size = { type = 'unifrom', from = 1 }"),
            "scene.toml:1:17: 'size' of force_field 'drag' has the unknown type \"unifrom\"; did you mean 'uniform'? "
            "Valid are 'constant' and 'uniform'");
  EXPECT_EQ(refusal("size = { type = 3 }"),
            "scene.toml:1:17: 'type' of 'size' of force_field 'drag' must be a string, one of 'constant' and "
            "'uniform', but is an integer");
}

TEST(messages, values_of_the_command_line_name_it) {
  const std::vector<std::string> overrides{"radius=3 kg"};
  const SceneDocument document = SceneDocument::parse("", "scene.toml", overrides);
  try {
    (void)validate(document.root(), drag_parameters(), "force_field 'drag'");
    FAIL() << "accepted";
  } catch (const Error& failure) {
    EXPECT_STREQ(failure.what(),
                 "--set radius=3 kg: 'radius' of force_field 'drag': \"3 kg\" is in kg, which cannot be converted to "
                 "m; write for example \"3 mm\"");
  }
}

TEST(messages, readers_can_refuse_at_the_place_of_a_key) {
  const Options options = options_from_text("\nsteps = 3", {Parameter::integer("steps", "of time")});
  EXPECT_STREQ(options.error("steps", "must be even").what(), "scene.toml:2:9: 'steps' must be even");
}

}  // namespace
}  // namespace scree
