#include "scree/config/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace scree {
namespace {

using Json = nlohmann::json;

Json schema_of(const std::vector<Parameter>& parameters) { return Json::parse(parameters_to_schema(parameters)); }

TEST(schema, a_quantity_is_a_number_in_range_or_a_string) {
  const Json schema = schema_of({Parameter::number("radius", "m", "of the roll").above(0.0).at_most(2.0)});
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json({"radius"}));
  const Json& radius = schema["properties"]["radius"];
  EXPECT_EQ(radius["description"], "of the roll [m]");
  EXPECT_EQ(radius["anyOf"][0], Json({{"type", "number"}, {"exclusiveMinimum", 0.0}, {"maximum", 2.0}}));
  EXPECT_EQ(radius["anyOf"][1]["type"], "string");
}

TEST(schema, each_kind_has_its_type) {
  const Json properties = schema_of(
      {Parameter::integer("steps", "").at_least(1).by_default(10), Parameter::boolean("two_way", "").by_default(false),
       Parameter::choice("law", {"a", "b"}, "").by_default("a"), Parameter::text("note", "").optional(),
       Parameter::vector("wind", "m/s", "").by_default(Vec3{0, 0, 1}),
       Parameter::numbers("weights", "kg", "").with_count(2).optional(),
       Parameter::texts("groups", "").with_at_least_count(1).optional()})["properties"];
  EXPECT_EQ(properties["steps"], Json({{"type", "integer"}, {"minimum", 1.0}, {"default", 10}, {"description", ""}}));
  EXPECT_EQ(properties["two_way"]["type"], "boolean");
  EXPECT_EQ(properties["law"]["enum"], Json({"a", "b"}));
  EXPECT_EQ(properties["note"]["type"], "string");
  EXPECT_EQ(properties["wind"]["minItems"], 3);
  EXPECT_EQ(properties["wind"]["maxItems"], 3);
  EXPECT_EQ(properties["wind"]["default"], Json({0.0, 0.0, 1.0}));
  EXPECT_EQ(properties["weights"]["maxItems"], 2);
  EXPECT_EQ(properties["groups"]["minItems"], 1);
  EXPECT_FALSE(properties["groups"].contains("maxItems"));
}

TEST(schema, a_table_is_required_only_for_its_required_members) {
  const Json schema = schema_of({Parameter::table("zone", {Parameter::number("width", "m", "").by_default(1.0)}, ""),
                                 Parameter::table("roll", {Parameter::number("radius", "m", "")}, ""),
                                 Parameter::tables("parts", {Parameter::number("length", "m", "")}, "").optional()});
  EXPECT_EQ(schema["required"], Json({"roll"}));
  EXPECT_EQ(schema["properties"]["roll"]["required"], Json({"radius"}));
  EXPECT_EQ(schema["properties"]["roll"]["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["parts"]["anyOf"][0]["type"], "array");
}

TEST(schema, a_variant_is_typed_or_plain) {
  const std::vector<Variant> sizes{{"constant", "", {Parameter::number("value", "m", "").above(0.0)}},
                                   {"point", "", {}}};
  const Json schema = schema_of({Parameter::variant("size", sizes, "").with_shorthand("constant", "value"),
                                 Parameter::columns("attributes", sizes, "any", "").optional()});
  const Json& choices = schema["properties"]["size"]["anyOf"];
  ASSERT_EQ(choices.size(), 4U);
  EXPECT_EQ(choices[0]["properties"]["type"]["const"], "constant");
  EXPECT_EQ(choices[0]["required"], Json({"type", "value"}));
  EXPECT_EQ(choices[1]["anyOf"][0]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(choices[2]["properties"]["type"]["const"], "point");
  EXPECT_EQ(choices[3]["enum"], Json({"point"}));
  EXPECT_TRUE(schema["properties"]["attributes"]["additionalProperties"].contains("anyOf"));
}

TEST(schema, a_scene_offers_each_plugin_with_its_own_settings) {
  const std::vector<SchemaSection> sections{
      {.key = "time", .help = "of the run", .required = true, .parameters = {Parameter::number("end", "s", "")}},
      {.key = "force_field",
       .help = "on all bodies",
       .is_list = true,
       .parameters = {Parameter::text("name", "").optional()},
       .plugins = {{"drag", "of the air", {Parameter::number("viscosity", "Pa s", "")}},
                   {"gravity", "of the earth", {}}}},
      {.key = "material",
       .help = "by name",
       .parameters = {Parameter::number("density", "kg/m3", "")},
       .is_named = true}};
  const std::vector<Parameter> root{Parameter::texts("plugins", "files").optional()};
  const Json schema = Json::parse(scene_schema(sections, root));
  EXPECT_EQ(schema["required"], Json({"time"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_TRUE(schema["properties"].contains("include"));
  EXPECT_TRUE(schema["properties"].contains("plugins"));
  EXPECT_EQ(schema["properties"]["time"]["$ref"], "#/$defs/time");
  EXPECT_EQ(schema["properties"]["force_field"]["anyOf"][0]["items"]["$ref"], "#/$defs/force_field");
  EXPECT_EQ(schema["properties"]["material"]["additionalProperties"]["$ref"], "#/$defs/material");
  EXPECT_EQ(schema["$defs"]["material"]["required"], Json({"density"}));
  const Json& plugins = schema["$defs"]["force_field"]["oneOf"];
  ASSERT_EQ(plugins.size(), 2U);
  EXPECT_EQ(plugins[0]["properties"]["type"]["const"], "drag");
  EXPECT_EQ(plugins[0]["required"], Json({"type", "viscosity"}));
  EXPECT_TRUE(plugins[0]["properties"].contains("name"));
  EXPECT_FALSE(plugins[1]["properties"].contains("viscosity"));
  EXPECT_EQ(plugins[1]["additionalProperties"], false);
}

}  // namespace
}  // namespace scree
