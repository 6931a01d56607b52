#include "image_force.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, scree::ImageForce>(
      "image_force", "Non-metal grains charged by the corona and held on the roll by their image charge.",
      scree::ImageForce::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("image_force", "1.0.0", &list)};
