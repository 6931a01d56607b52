#include "plot/heat_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/axis_map.hpp"
#include "plot/canvas.hpp"
#include "plot/palette.hpp"
#include "scree/base/require.hpp"
#include "scree/results/output_file.hpp"

namespace scree::plot {

namespace {

constexpr double kLeft = 86.0, kTop = 62.0, kBottom = 58.0, kRight = 150.0;  // margins [px]
constexpr double kBar = 18.0, kBarGap = 24.0;                                // the scale, and its distance [px]
constexpr double kLongest = 720.0, kHighest = 560.0;                         // of the picture itself [px]
constexpr double kSmall = 12.0, kNormal = 13.0, kLarge = 15.0;               // text sizes [px]

// Viridis at equal steps (Smith and van der Walt 2015), straight between them.
Colour colour_of(double part) {
  constexpr std::array<std::array<double, 3>, 6> kStops{{{0.267, 0.005, 0.329},
                                                         {0.254, 0.265, 0.530},
                                                         {0.164, 0.471, 0.558},
                                                         {0.135, 0.659, 0.518},
                                                         {0.478, 0.821, 0.318},
                                                         {0.993, 0.906, 0.144}}};
  const double along = std::clamp(part, 0.0, 1.0) * (kStops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(along), kStops.size() - 2);
  const double t = along - static_cast<double>(first);
  const auto mix = [&](std::size_t c) { return (1.0 - t) * kStops[first][c] + t * kStops[first + 1][c]; };
  return {mix(0), mix(1), mix(2)};
}

/// Lays one map out and draws it.
class Painter {
 public:
  explicit Painter(const HeatMap& map) : map_{map}, rows_{map.values.size() / map.columns} {
    const double wide = map.x_range.second - map.x_range.first, high = map.y_range.second - map.y_range.first;
    const double scale = std::min(kLongest / wide, kHighest / high);
    width_ = scale * wide;
    height_ = scale * high;
    range_ = map.value_range ? *map.value_range : range_of_values();
  }
  [[nodiscard]] int page_width() const { return static_cast<int>(std::max(420.0, kLeft + width_ + kRight)); }
  [[nodiscard]] int page_height() const { return static_cast<int>(kTop + std::max(height_, 120.0) + kBottom); }

  void paint(Canvas& canvas) const {
    const double w = page_width(), h = page_height();
    canvas.fill({{0, 0}, {w, 0}, {w, h}, {0, h}}, kPaper);
    canvas.text({kLeft, 24}, map_.title, kLarge, Anchor::left, true);
    canvas.text({kLeft, 44}, map_.note, kSmall, Anchor::left);
    cells(canvas);
    axes(canvas);
    scale(canvas);
  }

 private:
  [[nodiscard]] std::pair<double, double> range_of_values() const {
    double low = INFINITY, high = -INFINITY;
    for (const double value : map_.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low > high) return {0.0, 1.0};
    if (low == high) return {low - 0.5, high + 0.5};
    return {low, high};
  }

  static void box(Canvas& canvas, Canvas::Point from, Canvas::Point to, Colour colour) {
    canvas.fill({from, {to.first, from.second}, to, {from.first, to.second}}, colour);
  }

  void cells(Canvas& canvas) const {
    const double dx = width_ / static_cast<double>(map_.columns), dy = height_ / static_cast<double>(rows_);
    for (std::size_t k = 0; k < map_.values.size(); ++k) {
      if (!std::isfinite(map_.values[k])) continue;
      const double x = kLeft + dx * static_cast<double>(k % map_.columns);
      const std::size_t row = k / map_.columns;
      const double y = kTop + height_ - dy * static_cast<double>(row);
      constexpr double kOverlap = 0.4;  // [px] hides the seams between cells
      box(canvas, {x, y}, {x + dx + kOverlap, y - dy - kOverlap},
          colour_of((map_.values[k] - range_.first) / (range_.second - range_.first)));
    }
  }

  void axes(Canvas& canvas) const {
    const double right = kLeft + width_, bottom = kTop + height_;
    const AxisMap x{Scale::linear, map_.x_range, kLeft, right}, y{Scale::linear, map_.y_range, bottom, kTop};
    canvas.outline({{kLeft, kTop}, {right, kTop}, {right, bottom}, {kLeft, bottom}}, kInk, 1.0);
    for (const Tick& tick : x.ticks()) {
      canvas.line({x(tick.value), bottom}, {x(tick.value), bottom + 5}, kInk, 1.0);
      canvas.text({x(tick.value), bottom + 20}, tick.text, kSmall, Anchor::middle);
    }
    for (const Tick& tick : y.ticks()) {
      canvas.line({kLeft - 5, y(tick.value)}, {kLeft, y(tick.value)}, kInk, 1.0);
      canvas.text({kLeft - 9, y(tick.value) + 4}, tick.text, kSmall, Anchor::right);
    }
    canvas.text({kLeft + 0.5 * width_, bottom + 42}, map_.x_label, kNormal, Anchor::middle);
    canvas.text({22, kTop + 0.5 * height_}, map_.y_label, kNormal, Anchor::middle, false, true);
  }

  void scale(Canvas& canvas) const {
    const double left = kLeft + width_ + kBarGap, bottom = kTop + std::max(height_, 120.0);
    constexpr int kSteps = 100;
    const double step = (bottom - kTop) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      box(canvas, {left, bottom - k * step}, {left + kBar, bottom - (k + 1) * step - 0.4},
          colour_of((k + 0.5) / kSteps));
    }
    const AxisMap values{Scale::linear, range_, bottom, kTop};
    for (const Tick& tick : values.ticks()) {
      canvas.line({left + kBar, values(tick.value)}, {left + kBar + 5, values(tick.value)}, kInk, 1.0);
      canvas.text({left + kBar + 9, values(tick.value) + 4}, tick.text, kSmall, Anchor::left);
    }
    canvas.text({left + kBar + 70, 0.5 * (kTop + bottom)}, map_.value_label, kNormal, Anchor::middle, false, true);
  }

  const HeatMap& map_;
  std::size_t rows_;
  double width_, height_;            // of the picture [px]
  std::pair<double, double> range_;  // of the scale
};

}  // namespace

void write_heat_map(const HeatMap& map, const std::filesystem::path& stem) {
  SCREE_REQUIRE(map.columns > 0 && !map.values.empty() && map.values.size() % map.columns == 0,
                "a heat map has whole rows of values");
  const Painter painter{map};
  const auto draw = [&](Canvas& canvas) { painter.paint(canvas); };
  const std::string svg = Canvas::as_svg(painter.page_width(), painter.page_height(), draw);
  const std::string png = Canvas::as_png(painter.page_width(), painter.page_height(), draw);
  replace_file(stem.string() + ".svg", std::string_view{svg});
  replace_file(stem.string() + ".png", std::string_view{png});
}

}  // namespace scree::plot
