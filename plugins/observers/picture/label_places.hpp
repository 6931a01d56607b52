// Where the names of bodies are written, so that they hide neither another body nor each other.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "plot/canvas.hpp"

namespace scree {

/// A rectangle of the page, y down [px].
struct Box {
  double left, top, right, bottom;
};

/// Whether a box and a convex polygon have a point in common.
[[nodiscard]] bool overlap(const Box& box, const std::vector<plot::Canvas::Point>& polygon);

/// Finds places, one label after the other.
class LabelPlaces {
 public:
  /// `obstacles` are convex polygons on the page [px]: what labels must not hide, the labelled bodies among them.
  LabelPlaces(const Box& frame, std::vector<std::vector<plot::Canvas::Point>> obstacles)
      : frame_{frame}, obstacles_{std::move(obstacles)} {}

  /// A free box of the given size [px] near `body` (its bounds), which is then kept: above, below, right or left of it,
  /// as near as it goes. None when there is no room. A slender upright body has its name at its side.
  std::optional<Box> place(const Box& body, double width, double height);
  /// Keeps a box that has its place.
  void keep(const Box& box) { kept_.push_back(box); }

 private:
  [[nodiscard]] bool is_free(const Box& box) const;

  Box frame_;
  std::vector<std::vector<plot::Canvas::Point>> obstacles_;
  std::vector<Box> kept_;
};

}  // namespace scree
