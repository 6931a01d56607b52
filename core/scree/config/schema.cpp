#include "scree/config/schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scree/config/units.hpp"
#include "scree/config/value_json.hpp"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDialect = "https://json-schema.org/draft/2020-12/schema";
// What parse_quantity() begins to read: a number, then a unit; units themselves are beyond a pattern.
constexpr const char* kQuantityPattern = R"(^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*[^0-9\s].*$)";
constexpr const char* kPureQuantityPattern =
    R"(^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*([^0-9\s].*)?$)";

Json value_schema(const Parameter& parameter);

// A table whose members all have defaults may be left out.
bool must_be_written(const Parameter& parameter) {
  if (!parameter.required) return false;
  return parameter.kind != ValueKind::table || std::ranges::any_of(parameter.members, must_be_written);
}

void add_members(Json& schema, std::span<const Parameter> members) {
  for (const Parameter& member : members) {
    Json property = value_schema(member);
    std::string help = member.help;
    const bool has_unit = member.unit != "1" && member.unit != kAnyUnit && !member.unit.empty();
    if (has_unit) help += " [" + member.unit + "]";
    property["description"] = help;
    if (!std::holds_alternative<std::monostate>(member.default_value))
      property["default"] = value_to_json(member.default_value);
    schema["properties"][member.name] = std::move(property);
    if (must_be_written(member)) schema["required"].push_back(member.name);
  }
}

Json object_schema(std::span<const Parameter> members) {
  Json schema{{"type", "object"}, {"properties", Json::object()}};
  add_members(schema, members);
  schema["additionalProperties"] = false;
  return schema;
}

Json typed_object_schema(const std::string& type, const std::string& help, std::span<const Parameter> members) {
  Json schema{{"type", "object"}, {"title", type}, {"description", help}};
  schema["properties"]["type"] = {{"const", type}, {"description", help}};
  schema["required"].push_back("type");
  add_members(schema, members);
  schema["additionalProperties"] = false;
  return schema;
}

void add_range(Json& schema, const Parameter& parameter) {
  if (std::isfinite(parameter.minimum))
    schema[parameter.minimum_excluded ? "exclusiveMinimum" : "minimum"] = parameter.minimum;
  if (std::isfinite(parameter.maximum)) schema["maximum"] = parameter.maximum;
}

Json number_schema(const Parameter& parameter) {
  Json number{{"type", "number"}};
  add_range(number, parameter);
  const char* pattern = parameter.unit == "1" || parameter.unit == kAnyUnit ? kPureQuantityPattern : kQuantityPattern;
  return {{"anyOf", Json::array({number, {{"type", "string"}, {"pattern", pattern}}})}};
}

Json list_schema(Json items, const Parameter& parameter) {
  Json schema{{"type", "array"}, {"items", std::move(items)}};
  if (parameter.count >= 0) {
    schema["minItems"] = parameter.count;
    schema["maxItems"] = parameter.count;
  } else if (parameter.minimum_count > 0) {
    schema["minItems"] = parameter.minimum_count;
  }
  return schema;
}

// A list of tables; one table alone counts as a list of one.
Json table_list_schema(const Json& table, const Parameter& parameter) {
  Json list = list_schema(table, parameter);
  if (parameter.count > 1 || parameter.count == 0 || parameter.minimum_count > 1) return list;
  return {{"anyOf", Json::array({std::move(list), table})}};
}

// A table with a `type`, the bare name of a type without required members, or the value of the shorthand.
Json variant_schema(const Parameter& parameter) {
  Json choices = Json::array();
  Json names = Json::array();
  for (const Variant& alternative : parameter.alternatives) {
    choices.push_back(typed_object_schema(alternative.type, alternative.help, alternative.members));
    if (std::ranges::none_of(alternative.members, must_be_written)) names.push_back(alternative.type);
    if (alternative.type != parameter.shorthand_type) continue;
    const auto member = std::ranges::find(alternative.members, parameter.shorthand_member, &Parameter::name);
    if (member != alternative.members.end()) choices.push_back(value_schema(*member));
  }
  if (!names.empty()) choices.push_back({{"enum", std::move(names)}});
  return {{"anyOf", std::move(choices)}};
}

