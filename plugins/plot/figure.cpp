#include "plot/figure.hpp"

#include <algorithm>
#include <array>

#include "plot/axis_map.hpp"
#include "plot/canvas.hpp"
#include "plot/palette.hpp"
#include "scree/base/require.hpp"
#include "scree/results/output_file.hpp"

namespace scree::plot {

namespace {

using Point = Canvas::Point;

constexpr double kSmall = 12.0, kNormal = 13.0, kLarge = 15.0;  // text sizes [px]
constexpr double kPoint = 3.0;                                  // radius of a point [px]
constexpr double kFillOpacity = 0.22;
constexpr double kSwatch = 22.0, kPad = 8.0, kLegendRow = 19.0;  // of the legend [px]

/// How a series is told from the others: colours first, then strokes.
struct Pen {
  Colour colour;
  Stroke stroke;
};

Pen pen(std::size_t series) {
  constexpr std::array kStrokes{Stroke::solid, Stroke::dashed, Stroke::dotted};
  return {kColours[series % kColours.size()], kStrokes[series / kColours.size() % kStrokes.size()]};
}

Colour with_opacity(Colour colour, double opacity) { return {colour.red, colour.green, colour.blue, opacity}; }

/// Draws one figure onto a canvas.
class Painter {
 public:
  Painter(const Figure& figure, Canvas& canvas)
      : figure_{figure},
        canvas_{canvas},
        x_{figure.x.scale, x_range(), left_, right_},
        y_{figure.y.scale, y_range(), bottom_, top_} {}

  void paint() {
    const double w = figure_.width, h = figure_.height;
    canvas_.fill({{0, 0}, {w, 0}, {w, h}, {0, h}}, {1, 1, 1});
    titles();
    grid();
    for (std::size_t i = 0; i < figure_.series.size(); ++i) {
      // A point on the frame is drawn whole.
      const double margin = figure_.series[i].style == SeriesStyle::points ? kPoint : 0.0;
      canvas_.clip({left_ - margin, top_ - margin}, {right_ + margin, bottom_ + margin});
      series(figure_.series[i], pen(i));
      canvas_.clip_end();
    }
    guides();
    canvas_.polyline({{left_, top_}, {left_, bottom_}, {right_, bottom_}, {right_, top_}, {left_, top_}}, kInk, 1.0);
    legend();
  }

 private:
  [[nodiscard]] std::pair<double, double> x_range() const {
    if (figure_.x.range) return *figure_.x.range;
    std::vector<double> all;
    for (const Series& s : figure_.series) all.insert(all.end(), s.x.begin(), s.x.end());
    for (const VerticalLine& line : figure_.lines) all.push_back(line.x);
    return range_of(all, figure_.x.scale, false);
  }
  [[nodiscard]] std::pair<double, double> y_range() const {
    if (figure_.y.range) return *figure_.y.range;
    std::vector<double> all;
    for (const Series& s : figure_.series) all.insert(all.end(), s.y.begin(), s.y.end());
    return range_of(all, figure_.y.scale, true);
  }

  void titles() {
    canvas_.text({left_, 26}, figure_.title, kLarge, Anchor::left, true);
    canvas_.text({left_, 45}, figure_.note, kSmall, Anchor::left);
    canvas_.text({0.5 * (left_ + right_), figure_.height - 14.0}, figure_.x.label, kNormal, Anchor::middle);
    canvas_.text({22, 0.5 * (top_ + bottom_)}, figure_.y.label, kNormal, Anchor::middle, false, true);
  }

  void grid() {
    for (const Tick& tick : x_.ticks()) {
      const double x = x_(tick.value);
      canvas_.line({x, top_}, {x, bottom_}, kGrid, 1.0);
      canvas_.line({x, bottom_}, {x, bottom_ + 5}, kInk, 1.0);
      canvas_.text({x, bottom_ + 20}, tick.text, kSmall, Anchor::middle);
    }
    for (const Tick& tick : y_.ticks()) {
      const double y = y_(tick.value);
      canvas_.line({left_, y}, {right_, y}, kGrid, 1.0);
      canvas_.line({left_ - 5, y}, {left_, y}, kInk, 1.0);
      canvas_.text({left_ - 9, y + 4}, tick.text, kSmall, Anchor::right);
    }
  }

  void series(const Series& s, const Pen& pen) {
    if (s.style == SeriesStyle::steps) return steps(s, pen.colour);
    std::vector<Point> run;
    const auto end_run = [&] {
      if (s.style == SeriesStyle::line && run.size() > 1) canvas_.polyline(run, pen.colour, 1.8, pen.stroke);
      run.clear();
    };
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!x_.can_show(s.x[i]) || !y_.can_show(s.y[i])) {
        end_run();
        continue;
      }
      run.emplace_back(x_(s.x[i]), y_(s.y[i]));
      if (s.style == SeriesStyle::points) point(run.back(), pen);
    }
    end_run();
  }

