// ImageData: arrays over the cells of a regular grid, written as a VTK XML file (.vti).
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "scree/math/vec3.hpp"
#include "vtp/poly_data.hpp"

namespace scree {

/// Contents of a file. Cells go x fastest, then y, then z.
struct ImageData {
  double time = 0.0;                   ///< [s]
  Vec3 origin;                         ///< lower corner of the first cell [m]
  Vec3 spacing;                        ///< edges of a cell [m]
  std::array<std::size_t, 3> cells{};  ///< along x, y and z
  std::vector<DataArray> cell_data;    ///< one entry per cell
};

/// Writes the file as a whole or not at all. @throws Error (io).
void write_vti(const ImageData& data, const std::filesystem::path& file);

}  // namespace scree
