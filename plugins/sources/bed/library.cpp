#include "bed.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Source, scree::BedSource>("bed", "Spheres read from a file at the beginning.",
                                               scree::BedSource::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("bed", "1.0.0", &list)};
