#include "emitter.hpp"
#include "fill.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Source, scree::Emitter>("emitter", "Particles that come out of a rectangle at a rate.",
                                             scree::Emitter::parameters());
  plugins.add<scree::Source, scree::Fill>("fill", "A box full of particles at the beginning.",
                                          scree::Fill::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("feed", "1.0.0", &list)};
