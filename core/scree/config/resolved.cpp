#include "scree/config/resolved.hpp"

#include <algorithm>

#include "scree/config/parameter_text.hpp"
#include "scree/config/value_json.hpp"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

struct JsonWriter {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const Vec3& value) const { return Json::array({value.x, value.y, value.z}); }
  template <class T>
  Json operator()(const T& value) const {
    return value;
  }
};

// A list of tables stays a list whatever its length; Options keep one table for a table or variant.
bool is_plain(const Options::Entry& entry) { return !std::holds_alternative<std::monostate>(entry.value); }

Json to_json(const Options& options) {
  Json result = Json::object();
  if (!options.type().empty()) result["type"] = options.type();
  for (const std::string& name : options.names()) {
    const Options::Entry& entry = *options.find(name);
    if (is_plain(entry)) {
      result[name] = value_to_json(entry.value);
    } else if (entry.is_list) {
      Json list = Json::array();
      for (const Options& table : entry.tables) list.push_back(to_json(table));
      result[name] = std::move(list);
    } else {
      result[name] = to_json(entry.tables.front());
    }
  }
  return result;
}

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quote(key);
}

// Plain values first: after a [header] they would belong to that table.
void write_toml(const Options& options, const std::string& prefix, std::string& out) {
  if (!options.type().empty()) out += "type = " + quote(options.type()) + "\n";
  for (const std::string& name : options.names()) {
    const Options::Entry& entry = *options.find(name);
    if (is_plain(entry)) out += toml_key(name) + " = " + toml_text(entry.value) + "\n";
    if (entry.is_list && entry.tables.empty()) out += toml_key(name) + " = []\n";
  }
  for (const std::string& name : options.names()) {
    const Options::Entry& entry = *options.find(name);
    const std::string path = prefix + toml_key(name);
    for (const Options& table : entry.tables) {
      out += entry.is_list ? "\n[[" + path + "]]\n" : "\n[" + path + "]\n";
      write_toml(table, path + ".", out);
    }
  }
}

}  // namespace

Json value_to_json(const Parameter::Value& value) { return std::visit(JsonWriter{}, value); }

std::string to_json_text(const Options& options, int indent) {
  return to_json(options).dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string to_toml_text(const Options& options) {
  std::string text;
  write_toml(options, {}, text);
  return text;
}

}  // namespace scree
