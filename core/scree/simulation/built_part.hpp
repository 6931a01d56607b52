// A part of a shape while it is built: the primitive, and the mass properties of its solid.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/simulation/shape_builder.hpp"

namespace scree {

/// A primitive with the mass properties of its solid, in the frame of the shape.
struct BuiltPart {
  PrimitiveData data;
  MassProperties mass;
  bool has_volume = true;
  std::string why_not;  ///< why it has no volume
};

/// What the building of a part depends on besides its settings.
struct PartContext {
  std::string name;  ///< of the shape, for messages
  ShapeFrame frame;  ///< principal: the part has to be a solid
  ShapeRemarks& remarks;
};

/// Parts made of points and triangles; `options` is a validated table of the type that the function is named after.
/// @throws Error (usage, io) at the place in the scene. @{
[[nodiscard]] BuiltPart build_hull(const Options& options, const PartContext& context);
[[nodiscard]] BuiltPart build_mesh(const Options& options, const PartContext& context);
[[nodiscard]] BuiltPart build_heightfield(const Options& options, const PartContext& context);
[[nodiscard]] BuiltPart build_cluster(const Options& options);
/// @}

}  // namespace scree
