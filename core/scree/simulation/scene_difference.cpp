#include "scree/simulation/scene_difference.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "scree/results/result_claims.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

bool is_of(const std::string& key, std::string_view section) {
  return key.starts_with(section) && (key.size() == section.size() || key[section.size()] == '.');
}

/// What Simulation::scene_hash() leaves out.
bool may_differ(const std::string& key) {
  if (is_of(key, "simulation")) return key != "simulation.time_step" && key != "simulation.seed";
  return is_of(key, "output") || is_of(key, "observer");
}

bool is_list_of_tables(const Json& value) { return value.is_array() && !value.empty() && value.front().is_object(); }

/// Adds to `found` what differs between two values called `key`. Of a table with another type nothing else counts, and of a
/// list with another length no entry.
void compare(const Json& one, const Json& other, const std::string& key, std::set<std::string>& found) {
  const auto inside = [&](const std::string& name) { return key.empty() ? name : key + "." + name; };
  if (one == other) return;
  if (one.is_object() && other.is_object()) {
    if (one.value("type", Json{}) != other.value("type", Json{})) {
      compare(one.value("type", Json{}), other.value("type", Json{}), inside("type"), found);
      return;
    }
    for (const auto& [name, value] : one.items()) compare(value, other.value(name, Json{}), inside(name), found);
    for (const auto& [name, value] : other.items()) {
      if (!one.contains(name)) compare(Json{}, value, inside(name), found);
    }
  } else if (is_list_of_tables(one) && is_list_of_tables(other) && one.size() == other.size()) {
    for (std::size_t i = 0; i < one.size(); ++i) compare(one[i], other[i], inside(std::to_string(i)), found);
  } else if (!may_differ(key)) {
    found.insert(key);
  }
}

}  // namespace

std::vector<std::string> differing_settings(const std::string& one, const std::string& other) {
  const Json a = Json::parse(one, nullptr, false), b = Json::parse(other, nullptr, false);
  if (!a.is_object() || !b.is_object()) return {};
  std::set<std::string> keys;
  compare(a, b, {}, keys);
  // Pairs of materials follow from the materials, mostly, and stand in a scene in another order.
  const std::size_t pairs = std::erase_if(keys, [](const std::string& key) { return is_of(key, "material_pair"); });
  if (pairs > 0 && keys.empty()) keys.insert("material_pair");
  return {keys.begin(), keys.end()};
}

std::string scene_beside(const std::filesystem::path& checkpoint, const std::string& scene_hash) {
  std::ifstream file{checkpoint.parent_path() / kRunFile};
  const Json record = Json::parse(file, nullptr, false);
  if (!record.is_object() || record.value("scene_hash", Json{}) != scene_hash) return {};
  return record.contains("resolved_scene") ? record["resolved_scene"].dump() : std::string{};
}

}  // namespace scree
