#include "projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

Window Window::empty() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return {{kInfinite, kInfinite}, {-kInfinite, -kInfinite}};
}

void Window::include(Point2 point, double radius) {
  lower = {std::min(lower.x, point.x - radius), std::min(lower.y, point.y - radius)};
  upper = {std::max(upper.x, point.x + radius), std::max(upper.y, point.y + radius)};
}

Window with_margin(const Window& window) {
  constexpr double kMargin = 0.04, kMostSlender = 3.0;
  if (window.is_empty()) return {{-0.5, -0.5}, {0.5, 0.5}};
  const double longest = std::max(window.width(), window.height());
  const double edge = longest > 0.0 ? longest : 1.0;
  const double half_width = 0.5 * std::max(window.width(), edge / kMostSlender) + kMargin * edge;
  const double half_height = 0.5 * std::max(window.height(), edge / kMostSlender) + kMargin * edge;
  const Point2 middle = 0.5 * (window.lower + window.upper), half{half_width, half_height};
  return {middle - half, middle + half};
}

std::string axis_label(const Vec3& direction, const std::string& otherwise) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1.0 - 1e-9) continue;
    return std::string(direction[axis] < 0.0 ? "-" : "") + "xyz"[axis] + " [m]";
  }
  return otherwise + " [m]";
}

}  // namespace scree
