#include "scree/results/run_record.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scree/results/output_file.hpp"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json by_name(const std::vector<std::pair<std::string, double>>& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = value;
  return object;
}

Json scene(const std::string& text) {
  Json parsed = Json::parse(text, nullptr, false);
  return parsed.is_discarded() ? Json(text) : parsed;
}

Json plugins(const std::vector<PluginRecord>& records) {
  Json list = Json::array();
  for (const PluginRecord& plugin : records) {
    list.push_back({{"kind", plugin.kind}, {"name", plugin.name}, {"version", plugin.version}, {"file", plugin.file}});
  }
  return list;
}

Json tables(const std::vector<ReportTable>& reports) {
  Json list = Json::array();
  for (const ReportTable& table : reports) {
    list.push_back({{"title", table.title}, {"header", table.header}, {"rows", table.rows}});
  }
  return list;
}

}  // namespace

std::string to_hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string to_json(const RunRecord& record) {
  Json json;
  json["exit_status"] = record.exit_status;
  json["outcome"] = record.outcome;
  json["simulated_time"] = record.simulated_time;
  json["steps"] = record.steps;
  json["wall_time"] = record.wall_time;
  json["bodies"] = record.bodies;
  json["contacts"] = record.contacts;
  json["state_hash"] = to_hex(record.state_hash);
  json["scree_version"] = record.scree_version;
  json["compiler"] = record.compiler;
  json["scene_file"] = record.scene_file;
  json["scene_hash"] = record.scene_hash;
  json["seed"] = record.seed;
  json["threads"] = record.threads;
  json["time_step"] = record.time_step;
  json["phase_seconds"] = by_name(record.phase_seconds);
  json["measures"] = by_name(record.measures);
  json["plugins"] = plugins(record.plugins);
  json["log"] = record.log;
  json["tables"] = tables(record.tables);
  json["resolved_scene"] = scene(record.resolved_scene);
  // A name in a foreign encoding must not cost the record: its bad bytes are replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_run_record(const RunRecord& record, const std::filesystem::path& file) {
  replace_file(file, std::string_view{to_json(record)});
}

}  // namespace scree
