// The observer `contacts`: contact points, gaps and impulses as a table.
#include <cmath>
#include <optional>

#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {
namespace {

class Contacts final : public Observer {
 public:
  explicit Contacts(const Options& options)
      : interval_{options.number("interval")},
        loaded_only_{options.boolean("loaded_only")},
        file_{options.text("file")} {}

  static std::vector<Parameter> parameters() {
    return {Parameter::number("interval", "s", "simulated time between looks; 0 for every step")
                .at_least(0.0)
                .by_default(0.0),
            Parameter::boolean("loaded_only", "leave out contacts without an impulse").by_default(true),
            Parameter::text(
                "file", "name of the table, in the folder of results; contacts.csv or contacts_NAME.csv when left out")
                .by_default("")};
  }

  void setup(SceneServices& services, const std::filesystem::path& results) override {
    every_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(interval_ / services.time_step())));
    if (file_.empty()) file_ = result_stem("contacts", "contacts", services.part_name()) + ".csv";
    claim_results(services, file_, {""});
    if (results.empty()) return;
    table_.emplace(results / file_, std::vector<CsvColumn>{{"time", "s"},
                                                           {"body_a", ""},
                                                           {"body_b", ""},
                                                           {"x", "m"},
                                                           {"y", "m"},
                                                           {"z", "m"},
                                                           {"nx", ""},
                                                           {"ny", ""},
                                                           {"nz", ""},
                                                           {"gap", "m"},
                                                           {"impulse_x", "N s"},
                                                           {"impulse_y", "N s"},
                                                           {"impulse_z", "N s"},
                                                           {"impulse_normal", "N s"},
                                                           {"slip_speed", "m/s"},
                                                           {"moment_x", "N m s"},
                                                           {"moment_y", "N m s"},
                                                           {"moment_z", "N m s"}});
  }

  void observe(const Observation& now, Attributes&) override {
    if (!table_ || now.step % every_ != 0) return;
    for (std::size_t c = 0; c < now.contacts.size(); ++c) {
      if (!loaded_only_ || now.contacts.impulse[c] != Vec3{}) add_row(now, c);
    }
  }

  void finish(const Observation&) override {
    if (table_) table_->close();
  }

 private:
  void add_row(const Observation& now, std::size_t c) {
    const Contact& contact = now.contacts.contact[c];
    const Vec3& local = now.contacts.impulse[c];
    const Vec3& after = now.contacts.velocity_after[c];
    table_->cell(now.time).cell(now.bodies.id[contact.a]).cell(now.bodies.id[contact.b]);
    for (const Vec3& v : {contact.point, contact.normal}) table_->cell(v.x).cell(v.y).cell(v.z);
    const ContactFrame frame = contact_frame(contact.normal);
    const Vec3 impulse = to_world(frame, local);
    const std::span<const Vec3> angular = now.contacts.angular_impulse;
    const Vec3 moment = angular.empty() ? Vec3{} : to_world(frame, angular[c]);
    table_->cell(contact.gap).cell(impulse.x).cell(impulse.y).cell(impulse.z).cell(local.x);
    table_->cell(std::hypot(after.y, after.z)).cell(moment.x).cell(moment.y).cell(moment.z);
    table_->end_row();
  }

  double interval_;  // [s]
  bool loaded_only_;
  std::string file_;
  std::uint64_t every_ = 1;  // steps between looks
  std::optional<CsvWriter> table_;
};

void list(PluginList& plugins) {
  plugins.add<Observer, Contacts>("contacts", "Writes contact points, gaps and impulses as a CSV table.",
                                  Contacts::parameters());
}

}  // namespace
}  // namespace scree

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("contacts", "1.0.0", &scree::list)};
