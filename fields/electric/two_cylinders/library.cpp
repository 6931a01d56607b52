#include "scree/interfaces/plugin_library.hpp"
#include "two_cylinders.hpp"

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ElectricField, scree::TwoCylinders>(
      "two_cylinders", "Field between a grounded roll and a parallel cylindrical electrode.",
      scree::TwoCylinders::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("two_cylinders", "1.0.0", &list)};
