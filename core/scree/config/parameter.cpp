#include "scree/config/parameter.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scree {
namespace {

Parameter make(ValueKind kind, std::string name, std::string help) {
  Parameter parameter;
  parameter.kind = kind;
  parameter.name = std::move(name);
  parameter.help = std::move(help);
  return parameter;
}

Parameter make(ValueKind kind, std::string name, std::string unit, std::string help) {
  Parameter parameter = make(kind, std::move(name), std::move(help));
  parameter.unit = std::move(unit);
  return parameter;
}

// Defaults may be written as the nearest C++ literal: an int for a number, a list of three for a vector.
Parameter::Value as_kind(ValueKind kind, Parameter::Value value) {
  if (kind == ValueKind::number || kind == ValueKind::variant) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  }
  if (kind == ValueKind::vector) {
    const auto* list = std::get_if<std::vector<double>>(&value);
    if (list != nullptr && list->size() == 3) return Vec3{(*list)[0], (*list)[1], (*list)[2]};
  }
  return value;
}

bool holds_kind(ValueKind kind, const Parameter::Value& value) {
  switch (kind) {
    case ValueKind::boolean:
      return std::holds_alternative<bool>(value);
    case ValueKind::integer:
      return std::holds_alternative<std::int64_t>(value);
    case ValueKind::number:
      return std::holds_alternative<double>(value);
    case ValueKind::text:
    case ValueKind::choice:
    case ValueKind::path:
      return std::holds_alternative<std::string>(value);
    case ValueKind::vector:
      return std::holds_alternative<Vec3>(value);
    case ValueKind::numbers:
      return std::holds_alternative<std::vector<double>>(value);
    case ValueKind::texts:
      return std::holds_alternative<std::vector<std::string>>(value);
    case ValueKind::variant:
      return !std::holds_alternative<std::monostate>(value);  // the shorthand's value, or the name of a type
    case ValueKind::table:
    case ValueKind::tables:
    case ValueKind::variants:
    case ValueKind::columns:
      return false;  // their members have the defaults
  }
  return false;
}

}  // namespace

Parameter Parameter::boolean(std::string name, std::string help) {
  return make(ValueKind::boolean, std::move(name), std::move(help));
}
Parameter Parameter::integer(std::string name, std::string help) {
  return make(ValueKind::integer, std::move(name), std::move(help));
}
Parameter Parameter::number(std::string name, std::string unit, std::string help) {
  return make(ValueKind::number, std::move(name), std::move(unit), std::move(help));
}
Parameter Parameter::text(std::string name, std::string help) {
  return make(ValueKind::text, std::move(name), std::move(help));
}
Parameter Parameter::choice(std::string name, std::vector<std::string> words, std::string help) {
  Parameter parameter = make(ValueKind::choice, std::move(name), std::move(help));
  parameter.words = std::move(words);
  return parameter;
}
Parameter Parameter::path(std::string name, std::string help) {
  return make(ValueKind::path, std::move(name), std::move(help));
}
Parameter Parameter::vector(std::string name, std::string unit, std::string help) {
  return make(ValueKind::vector, std::move(name), std::move(unit), std::move(help));
}
Parameter Parameter::numbers(std::string name, std::string unit, std::string help) {
  return make(ValueKind::numbers, std::move(name), std::move(unit), std::move(help));
}
Parameter Parameter::texts(std::string name, std::string help) {
  return make(ValueKind::texts, std::move(name), std::move(help));
}
Parameter Parameter::table(std::string name, std::vector<Parameter> members, std::string help) {
  Parameter parameter = make(ValueKind::table, std::move(name), std::move(help));
  parameter.members = std::move(members);
  return parameter;
}
Parameter Parameter::tables(std::string name, std::vector<Parameter> members, std::string help) {
  Parameter parameter = make(ValueKind::tables, std::move(name), std::move(help));
  parameter.members = std::move(members);
  return parameter;
}
Parameter Parameter::variant(std::string name, std::vector<Variant> variants, std::string help) {
  Parameter parameter = make(ValueKind::variant, std::move(name), std::move(help));
  parameter.alternatives = std::move(variants);
  return parameter;
}
Parameter Parameter::variants(std::string name, std::vector<Variant> variants, std::string help) {
  Parameter parameter = make(ValueKind::variants, std::move(name), std::move(help));
  parameter.alternatives = std::move(variants);
  return parameter;
}
Parameter Parameter::columns(std::string name, std::vector<Variant> variants, std::string unit, std::string help) {
  Parameter parameter = make(ValueKind::columns, std::move(name), std::move(unit), std::move(help));
  parameter.alternatives = std::move(variants);
  return parameter;
}

Parameter Parameter::by_default(Value value) && {
  value = as_kind(kind, std::move(value));
  if (!holds_kind(kind, value)) throw std::logic_error{"the default of parameter '" + name + "' has another kind"};
  if (kind == ValueKind::choice && std::ranges::find(words, std::get<std::string>(value)) == words.end())
    throw std::logic_error{"the default of parameter '" + name + "' is none of its words"};
  default_value = std::move(value);
  required = false;
  return std::move(*this);
}
Parameter Parameter::optional() && {
  required = false;
  return std::move(*this);
}
Parameter Parameter::at_least(double smallest) && {
  minimum = smallest;
  minimum_excluded = false;
  return std::move(*this);
}
Parameter Parameter::at_most(double largest) && {
  maximum = largest;
  return std::move(*this);
}
Parameter Parameter::above(double bound) && {
  minimum = bound;
  minimum_excluded = true;
  return std::move(*this);
}
Parameter Parameter::with_count(int entries) && {
  count = entries;
  return std::move(*this);
}
Parameter Parameter::with_at_least_count(int entries) && {
  minimum_count = entries;
  return std::move(*this);
}
Parameter Parameter::with_shorthand(std::string type, std::string member) && {
  shorthand_type = std::move(type);
  shorthand_member = std::move(member);
  return std::move(*this);
}

}  // namespace scree