  // Full, then empty, then small.
  void point(Point at, const Pen& pen) {
    canvas_.disc(at, pen.stroke == Stroke::dotted ? 1.8 : kPoint, pen.colour);
    if (pen.stroke == Stroke::dashed) canvas_.disc(at, 1.6, kPaper);
  }

  void steps(const Series& s, Colour colour) {
    std::vector<Point> outline{{x_(s.x.front()), bottom_}};
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      const double y = y_.can_show(s.y[i]) ? y_(s.y[i]) : bottom_;
      outline.emplace_back(x_(s.x[i]), y);
      outline.emplace_back(x_(s.x[i + 1]), y);
    }
    outline.emplace_back(x_(s.x.back()), bottom_);
    canvas_.fill(outline, with_opacity(colour, kFillOpacity));
    canvas_.polyline(outline, colour, 1.8);
  }

  void guides() {
    for (const VerticalLine& line : figure_.lines) {
      const double x = x_(line.x);
      canvas_.line({x, top_}, {x, bottom_}, kGuide, 1.3, Stroke::dashed);
      if (!line.label.empty()) canvas_.text({x + 13, bottom_ - 8}, line.label, kSmall, Anchor::left, false, true);
    }
    for (const Region& region : figure_.regions) {
      const double from = std::max(left_, x_(region.from)), to = std::min(right_, x_(region.to));
      canvas_.text({0.5 * (from + to), top_ - 8}, region.label, kSmall, Anchor::middle, true);
    }
  }

  // Where the entries of the legend begin: rows between the titles and the frame, where they hide no data.
  [[nodiscard]] std::vector<Point> legend_places() const {
    std::vector<Point> places;
    Point next{left_, 63};
    for (const Series& s : figure_.series) {
      const double width = s.label.empty() ? 0.0 : kSwatch + canvas_.text_width(s.label, kSmall) + kPad;
      if (next.first > left_ && next.first + width > right_) next = {left_, next.second + kLegendRow};
      places.push_back(next);
      if (width > 0.0) next.first += width + 3 * kPad;
    }
    return places;
  }
  [[nodiscard]] double legend_bottom() const { return legend_places_.empty() ? 63.0 : legend_places_.back().second; }

  void legend() {
    for (std::size_t i = 0; i < figure_.series.size(); ++i) {
      const Series& s = figure_.series[i];
      if (s.label.empty()) continue;
      const auto [x, y] = legend_places_[i];
      swatch(s.style, {x, y}, kSwatch, pen(i));
      canvas_.text({x + kSwatch + kPad, y + 4}, s.label, kSmall, Anchor::left);
    }
  }

  void swatch(SeriesStyle style, Point at, double width, const Pen& pen) {
    const auto [x, y] = at;
    if (style == SeriesStyle::points) return point({x + 0.5 * width, y}, pen);
    if (style == SeriesStyle::line) return canvas_.line({x, y}, {x + width, y}, pen.colour, 1.8, pen.stroke);
    const std::vector<Point> box{{x, y - 5}, {x + width, y - 5}, {x + width, y + 5}, {x, y + 5}, {x, y - 5}};
    canvas_.fill(box, with_opacity(pen.colour, kFillOpacity));
    canvas_.polyline(box, pen.colour, 1.5);
  }

  const Figure& figure_;
  Canvas& canvas_;
  double left_ = 78.0, right_ = figure_.width - 24.0;  // of the frame [px]
  std::vector<Point> legend_places_ = legend_places();
  double top_ = legend_bottom() + 39.0, bottom_ = figure_.height - 58.0;
  AxisMap x_, y_;
};

void check_lengths(const Figure& figure) {
  for (const Series& s : figure.series) {
    const std::size_t expected = s.y.size() + (s.style == SeriesStyle::steps ? 1 : 0);
    SCREE_REQUIRE(s.x.size() == expected, "a series has as many x as y; a histogram one more, its edges");
  }
}

}  // namespace

void write_figure(const Figure& figure, const std::filesystem::path& stem) {
  check_lengths(figure);
  const auto draw = [&](Canvas& canvas) { Painter{figure, canvas}.paint(); };
  const std::string svg = Canvas::as_svg(figure.width, figure.height, draw);
  const std::string png = Canvas::as_png(figure.width, figure.height, draw);
  replace_file(stem.string() + ".svg", std::string_view{svg});
  replace_file(stem.string() + ".png", std::string_view{png});
}

}  // namespace scree::plot
