// The observer `track`: the motion of bodies as a table.
#include <cmath>
#include <optional>
#include <set>

#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {
namespace {

class Track final : public Observer {
 public:
  explicit Track(const Options& options)
      : names_{options.texts("bodies")}, interval_{options.number("interval")}, file_{options.text("file")} {}

  static std::vector<Parameter> parameters() {
    return {Parameter::texts("bodies", "names of scene bodies; empty for every dynamic body")
                .by_default(Parameter::Value{std::vector<std::string>{}}),
            Parameter::number("interval", "s", "simulated time between rows; 0 for every step")
                .at_least(0.0)
                .by_default(0.0),
            Parameter::text("file",
                            "name of the table, in the folder of results; track.csv or track_NAME.csv when left out")
                .by_default("")};
  }

  void setup(SceneServices& services, const std::filesystem::path& results) override {
    for (const std::string& name : names_) wanted_.insert(services.body(name).id);
    every_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(interval_ / services.time_step())));
    if (file_.empty()) file_ = result_stem("track", "track", services.part_name()) + ".csv";
    claim_results(services, file_, {""});
    if (!results.empty()) path_ = results / file_;
  }

  void observe(const Observation& now, Attributes&) override {
    if (path_.empty() || now.step % every_ != 0) return;
    if (!table_) open(*now.bodies.attributes);
    for (std::size_t i = 0; i < now.bodies.size(); ++i) {
      const bool wanted =
          wanted_.empty() ? now.bodies.motion[i] == Motion::dynamic : wanted_.contains(now.bodies.id[i]);
      if (wanted) add_row(now, i);
    }
  }

  void finish(const Observation&) override {
    if (table_) table_->close();
  }

 private:
  /// Opened at the first row, when every part has declared its attributes.
  void open(const Attributes& attributes) {
    std::vector<CsvColumn> columns{{"time", "s"},   {"id", ""},    {"x", "m"},    {"y", "m"},      {"z", "m"},
                                   {"vx", "m/s"},   {"vy", "m/s"}, {"vz", "m/s"}, {"wx", "rad/s"}, {"wy", "rad/s"},
                                   {"wz", "rad/s"}, {"qw", ""},    {"qx", ""},    {"qy", ""},      {"qz", ""}};
    for (AttributeId a = 0; a < attributes.count(); ++a)
      columns.push_back({attributes.info(a).name, attributes.info(a).unit});
    table_.emplace(path_, columns);
  }

  void add_row(const Observation& now, std::size_t i) {
    table_->cell(now.time).cell(now.bodies.id[i]);
    for (const Vec3& v : {now.bodies.position[i], now.bodies.velocity[i], now.bodies.angular_velocity[i]}) {
      table_->cell(v.x).cell(v.y).cell(v.z);
    }
    const Quat& q = now.bodies.orientation[i];
    table_->cell(q.w).cell(q.x).cell(q.y).cell(q.z);
    for (AttributeId a = 0; a < now.bodies.attributes->count(); ++a) table_->cell(now.bodies.attribute(a)[i]);
    table_->end_row();
  }

  std::vector<std::string> names_;
  double interval_;  // [s]
  std::string file_;
  std::filesystem::path path_;
  std::set<BodyId> wanted_;
  std::uint64_t every_ = 1;  // steps between rows
  std::optional<CsvWriter> table_;
};

void list(PluginList& plugins) {
  plugins.add<Observer, Track>("track", "Writes position, velocity and attributes of bodies as a CSV table.",
                               Track::parameters());
}

}  // namespace
}  // namespace scree

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("track", "1.0.0", &scree::list)};
