#include "scree/interfaces/force_field.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace {

class Push final : public scree::ForceField {
 public:
  explicit Push(const scree::Options& options) : acceleration_{options.vector("acceleration")} {}
  void add_forces(const scree::BodyView& bodies, double, scree::WrenchView out) const override {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies.motion[i] == scree::Motion::dynamic) out.force[i] += bodies.mass[i] * acceleration_;
  }

 private:
  scree::Vec3 acceleration_;  // [m/s2], world
};

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, Push>("push", "The same acceleration for every body.",
                                       {scree::Parameter::vector("acceleration", "m/s2", "given to every body")});
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("push", "1.0", &list)};
