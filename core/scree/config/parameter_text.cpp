#include "scree/config/parameter_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "scree/config/suggest.hpp"
#include "scree/config/units.hpp"

namespace scree {
namespace {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string in_unit(const Parameter& parameter) {
  if (parameter.unit == kAnyUnit) return " in SI units";
  return parameter.unit == "1" ? "" : " in " + parameter.unit;
}

std::vector<std::string> types_of(const Parameter& parameter) {
  std::vector<std::string> types;
  for (const Variant& alternative : parameter.alternatives) types.push_back(alternative.type);
  return types;
}

// ", three of them", ", at least 2": how long a list must be.
std::string count_text(const Parameter& parameter) {
  if (parameter.count >= 0)
    return fmt::format(" with {} {}", parameter.count, parameter.count == 1 ? "entry" : "entries");
  if (parameter.minimum_count == 1) return " with at least 1 entry";
  if (parameter.minimum_count > 1) return fmt::format(" with at least {} entries", parameter.minimum_count);
  return {};
}

std::string variant_expectation(const Parameter& parameter) {
  std::string text = "a table with a 'type', one of " + list_of(types_of(parameter));
  if (!parameter.shorthand_type.empty())
    text += ", or a plain value that stands for type '" + parameter.shorthand_type + "'";
  return text;
}

template <class Items, class Format>
std::string bracketed(const Items& items, Format format) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i > 0 ? ", " : "") + format(items[i]);
  return text + "]";
}

struct TomlWriter {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const { return quote(value); }
  std::string operator()(const Vec3& value) const {
    return "[" + number_text(value.x) + ", " + number_text(value.y) + ", " + number_text(value.z) + "]";
  }
  std::string operator()(const std::vector<double>& values) const { return bracketed(values, number_text); }
  std::string operator()(const std::vector<std::string>& values) const { return bracketed(values, quote); }
};

}  // namespace

std::string expectation(const Parameter& parameter) {
  const std::string unit = in_unit(parameter);
  switch (parameter.kind) {
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::integer:
      return "an integer";
    case ValueKind::number:
      return "a number" + unit + " or a quantity such as \"" + quantity_example(parameter.unit) + "\"";
    case ValueKind::text:
      return "a string";
    case ValueKind::choice:
      return "one of " + list_of(parameter.words);
    case ValueKind::path:
      return "a string with the name of a file";
    case ValueKind::vector:
      return "a list of three numbers" + unit + ", such as [0, 0, 1]";
    case ValueKind::numbers:
      return "a list of numbers" + unit + count_text(parameter);
    case ValueKind::texts:
      return "a list of strings" + count_text(parameter);
    case ValueKind::table:
      return "a table [" + parameter.name + "]";
    case ValueKind::tables:
      return "a list of tables [[" + parameter.name + "]]" + count_text(parameter);
    case ValueKind::variant:
      return variant_expectation(parameter);
    case ValueKind::variants:
      return "a list" + count_text(parameter) + " of tables with a 'type', one of " + list_of(types_of(parameter));
    case ValueKind::columns:
      return "a table [" + parameter.name + "] of names and their values";
  }
  return {};
}

std::string valid_range(const Parameter& parameter) {
  const bool below = std::isfinite(parameter.minimum);
  const bool bounded = std::isfinite(parameter.maximum);
  const auto text = [&](double bound) { return quantity_text(bound, parameter.unit); };
  if (below && bounded && !parameter.minimum_excluded)
    return "from " + text(parameter.minimum) + " to " + text(parameter.maximum);
  std::string range;
  if (below) range = (parameter.minimum_excluded ? "above " : "at least ") + text(parameter.minimum);
  if (bounded) range += (below ? " and at most " : "at most ") + text(parameter.maximum);
  return range;
}

std::string example_line(const Parameter& parameter) {
  std::string head = parameter.name + " = ";
  switch (parameter.kind) {
    case ValueKind::boolean:
      return head + "true";
    case ValueKind::integer:
      return head + (std::isfinite(parameter.minimum)
                         ? fmt::format("{}", std::ceil(parameter.minimum) + (parameter.minimum_excluded ? 1 : 0))
                         : "1");
    case ValueKind::number:
      return head + (parameter.unit == "1" ? "0.5" : quote(quantity_example(parameter.unit)));
    case ValueKind::text:
      return head + "\"...\"";
    case ValueKind::choice:
      return head + quote(parameter.words.empty() ? "" : parameter.words.front());
    case ValueKind::path:
      return head + "\"file\"";
    case ValueKind::vector:
      return head + "[0.0, 0.0, 1.0]";
    case ValueKind::numbers:
      return head + "[0.0, 1.0]";
    case ValueKind::texts:
      return head + "[\"...\"]";
    case ValueKind::table:
    case ValueKind::columns:
      return "[" + parameter.name + "]";
    case ValueKind::tables:
    case ValueKind::variants:
      return "[[" + parameter.name + "]]";
    case ValueKind::variant: {
      const std::string type = parameter.alternatives.empty() ? "" : parameter.alternatives.front().type;
      return head + "{ type = " + quote(type) + ", ... }";
    }
  }
  return head;
}

std::string quantity_text(double value, std::string_view unit) {
  std::string text = fmt::format("{}", value);
  if (unit != "1" && unit != kAnyUnit && !unit.empty()) text += " " + std::string{unit};
  return text;
}

std::string toml_text(const Parameter::Value& value) { return std::visit(TomlWriter{}, value); }

std::string quote(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      result += c;
    }
  }
  return result + "\"";
}

}  // namespace scree
