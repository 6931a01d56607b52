#include "label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree {

namespace {

/// A direction on the page.
struct Way {
  double x, y;
};

using Polygon = std::vector<plot::Canvas::Point>;

// The part of a line in a direction that a polygon covers.
std::pair<double, double> extent(const Polygon& polygon, const Way& way) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& [x, y] : polygon) {
    const double along = x * way.x + y * way.y;
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return {low, high};
}

}  // namespace

// Two convex sets are apart if and only if they are along the normal of an edge of one of them (separating axis).
bool overlap(const Box& box, const Polygon& polygon) {
  const Polygon corners{{box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}};
  const auto apart_along = [&](const Way& way) {
    const auto [low, high] = extent(polygon, way);
    const auto [box_low, box_high] = extent(corners, way);
    return high < box_low || box_high < low;
  };
  if (apart_along({1, 0}) || apart_along({0, 1})) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& [x, y] = polygon[i];
    const auto& [next_x, next_y] = polygon[(i + 1) % polygon.size()];
    if (apart_along({next_y - y, x - next_x})) return false;
  }
  return true;
}

std::optional<Box> LabelPlaces::place(const Box& body, double width, double height) {
  const double x = 0.5 * (body.left + body.right), y = 0.5 * (body.top + body.bottom);
  const double half_width = 0.5 * (body.right - body.left), half_height = 0.5 * (body.bottom - body.top);
  constexpr Way kAbove{0, -1}, kBelow{0, 1}, kRight{1, 0}, kLeft{-1, 0};
  const bool slender = half_height > 1.5 * half_width;
  const std::array ways =
      slender ? std::array{kLeft, kRight, kAbove, kBelow} : std::array{kAbove, kBelow, kRight, kLeft};
  for (const Way& way : ways) {
    // Outwards from the middle, until the label touches nothing.
    const double farthest = way.x == 0.0 ? half_height + height : half_width + width;
    for (double shift = 0.0; shift <= farthest; shift += 1.0) {
      const double cx = x + way.x * shift, cy = y + way.y * shift;
      const Box box{cx - 0.5 * width, cy - 0.5 * height, cx + 0.5 * width, cy + 0.5 * height};
      if (!is_free(box)) continue;
      kept_.push_back(box);
      return box;
    }
  }
  return std::nullopt;
}

bool LabelPlaces::is_free(const Box& box) const {
  if (box.left < frame_.left || box.right > frame_.right || box.top < frame_.top || box.bottom > frame_.bottom) {
    return false;
  }
  const auto meets = [&](const Box& other) {
    return box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom;
  };
  if (std::any_of(kept_.begin(), kept_.end(), meets)) return false;
  constexpr double kGap = 4.0;
  const Box wide{box.left - kGap, box.top - kGap, box.right + kGap, box.bottom + kGap};
  return std::none_of(obstacles_.begin(), obstacles_.end(),
                      [&](const std::vector<plot::Canvas::Point>& polygon) { return overlap(wide, polygon); });
}

}  // namespace scree