Json columns_schema(const Parameter& parameter) {
  Json column = parameter.alternatives.empty() ? number_schema(parameter) : variant_schema(parameter);
  if (!parameter.alternatives.empty() && parameter.shorthand_type.empty())
    column["anyOf"].push_back(number_schema(parameter));
  return {{"type", "object"}, {"additionalProperties", std::move(column)}};
}

Json vector_schema(const Parameter& parameter) {
  Json schema{{"type", "array"}, {"items", number_schema(parameter)}};
  schema["minItems"] = 3;
  schema["maxItems"] = 3;
  return schema;
}

Json value_schema(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::boolean:
      return {{"type", "boolean"}};
    case ValueKind::integer: {
      Json schema{{"type", "integer"}};
      add_range(schema, parameter);
      return schema;
    }
    case ValueKind::number:
      return number_schema(parameter);
    case ValueKind::text:
      return {{"type", "string"}};
    case ValueKind::path:
      return {{"type", "string"}, {"minLength", 1}};
    case ValueKind::choice:
      return {{"enum", parameter.words}};
    case ValueKind::vector:
      return vector_schema(parameter);
    case ValueKind::numbers:
      return list_schema(number_schema(parameter), parameter);
    case ValueKind::texts:
      return list_schema({{"type", "string"}}, parameter);
    case ValueKind::table:
      return object_schema(parameter.members);
    case ValueKind::tables:
      return table_list_schema(object_schema(parameter.members), parameter);
    case ValueKind::variant:
      return variant_schema(parameter);
    case ValueKind::variants:
      return table_list_schema(variant_schema(parameter), parameter);
    case ValueKind::columns:
      return columns_schema(parameter);
  }
  return Json::object();
}

Json section_schema(const SchemaSection& section) {
  if (section.plugins.empty()) return object_schema(section.parameters);
  Json choices = Json::array();
  for (const SchemaPlugin& plugin : section.plugins) {
    std::vector<Parameter> members = section.parameters;
    members.insert(members.end(), plugin.parameters.begin(), plugin.parameters.end());
    choices.push_back(typed_object_schema(plugin.name, plugin.help, members));
  }
  return {{"oneOf", std::move(choices)}};
}

std::string to_text(const Json& schema) { return schema.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string parameters_to_schema(std::span<const Parameter> parameters) {
  Json schema{{"$schema", kDialect}};
  schema.update(object_schema(parameters));
  return to_text(schema);
}

std::string scene_schema(std::span<const SchemaSection> sections, std::span<const Parameter> root_parameters) {
  Json schema{{"$schema", kDialect}, {"title", "scree scene"}, {"type", "object"}};
  const Json file{{"type", "string"}, {"minLength", 1}};
  schema["properties"]["include"] = {{"description", "scene files that this one builds on"},
                                     {"anyOf", Json::array({file, {{"type", "array"}, {"items", file}}})}};
  add_members(schema, root_parameters);
  Json definitions = Json::object();
  for (const SchemaSection& section : sections) {
    definitions[section.key] = section_schema(section);
    const Json reference{{"$ref", "#/$defs/" + section.key}};
    Json property{{"description", section.help}};
    if (section.is_named) {
      property["type"] = "object";
      property["additionalProperties"] = reference;
    } else if (section.is_list) {
      property["anyOf"] = Json::array({{{"type", "array"}, {"items", reference}}, reference});
    } else {
      property.update(reference);
    }
    schema["properties"][section.key] = std::move(property);
    if (section.required) schema["required"].push_back(section.key);
  }
  schema["additionalProperties"] = false;
  schema["$defs"] = std::move(definitions);
  return to_text(schema);
}

}  // namespace scree
