// Figure: a plot with axes, as data, and how it becomes SVG and PNG.
//
//     Figure figure;
//     figure.x = {"x [m]"};
//     figure.y = {"residual [m/s]", Scale::logarithmic};
//     figure.series.push_back({"apgd", SeriesStyle::line, times, residuals});
//     write_figure(figure, folder / "convergence");   // convergence.svg and convergence.png
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree::plot {

enum class Scale { linear, logarithmic };

/// An axis: what it shows, with the unit in the label.
struct Axis {
  std::string label;
  Scale scale = Scale::linear;
  /// Ends of the axis; from the data when absent. A linear y axis of data that are not negative begins at zero.
  std::optional<std::pair<double, double>> range = {};
};

enum class SeriesStyle {
  line,  ///< y over x, as many as x
  points,
  steps  ///< a histogram: one more x (the edges) than y, filled
};

/// Data with one legend entry. Values that are not finite leave a gap.
struct Series {
  std::string label;
  SeriesStyle style = SeriesStyle::line;
  std::vector<double> x, y;
};

/// A dashed vertical line with a word beside it.
struct VerticalLine {
  double x = 0.0;
  std::string label;
};

/// A word above a part of the x axis.
struct Region {
  double from = 0.0, to = 0.0;
  std::string label;
};

/// A plot. Colours follow the order of the series (Okabe and Ito 2008, readable with colour blindness); after six they come
/// again with dashes, or points as rings, and then with dots, or small points.
struct Figure {
  std::string title;
  std::string note;  ///< small, under the title
  Axis x, y;
  std::vector<Series> series;
  std::vector<VerticalLine> lines;
  std::vector<Region> regions;
  int width = 900;   ///< [px] of the PNG, [pt] of the SVG
  int height = 520;  ///< the same
};

/// Writes `stem`.svg and `stem`.png, each as a whole or not at all. @throws Error (io) naming the file and the reason.
void write_figure(const Figure& figure, const std::filesystem::path& stem);

}  // namespace scree::plot
