// Scenes for collision phases: bodies as they lie or move in one moment, with nothing else of a simulation.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scree/model/body_store.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::bench {

/// Shapes and bodies; velocities say how they go on.
struct Scene {
  std::string name;
  ShapeSet shapes;
  BodyStore bodies;
};

/// Names of all scenes, in the order of tables.
[[nodiscard]] std::vector<std::string> scene_names();

/// A scene with about `count` bodies, the same each time: `spheres`, `spread_50` and `spread_10000` (sizes 1:50 and 1:10^4),
/// `hulls` (16 vertices), `boxes`, `clusters` (8 spheres), `drum`, `separator`. @throws std::runtime_error.
[[nodiscard]] std::unique_ptr<Scene> make_scene(const std::string& name, std::size_t count);

}  // namespace scree::bench
