#include "scree/simulation/kept_options.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "scree/config/resolved.hpp"
#include "scree/interfaces/plugin.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

constexpr const char* kOptions = "options";

/// Hands everything on, and knows whether there was anything.
class NotingWriter final : public StateWriter {
 public:
  explicit NotingWriter(StateWriter& out) : out_{out} {}
  using StateWriter::write;
  void write(std::string_view name, std::span<const double> values) override { note().write(name, values); }
  void write(std::string_view name, std::span<const std::uint64_t> values) override { note().write(name, values); }
  void write(std::string_view name, std::string_view text) override { note().write(name, text); }
  std::unique_ptr<StateWriter> group(std::string_view name) override { return note().group(name); }
  [[nodiscard]] bool wrote() const { return wrote_; }

 private:
  StateWriter& note() {
    wrote_ = true;
    return out_;
  }
  StateWriter& out_;
  bool wrote_ = false;
};

/// A value as JSON.
std::string shown(const nlohmann::json& table, const std::string& key) {
  return table.contains(key) ? table.at(key).dump() : "left out";
}

}  // namespace

void save_observer(const Options& options, const Plugin& observer, StateWriter& out) {
  NotingWriter writer{out};
  observer.save(writer);
  if (writer.wrote()) out.write(kOptions, std::string_view{to_json_text(options, -1)});
}

void check_kept_options(const PartInfo& info, const Options& options, const StateReader& in) {
  if (!in.has(kOptions)) return;
  const auto before = nlohmann::json::parse(in.text(kOptions)), now = nlohmann::json::parse(to_json_text(options, -1));
  auto keys = before;
  keys.update(now);
  for (const auto& [key, value] : keys.items()) {
    if (shown(before, key) == shown(now, key)) continue;
    const std::string sentence =
        "is " + shown(now, key) + ", but was " + shown(before, key) + " when the checkpoint was written, and " +
        info.label() +
        " goes on with what it has summed up; keep the setting, or give the observer another `name`, to begin anew";
    throw options.find(key) != nullptr ? options.error(key, sentence) : options.error("'" + key + "' " + sentence);
  }
}

}  // namespace scree
