// A scene as text: TOML files with includes and overrides merged into one tree that remembers every place.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scree/base/error.hpp"

namespace scree {

/// One table of a scene document, read-only. A light handle; the document must outlive it.
class SceneTable {
 public:
  struct Node;
  explicit SceneTable(const Node* node) : node_{node} {}

  [[nodiscard]] const Node& node() const { return *node_; }
  [[nodiscard]] SourceLocation location() const;
  [[nodiscard]] std::vector<std::string> keys() const;
  [[nodiscard]] bool has(std::string_view key) const;
  /// The table under `key`; a plain table or a single-entry list. @throws Error (usage) when it is not a table.
  [[nodiscard]] SceneTable table(std::string_view key) const;
  /// The tables of a list `[[key]]`, in order; a plain table counts as a list of one; empty when absent.
  [[nodiscard]] std::vector<SceneTable> tables(std::string_view key) const;
  /// The tables [key.NAME] with their names; empty when absent. @throws Error (usage) that says so for another form.
  [[nodiscard]] std::vector<std::pair<std::string, SceneTable>> named_tables(std::string_view key) const;
  /// The string under `key`. @throws Error (usage) when absent or not a string.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] SourceLocation location(std::string_view key) const;
  /// A copy of this table without some keys, so that core can take its own keys before a plugin's are checked.
  /// The copy lives as long as the document.
  [[nodiscard]] SceneTable without(std::span<const std::string_view> keys) const;

 private:
  const Node* node_;
};

/// A scene file with its includes and the overrides of the command line.
class SceneDocument {
 public:
  /// Reads `file`, then merges the files of its `include = [...]` beneath it (its own keys win; lists of tables are
  /// appended after the included ones) and applies overrides "key.sub=value" on top, where `[[list]]` entries are
  /// addressed as `source.0.rate` or, when they have a name or type, `source.emitter.rate`.
  /// A later include wins over an earlier one, and a file that several include is merged once. The value of an override
  /// is a TOML value if it can be read as one, else a string; paths in it start from the working directory.
  /// @throws Error (io) for a missing file, (usage) for a syntax error, a cycle, an override that names no table.
  static SceneDocument load(const std::filesystem::path& file, std::span<const std::string> overrides = {});
  /// From text, for tests; `name` stands for the file in messages, `option` for what gave the overrides.
  static SceneDocument parse(std::string_view toml, const std::string& name = "scene.toml",
                             std::span<const std::string> overrides = {}, const std::string& option = "--set");

  SceneDocument(SceneDocument&&) noexcept;
  SceneDocument& operator=(SceneDocument&&) noexcept;
  ~SceneDocument();

  [[nodiscard]] SceneTable root() const;
  /// The folder of the scene file, for relative paths.
  [[nodiscard]] const std::filesystem::path& folder() const;
  [[nodiscard]] const std::filesystem::path& file() const;

 private:
  struct Contents;
  explicit SceneDocument(std::unique_ptr<Contents> contents);
  std::unique_ptr<Contents> contents_;
};

}  // namespace scree
