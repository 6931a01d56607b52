#include "scree/interfaces/plugin_library.hpp"
#include "sphere_cluster.hpp"

namespace {
void list(scree::PluginList& plugins) {
  plugins.add<scree::NarrowPhase, scree::SphereCluster>(
      "sphere_cluster",
      "Closed forms: spheres and clusters of spheres against all kinds; corners of boxes and others against planes.");
}
}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("sphere_cluster", "1.0.0", &list)};
