// HeatMap: values over the cells of a plane, as colours with a scale beside them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree::plot {

/// A picture of values. Colours go from dark blue over green to yellow, ascending in brightness (viridis); values that are not
/// finite stay white.
struct HeatMap {
  std::string title;
  std::string note;                                           ///< small, under the title
  std::string x_label, y_label;                               ///< with units
  std::pair<double, double> x_range, y_range;                 ///< of the whole picture, ascending [units of the labels]
  std::size_t columns = 0;                                    ///< number of cells along x
  std::vector<double> values;                                 ///< row by row, x fastest, from the lowest y
  std::string value_label;                                    ///< with unit
  std::optional<std::pair<double, double>> value_range = {};  ///< ends of the scale; from the values when absent
};

/// Writes `stem`.svg and `stem`.png, each as a whole or not at all; lengths along x and y have the same scale. @throws
/// std::logic_error for values that do not fill the rows, Error (io) naming the file and the reason.
void write_heat_map(const HeatMap& map, const std::filesystem::path& stem);

}  // namespace scree::plot
