// The tree behind SceneTable: values of TOML, each with its place. Private to core/scree/config.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "scree/config/scene_document.hpp"

namespace scree {

struct SceneStore;

/// Where values come from: a file, or one option of the command line.
struct SceneOrigin {
  std::string name;             ///< as messages show it
  std::filesystem::path base;   ///< absolute folder that relative paths start from
  SceneStore* store = nullptr;  ///< of the document
};

/// What a document owns besides its tree: places, and the reduced copies that SceneTable::without() hands out.
struct SceneStore {
  std::deque<SceneOrigin> origins;
  std::deque<std::shared_ptr<SceneTable::Node>> copies;
  std::mutex lock;

  const SceneOrigin* add(std::string name, std::filesystem::path base);
};

enum class SceneKind { table, list, text, integer, number, boolean, date };

struct SceneTable::Node {
  struct Member {
    std::string key;
    std::shared_ptr<Node> value;
    const SceneOrigin* origin = nullptr;  ///< place of the key itself
    int line = 0;
    int column = 0;

    [[nodiscard]] SourceLocation where() const { return {origin->name, line, column}; }
  };

  SceneKind kind = SceneKind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;  ///< as written, [SI unit of the setting]
  std::string text;
  std::vector<Member> members;               ///< of a table, in the order written
  std::vector<std::shared_ptr<Node>> items;  ///< of a list
  const SceneOrigin* origin = nullptr;
  int line = 0;
  int column = 0;

  [[nodiscard]] SourceLocation where() const { return {origin->name, line, column}; }
  [[nodiscard]] const Member* find(std::string_view key) const;
  [[nodiscard]] Member* find(std::string_view key);
  [[nodiscard]] std::vector<std::string> keys() const;
  /// True for a list with entries that are all tables.
  [[nodiscard]] bool is_table_list() const;
};

using SceneNode = SceneTable::Node;

/// "a table", "a string", ... for messages.
[[nodiscard]] std::string_view kind_name(SceneKind kind);

/// The tree of a TOML text. @throws Error (usage) at the place of a syntax error.
[[nodiscard]] std::shared_ptr<SceneNode> read_toml(std::string_view text, const SceneOrigin& origin);

/// The value of `text` if it is one TOML value, else `text` as a string.
[[nodiscard]] std::shared_ptr<SceneNode> read_toml_value(std::string_view text, const SceneOrigin& origin);

/// Applies `assignment`, "key.sub=value", to the tree. @throws Error (usage) that names `option`, which gave it, when its path
/// names nothing.
void apply_override(SceneNode& root, const std::string& option, const std::string& assignment, SceneStore& store);

}  // namespace scree
