// second_order: the solvers of this folder.
#include "interior_point.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "semismooth_newton.hpp"

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::InteriorPoint>(
      "interior_point",
      "Interior point, finished by Newton steps: to the last digits, a sparse factorisation an iteration.",
      scree::InteriorPoint::parameters());
  plugins.add<scree::CcpSolver, scree::SemismoothNewton>(
      "semismooth_newton",
      "Semi-smooth Newton with a sparse factorisation: to the last digits, best from a good guess.",
      scree::SemismoothNewton::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("second_order", "1.0.0", &list)};
