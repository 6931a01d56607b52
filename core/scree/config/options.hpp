// Options: one validated table of a scene, as its reader (a plugin, or core) sees it.
//
// Every key was checked against the Parameters that the reader described: it exists, has the right kind, is in SI and
// in range, and defaults are filled in. Asking for a key that was not described is a programming error and throws
// std::logic_error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/config/parameter.hpp"

namespace scree {

/// A validated table: typed values by name, each with the place it came from. A value type; copies are deep.
class Options {
 public:
  struct Entry;

  Options();
  ~Options();
  Options(const Options&);
  Options(Options&&) noexcept;
  Options& operator=(const Options&);
  Options& operator=(Options&&) noexcept;

  /// False only for a setting described as optional() that the scene leaves out (and in default_options() for a
  /// required one). Asking it for its value then is a programming error, except that tables() gives an empty list.
  [[nodiscard]] bool has(std::string_view name) const;
  /// True when the scene (or --set) wrote the key; false for a default.
  [[nodiscard]] bool given(std::string_view name) const;

  [[nodiscard]] bool boolean(std::string_view name) const;
  [[nodiscard]] std::int64_t integer(std::string_view name) const;
  /// In the SI unit of the parameter's description, as all numbers here.
  [[nodiscard]] double number(std::string_view name) const;
  /// The number of a setting with unit `any`, now that its reader knows the unit. @throws Error (usage) at its place when
  /// the scene wrote a quantity of another dimension.
  [[nodiscard]] double number_in(std::string_view name, std::string_view unit) const;
  [[nodiscard]] Vec3 vector(std::string_view name) const;
  [[nodiscard]] const std::vector<double>& numbers(std::string_view name) const;
  /// The string of a text or choice.
  [[nodiscard]] const std::string& text(std::string_view name) const;
  [[nodiscard]] const std::vector<std::string>& texts(std::string_view name) const;
  /// Absolute path of a file setting.
  [[nodiscard]] std::filesystem::path path(std::string_view name) const;
  /// A nested table or variant.
  [[nodiscard]] const Options& table(std::string_view name) const;
  [[nodiscard]] const std::vector<Options>& tables(std::string_view name) const;

  /// For a variant: the chosen `type`. For a plugin's own section: the plugin's name. Else empty.
  [[nodiscard]] const std::string& type() const { return type_; }
  /// The keys that hold a value, in the order of description (free keys of `columns`: alphabetical).
  [[nodiscard]] std::vector<std::string> names() const;

  /// Where a key was written; where its table begins when the value is a default.
  [[nodiscard]] SourceLocation location(std::string_view name) const;
  [[nodiscard]] const SourceLocation& location() const { return location_; }
  /// An Error at the place of a key, for what only the reader can check: `throw options.error("radius", "...")`.
  [[nodiscard]] Error error(std::string_view name, const std::string& sentence) const;
  [[nodiscard]] Error error(const std::string& sentence) const;

  /// Filled by the validator (scree/config/validate.hpp) and by tests.
  void set(const std::string& name, Entry entry);
  void set_type(std::string type) { type_ = std::move(type); }
  void set_location(SourceLocation where) { location_ = std::move(where); }
  /// For tests and C++ callers: sets a value as if a scene had written it.
  void set(const std::string& name, Parameter::Value value);
  /// The entry of a key that holds a value, else null.
  [[nodiscard]] const Entry* find(std::string_view name) const;

 private:
  [[nodiscard]] const Entry& described(std::string_view name) const;
  [[nodiscard]] const Entry& present(std::string_view name) const;
  template <class T>
  [[nodiscard]] const T& value(std::string_view name, const char* kind) const;

  std::string type_;
  SourceLocation location_;
  std::vector<std::pair<std::string, std::unique_ptr<Entry>>> entries_;
};

/// A value of a table: scalar or list, nested tables, and where it was written.
struct Options::Entry {
  Parameter::Value value;
  std::vector<Options> tables;  ///< one for a table or variant, any number for tables and variants
  std::filesystem::path base;   ///< folder that a path is relative to
  SourceLocation where;
  bool given = true;
  std::string written;   ///< the quantity of a setting with unit `any`, as the scene wrote it; else empty
  bool is_list = false;  ///< of tables or variants
  bool present = true;   ///< false for a described setting without a value
};

}  // namespace scree
