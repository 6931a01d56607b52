#include "scree/simulation/scene_difference.hpp"

#include <algorithm>
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

/// "/source/0/rate" as "source.0.rate".
std::string setting_of(const std::string& pointer) {
  std::string key = pointer.substr(std::min<std::size_t>(1, pointer.size()));
  std::ranges::replace(key, '/', '.');
  return key;
}

}  // namespace

std::vector<std::string> differing_settings(const std::string& one, const std::string& other) {
  const Json a = Json::parse(one, nullptr, false), b = Json::parse(other, nullptr, false);
  if (!a.is_object() || !b.is_object()) return {};
  const Json flat_a = a.flatten(), flat_b = b.flatten();
  std::set<std::string> keys;
  for (const auto* side : {&flat_a, &flat_b}) {
    const Json& facing = side == &flat_a ? flat_b : flat_a;
    for (const auto& [pointer, value] : side->items()) {
      const std::string key = setting_of(pointer);
      if (!may_differ(key) && (!facing.contains(pointer) || facing[pointer] != value)) keys.insert(key);
    }
  }
  // Pairs of materials follow from the materials, mostly.
  const auto is_pair = [](const std::string& key) { return is_of(key, "material_pair"); };
  if (!std::ranges::all_of(keys, is_pair)) std::erase_if(keys, is_pair);
  return {keys.begin(), keys.end()};
}

std::string scene_beside(const std::filesystem::path& checkpoint, const std::string& scene_hash) {
  std::ifstream file{checkpoint.parent_path() / kRunFile};
  const Json record = Json::parse(file, nullptr, false);
  if (!record.is_object() || record.value("scene_hash", "") != scene_hash) return {};
  return record.contains("resolved_scene") ? record["resolved_scene"].dump() : std::string{};
}

}  // namespace scree
