#include "scree/config/resolved.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scree/config/validate.hpp"

namespace scree {
namespace {

std::vector<Parameter> feed_parameters() {
  const std::vector<Variant> sizes{
      {"constant", "", {Parameter::number("value", "m", "")}},
      {"uniform", "", {Parameter::number("from", "m", ""), Parameter::number("to", "m", "").by_default(1.0)}}};
  return {
      Parameter::number("rate", "1/s", "of particles"),
      Parameter::integer("seed", "").by_default(1),
      Parameter::boolean("align", "").by_default(true),
      Parameter::text("note", "").by_default("a \"quoted\" \\ note"),
      Parameter::vector("axis", "1", "").by_default(Vec3{0, 0.5, -1}),
      Parameter::numbers("times", "s", "").optional(),
      Parameter::texts("groups", "").optional(),
      Parameter::table("zone", {Parameter::number("width", "m", "").by_default(1e-300)}, ""),
      Parameter::tables("segments", {Parameter::number("length", "m", ""), Parameter::variant("size", sizes, "")}, "")
          .optional(),
      Parameter::variant("size", sizes, "").with_shorthand("constant", "value").by_default(0.1),
      Parameter::columns("attributes", sizes, "any", "").with_shorthand("constant", "value").optional()};
}

TEST(resolved, json_holds_every_default_and_leaves_out_what_has_no_value) {
  const Options options = options_from_text("rate = '36 1/min'", feed_parameters());
  const nlohmann::json expected = {{"rate", 0.6},
                                   {"seed", 1},
                                   {"align", true},
                                   {"note", "a \"quoted\" \\ note"},
                                   {"axis", {0.0, 0.5, -1.0}},
                                   {"zone", {{"width", 1e-300}}},
                                   {"size", {{"type", "constant"}, {"value", 0.1}}}};
  EXPECT_EQ(nlohmann::json::parse(to_json_text(options)), expected);
}

TEST(resolved, toml_validates_to_equal_options) {
  for (const char* text :
       {"rate = 1", "rate = '1 1/h'\ntimes = [0.1, 1e300]\ngroups = ['a', '\\u', \"\\t\"]\nsize = '3 mm'",
        "rate = 1\nattributes = { 'odd key.x' = 3, charge = { type = 'uniform', from = 0.3 } }\n"
        "[[segments]]\nlength = 1\nsize = { type = 'uniform', from = 1 }\n[[segments]]\nlength = 2\n"
        "size = { type = 'constant', value = 4 }",
        "rate = 1\nsegments = []\nattributes = {}"}) {
    const Options once = options_from_text(text, feed_parameters());
    const Options twice = options_from_text(to_toml_text(once), feed_parameters());
    EXPECT_EQ(to_json_text(once), to_json_text(twice)) << to_toml_text(once);
  }
}

TEST(resolved, a_plugins_own_name_comes_first) {
  Options options = options_from_text("rate = 1", {Parameter::number("rate", "1/s", "")});
  options.set_type("emitter");
  EXPECT_EQ(to_json_text(options, -1), R"({"type":"emitter","rate":1.0})");
  EXPECT_EQ(to_toml_text(options), "type = \"emitter\"\nrate = 1.0\n");
}

TEST(resolved, default_options_leave_out_what_is_required) {
  const Options options = default_options(feed_parameters());
  EXPECT_FALSE(options.has("rate"));
  EXPECT_EQ(options.integer("seed"), 1);
  EXPECT_EQ(options.table("size").number("value"), 0.1);
}

}  // namespace
}  // namespace scree
