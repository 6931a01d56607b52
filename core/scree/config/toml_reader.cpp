// The only file that sees toml++.
#include <algorithm>
#include <sstream>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "scree/config/scene_node.hpp"

namespace scree {
namespace {

constexpr int kMaximumDepth = 64;           // of nested tables and lists
constexpr std::size_t kMaximumDots = 2000;  // in one line; dotted keys nest, and the parser recurses

class Reader {
 public:
  explicit Reader(const SceneOrigin& origin) : origin_{origin} {}

  std::shared_ptr<SceneNode> read(const toml::node& node, int depth) const {
    auto result = std::make_shared<SceneNode>();
    result->origin = &origin_;
    result->line = static_cast<int>(node.source().begin.line);
    result->column = static_cast<int>(node.source().begin.column);
    if (depth > kMaximumDepth) throw Error{ErrorKind::usage, result->where(), "tables or lists are nested too deeply"};
    if (const auto* table = node.as_table()) {
      read_members(*table, *result, depth);
    } else if (const auto* array = node.as_array()) {
      result->kind = SceneKind::list;
      for (const toml::node& item : *array) result->items.push_back(read(item, depth + 1));
    } else {
      read_scalar(node, *result);
    }
    return result;
  }

 private:
  void read_members(const toml::table& table, SceneNode& result, int depth) const {
    result.kind = SceneKind::table;
    for (const auto& [key, value] : table) {
      const toml::source_position place = key.source().begin;
      result.members.push_back({std::string{key.str()}, read(value, depth + 1), &origin_, static_cast<int>(place.line),
                                static_cast<int>(place.column)});
    }
    // toml++ sorts keys by name; people expect the order that they wrote.
    std::ranges::stable_sort(result.members, [](const auto& a, const auto& b) {
      return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
  }

  static void read_scalar(const toml::node& node, SceneNode& result) {
    if (const auto* text = node.as_string()) {
      result.kind = SceneKind::text;
      result.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
      result.kind = SceneKind::integer;
      result.integer = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
      result.kind = SceneKind::number;
      result.number = number->get();
    } else if (const auto* boolean = node.as_boolean()) {
      result.kind = SceneKind::boolean;
      result.boolean = boolean->get();
    } else {
      result.kind = SceneKind::date;
    }
  }

  const SceneOrigin& origin_;
};

void refuse_deep_keys(std::string_view text, const SceneOrigin& origin) {
  std::size_t dots = 0;
  int line = 1;
  for (const char c : text) {
    if (c == '.') ++dots;
    if (c == '\n') {
      dots = 0;
      ++line;
    }
    if (dots > kMaximumDots) {
      throw Error{ErrorKind::usage, {origin.name, line, 1}, "this line has too many dots; break it into several"};
    }
  }
}

}  // namespace

std::shared_ptr<SceneNode> read_toml(std::string_view text, const SceneOrigin& origin) {
  refuse_deep_keys(text, origin);
  try {
    const toml::table table = toml::parse(text, std::string_view{origin.name});
    return Reader{origin}.read(table, 0);
  } catch (const toml::parse_error& failure) {
    const toml::source_position place = failure.source().begin;
    throw Error{ErrorKind::usage,
                {origin.name, static_cast<int>(place.line), static_cast<int>(place.column)},
                "this is not valid TOML: " + std::string{failure.description()}};
  }
}

std::shared_ptr<SceneNode> read_toml_value(std::string_view text, const SceneOrigin& origin) {
  auto as_text = std::make_shared<SceneNode>();
  as_text->kind = SceneKind::text;
  as_text->text = std::string{text};
  as_text->origin = &origin;
  try {
    const std::shared_ptr<SceneNode> table = read_toml("value = " + std::string{text}, origin);
    if (table->members.size() != 1 || table->members.front().key != "value") return as_text;
    std::shared_ptr<SceneNode> value = table->members.front().value;
    return value->kind == SceneKind::date ? as_text : value;
  } catch (const Error&) {
    return as_text;
  }
}

}  // namespace scree
