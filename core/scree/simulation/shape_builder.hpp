// From the words of a scene to the data of a shape.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// The frame that the primitives of a shape are expressed in.
enum class ShapeFrame {
  principal,  ///< centre of mass and principal axes: for bodies that forces move
  as_written  ///< the frame of the scene's text: for fixed and kinematic bodies
};

/// What a user should know of the shapes of a scene, as sentences.
struct ShapeRemarks {
  std::vector<std::string> notes;     ///< for the log
  std::vector<std::string> warnings;  ///< with their place: what is usable, but hardly meant
};

/// Builds a shape from a validated `[shape.NAME]` table (scene_sections: shape_variants()).
/// @throws Error (usage, io) when the geometry cannot be used: a hull of coplanar points, a missing file, or, in the
/// principal frame, a shape without a volume: a plane, a hollow cylinder, a mesh that does not bound a solid. As written,
/// such a mesh is used as it is, and `remarks` say what is wrong with it.
[[nodiscard]] ShapeData build_shape(const std::string& name, const Options& options, ShapeFrame frame,
                                    ShapeRemarks& remarks);

/// The pose given by position, rotation_axis and rotation_angle. @throws Error (usage) for a zero axis.
[[nodiscard]] Pose pose_of(const Options& options);

}  // namespace scree
