#include "scree/config/value_reader.hpp"

#include <algorithm>
#include <cmath>

#include "scree/config/parameter_text.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/units.hpp"

namespace scree {
namespace {

Error usage(const SceneNode& node, const std::string& sentence) {
  return Error{ErrorKind::usage, node.where(), sentence};
}

void check_range(double value, const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  const bool too_small = parameter.minimum_excluded ? !(value > parameter.minimum) : value < parameter.minimum;
  if (!too_small && value <= parameter.maximum) return;
  throw usage(node, subject + " is " + quantity_text(value, parameter.unit) + ", which is out of range; valid is " +
                        valid_range(parameter));
}

double read_number(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  double value = 0.0;
  if (node.kind == SceneKind::integer) {
    value = static_cast<double>(node.integer);
  } else if (node.kind == SceneKind::number) {
    value = node.number;
  } else if (node.kind == SceneKind::text) {
    try {
      value = parse_quantity(node.text, parameter.unit);
    } catch (const Error& failure) {
      if (failure.kind() != ErrorKind::usage) throw;
      throw usage(node, subject + ": " + failure.what());
    }
  } else {
    refuse_kind(node, parameter, subject);
  }
  if (!std::isfinite(value)) throw usage(node, subject + " must be a finite number");
  check_range(value, node, parameter, subject);
  return value;
}

std::int64_t read_integer(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53: doubles beyond are not all integers
  std::int64_t value = node.integer;
  if (node.kind == SceneKind::number) {
    const bool whole = std::abs(node.number) <= kLargestExact && node.number == std::floor(node.number);
    if (!whole) throw usage(node, subject + " must be an integer, but is " + quantity_text(node.number, "1"));
    value = static_cast<std::int64_t>(node.number);
  } else if (node.kind != SceneKind::integer) {
    refuse_kind(node, parameter, subject);
  }
  check_range(static_cast<double>(value), node, parameter, subject);
  return value;
}

const std::string& read_text(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::text) refuse_kind(node, parameter, subject);
  if (parameter.kind == ValueKind::path && node.text.empty())
    throw usage(node, subject + " is empty, but must be " + expectation(parameter));
  if (parameter.kind != ValueKind::choice || std::ranges::find(parameter.words, node.text) != parameter.words.end())
    return node.text;
  const std::string near = nearest_word(node.text, parameter.words);
  throw usage(node, subject + " is " + quote(node.text) + ", but must be " + expectation(parameter) +
                        (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

std::vector<double> read_numbers(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::list) refuse_kind(node, parameter, subject);
  check_count(node, parameter, subject);
  Parameter single = parameter;
  single.kind = ValueKind::number;
  std::vector<double> values;
  values.reserve(node.items.size());
  for (const auto& item : node.items) {
    values.push_back(read_number(*item, single, subject + ", entry " + std::to_string(values.size())));
  }
  return values;
}

Vec3 read_vector(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::list || node.items.size() != 3) refuse_kind(node, parameter, subject);
  const std::vector<double> values = read_numbers(node, parameter, subject);
  return {values[0], values[1], values[2]};
}

std::vector<std::string> read_texts(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::list) refuse_kind(node, parameter, subject);
  check_count(node, parameter, subject);
  std::vector<std::string> values;
  for (const auto& item : node.items) {
    if (item->kind != SceneKind::text)
      refuse_kind(*item, parameter, subject + ", entry " + std::to_string(values.size()));
    values.push_back(item->text);
  }
  return values;
}

}  // namespace

void refuse_kind(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  std::string found{kind_name(node.kind)};
  if (node.kind == SceneKind::list) found += " of " + std::to_string(node.items.size());
  throw usage(node, subject + " must be " + expectation(parameter) + ", but is " + found);
}

void check_count(const SceneNode& list, const Parameter& parameter, const std::string& subject) {
  const auto size = static_cast<int>(list.items.size());
  const bool exact = parameter.count < 0 || size == parameter.count;
  if (exact && size >= parameter.minimum_count) return;
  throw usage(list, subject + " has " + std::to_string(size) + (size == 1 ? " entry" : " entries") + ", but must be " +
                        expectation(parameter));
}

Parameter::Value read_plain_value(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  switch (parameter.kind) {
    case ValueKind::boolean:
      if (node.kind != SceneKind::boolean) refuse_kind(node, parameter, subject);
      return node.boolean;
    case ValueKind::integer:
      return read_integer(node, parameter, subject);
    case ValueKind::number:
      return read_number(node, parameter, subject);
    case ValueKind::text:
    case ValueKind::choice:
    case ValueKind::path:
      return read_text(node, parameter, subject);
    case ValueKind::vector:
      return read_vector(node, parameter, subject);
    case ValueKind::numbers:
      return read_numbers(node, parameter, subject);
    case ValueKind::texts:
      return read_texts(node, parameter, subject);
    default:
      refuse_kind(node, parameter, subject);
  }
}

}  // namespace scree
