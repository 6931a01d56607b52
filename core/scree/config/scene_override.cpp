// --set key.sub=value: one value of the command line, put into the tree of a scene.
#include <algorithm>
#include <charconv>
#include <optional>

#include "scree/config/scene_node.hpp"
#include "scree/config/suggest.hpp"

namespace scree {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string{text.substr(first, text.find_last_not_of(" \t") - first + 1)};
}

std::vector<std::string> path_of(std::string_view key) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t dot = key.find('.');
    parts.push_back(trimmed(key.substr(0, dot)));
    if (dot == std::string_view::npos) return parts;
    key.remove_prefix(dot + 1);
  }
}

std::optional<std::size_t> index_of(const std::string& part) {
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (failure != std::errc{} || end != part.data() + part.size()) return {};
  return index;
}

// The name or else the type of a table in a list: what it can be addressed by.
bool is_called(const SceneNode& table, const std::string& word, const char* key) {
  const SceneNode::Member* member = table.find(key);
  return member != nullptr && member->value->kind == SceneKind::text && member->value->text == word;
}

class Walk {
 public:
  Walk(const std::string& option, const std::string& assignment, SceneStore& store)
      : origin_{*store.add(option + " " + assignment, std::filesystem::current_path())} {}

  [[nodiscard]] const SceneOrigin& origin() const { return origin_; }

  [[noreturn]] void refuse(const std::string& sentence) const {
    throw Error{ErrorKind::usage, {origin_.name, 0, 0}, sentence};
  }

  // The place of an entry of a list, addressed by its index, name or type.
  std::shared_ptr<SceneNode>& entry(SceneNode& list, const std::string& part, const std::string& list_name) const {
    const std::size_t size = list.items.size();
    if (const std::optional<std::size_t> index = index_of(part)) {
      if (*index < size) return list.items[*index];
      refuse("'" + list_name + "' has " + std::to_string(size) + " entries, counted from 0; there is no entry " + part);
    }
    for (const char* key : {"name", "type"}) {
      const auto called = [&](const auto& item) { return is_called(*item, part, key); };
      const auto matches = std::ranges::count_if(list.items, called);
      if (matches == 1) return *std::ranges::find_if(list.items, called);
      if (matches > 1)
        refuse(std::to_string(matches) + " entries of '" + list_name + "' have the " + key + " '" + part +
               "'; address one by its index, for example " + list_name + ".0");
    }
    refuse_unknown(part, called_in(list), "'" + list_name + "' has no entry '" + part + "'");
  }

  [[noreturn]] void refuse_unknown(const std::string& part, const std::vector<std::string>& valid,
                                   const std::string& sentence) const {
    const std::string near = nearest_word(part, valid);
    refuse(sentence + (near.empty() ? "" : "; did you mean '" + near + "'?") +
           (near.empty() ? "; valid are " : " Valid are ") + list_of(valid));
  }

 private:
  static std::vector<std::string> called_in(const SceneNode& list) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      words.push_back(std::to_string(i));
      for (const char* key : {"name", "type"}) {
        const SceneNode::Member* member = list.items[i]->find(key);
        if (member == nullptr || member->value->kind != SceneKind::text) continue;
        words.back() = member->value->text;
        break;
      }
    }
    return words;
  }

  const SceneOrigin& origin_;
};

// A single [table] may be addressed as a list of one: `source.0.rate`, `source.emitter.rate`.
bool stands_for_itself(const SceneNode& table, const std::string& part) {
  return table.find(part) == nullptr &&
         (part == "0" || is_called(table, part, "name") || is_called(table, part, "type"));
}

void assign(SceneNode& table, const std::string& key, std::shared_ptr<SceneNode> value, const SceneOrigin& origin) {
  SceneNode::Member* member = table.find(key);
  if (member == nullptr) {
    table.members.push_back({key, std::move(value), &origin, 0, 0});
  } else {
    *member = {key, std::move(value), &origin, 0, 0};
  }
}

void place_on_command_line(SceneNode& node) {
  node.line = 0;
  node.column = 0;
  for (auto& item : node.items) place_on_command_line(*item);
  for (auto& member : node.members) {
    member.line = 0;
    place_on_command_line(*member.value);
  }
}

}  // namespace

void apply_override(SceneNode& root, const std::string& option, const std::string& assignment, SceneStore& store) {
  const Walk walk{option, assignment, store};
  const std::size_t equals = assignment.find('=');
  const std::vector<std::string> path = path_of(std::string_view{assignment}.substr(0, equals));
  if (equals == std::string::npos || std::ranges::find(path, "") != path.end())
    walk.refuse("an override must have the form key=value, for example electrode.voltage=\"30 kV\"");
  auto value = read_toml_value(trimmed(std::string_view{assignment}.substr(equals + 1)), walk.origin());
  place_on_command_line(*value);

  SceneNode* node = &root;
  std::string walked;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string& part = path[i];
    const bool last = i + 1 == path.size();
    if (node->kind == SceneKind::list) {
      std::shared_ptr<SceneNode>& entry = walk.entry(*node, part, walked);
      if (last) entry = value;
      node = entry.get();
    } else if (node->kind != SceneKind::table) {
      walk.refuse("'" + walked + "' is " + std::string{kind_name(node->kind)} + " and has no key '" + part + "'");
    } else if (last) {
      assign(*node, part, value, walk.origin());
    } else if (SceneNode::Member* member = node->find(part)) {
      node = member->value.get();
    } else if (walked.empty() || !stands_for_itself(*node, part)) {
      walk.refuse_unknown(
          part, node->keys(),
          (walked.empty() ? "the scene" : "'" + walked + "'") + std::string{" has no table '"} + part + "'");
    }
    walked += (walked.empty() ? "" : ".") + part;
  }
}

}  // namespace scree
