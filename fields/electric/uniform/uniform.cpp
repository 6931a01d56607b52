#include "uniform.hpp"

#include <algorithm>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

UniformField::UniformField(const Options& options)
    : field_{options.vector("field")}, origin_{options.vector("origin")} {}

std::vector<Parameter> UniformField::parameters() {
  return {
      Parameter::vector("field", "V/m", "the field, in the world"),
      Parameter::vector("origin", "m", "a point of zero potential, in the world").by_default(Vec3{}),
  };
}

void UniformField::evaluate(std::span<const Vec3> position, double, std::span<Vec3> field,
                            std::span<double> potential) const {
  SCREE_REQUIRE(field.size() == position.size(), "uniform: field and position must have equal length");
  SCREE_REQUIRE(potential.empty() || potential.size() == position.size(),
                "uniform: potential must be empty or as long as position");
  std::fill(field.begin(), field.end(), field_);
  for (std::size_t i = 0; i < potential.size(); ++i) potential[i] = -dot(field_, position[i] - origin_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ElectricField, scree::UniformField>("uniform", "The same field everywhere.",
                                                         scree::UniformField::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("uniform", "1.0.0", &list)};
