// From the bodies of a simulation to a picture of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture.hpp"
#include "scree/interfaces/observer.hpp"
#include "vtp/cut_view.hpp"

namespace scree {

class Materials;

/// What the bodies of a simulation are made of, and called.
struct SceneWords {
  const ShapeSet& shapes;
  const Materials& materials;
  std::vector<std::string> names;  ///< by body id; may be shorter; empty: no labels
};

/// How a scene is looked at.
struct View {
  Projection projection{{1, 0, 0}, {0, 1, 0}};
  std::optional<Window> window;  ///< what is seen; bounds of everything bounded when absent
  CutView cut = {};              ///< what is shown
  double velocity_arrows = 0.0;  ///< arrows show the way of so much time [s]; 0: none
};

/// Fills in everything but the width, the title and the marks. Walls that are farther from the viewer, and grains that
/// are, come first. Grains lie on all walls: what is inside of a machine shall be seen.
[[nodiscard]] Picture scene_picture(const Observation& now, const SceneWords& words, const View& view);

}  // namespace scree
