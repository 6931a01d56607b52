// PolyData: points, vertices or triangles, and named arrays, written as a VTK XML file (.vtp).
// Readers: VTK, ParaView, PyVista, meshio.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scree/math/quat.hpp"

namespace scree {

/// How floating-point arrays are stored.
enum class Precision { single_precision, double_precision };

/// One array of a file, as the bytes that go into it.
struct DataArray {
  std::string name;
  std::string type;  ///< VTK's: "Float64", "Int32", ...
  int components = 1;
  std::vector<std::byte> bytes;
};

[[nodiscard]] DataArray to_array(std::string name, std::span<const double> values, Precision precision);
[[nodiscard]] DataArray to_array(std::string name, std::span<const Vec3> values, Precision precision);
/// Four components, w first.
[[nodiscard]] DataArray to_array(std::string name, std::span<const Quat> values, Precision precision);
/// Nine components, row by row.
[[nodiscard]] DataArray to_array(std::string name, std::span<const Mat3> values, Precision precision);
[[nodiscard]] DataArray to_array(std::string name, std::span<const std::uint64_t> values);
[[nodiscard]] DataArray to_array(std::string name, std::span<const std::int32_t> values);

/// Words that go with a file: names of materials, for example, indexed by an integer array.
struct TextArray {
  std::string name;
  std::vector<std::string> texts;
};

/// Contents of a file: triangles, lines, or else, when `vertices` is set, a vertex cell for every point.
struct PolyData {
  double time = 0.0;  ///< [s]
  std::size_t point_count = 0;
  DataArray points;  ///< three components [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> lines;  ///< segments; not together with triangles
  bool vertices = true;                             ///< without triangles and lines, points are cells
  std::vector<DataArray> point_data;                ///< one entry per point
  std::vector<DataArray> cell_data;                 ///< one entry per triangle or line
  std::vector<TextArray> texts;
};

/// Writes the file as a whole or not at all. @throws Error (io).
void write_vtp(const PolyData& data, const std::filesystem::path& file);

}  // namespace scree
