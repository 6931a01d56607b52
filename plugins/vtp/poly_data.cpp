#include "vtp/poly_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "scree/results/output_file.hpp"
#include "vtp/vtk_xml.hpp"

namespace scree {

namespace {

DataArray floats(std::string name, std::span<const double> values, int components, Precision precision) {
  if (precision == Precision::double_precision) return {std::move(name), "Float64", components, bytes_of(values)};
  std::vector<float> narrow(values.size());
  std::transform(values.begin(), values.end(), narrow.begin(), [](double v) { return static_cast<float>(v); });
  return {std::move(name), "Float32", components, bytes_of(std::span<const float>{narrow})};
}

template <class Record>
std::span<const double> components_of(std::span<const Record> values) {
  static_assert(sizeof(Record) % sizeof(double) == 0);
  return {reinterpret_cast<const double*>(values.data()), values.size() * (sizeof(Record) / sizeof(double))};
}

// Cells as VTK wants them: the points of all cells in a row, and where each cell ends.
std::vector<DataArray> cells(std::size_t count, std::size_t points_each, std::span<const std::uint32_t> points) {
  std::vector<std::int64_t> connectivity(count * points_each);
  std::vector<std::int64_t> offsets(count);
  for (std::size_t i = 0; i < connectivity.size(); ++i) {
    connectivity[i] = points.empty() ? static_cast<std::int64_t>(i) : points[i];
  }
  for (std::size_t i = 0; i < count; ++i) offsets[i] = static_cast<std::int64_t>((i + 1) * points_each);
  return {{"connectivity", "Int64", 1, bytes_of(std::span<const std::int64_t>{connectivity})},
          {"offsets", "Int64", 1, bytes_of(std::span<const std::int64_t>{offsets})}};
}

}  // namespace

DataArray to_array(std::string name, std::span<const double> values, Precision precision) {
  return floats(std::move(name), values, 1, precision);
}
DataArray to_array(std::string name, std::span<const Vec3> values, Precision precision) {
  return floats(std::move(name), components_of(values), 3, precision);
}
DataArray to_array(std::string name, std::span<const Quat> values, Precision precision) {
  return floats(std::move(name), components_of(values), 4, precision);
}
DataArray to_array(std::string name, std::span<const Mat3> values, Precision precision) {
  return floats(std::move(name), components_of(values), 9, precision);
}
DataArray to_array(std::string name, std::span<const std::uint64_t> values) {
  return {std::move(name), "UInt64", 1, bytes_of(values)};
}
DataArray to_array(std::string name, std::span<const std::int32_t> values) {
  return {std::move(name), "Int32", 1, bytes_of(values)};
}

void write_vtp(const PolyData& data, const std::filesystem::path& file) {
  const bool surface = !data.triangles.empty(), net = !data.lines.empty();
  const std::size_t vertices = surface || net || !data.vertices ? 0 : data.point_count;
  VtkXml out{"PolyData"};
  out.field_data(data.time, data.texts);
  out.text(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"{}\">\n",
                  data.point_count, vertices, data.lines.size(), data.triangles.size()));
  out.arrays("PointData", data.point_data);
  out.arrays("CellData", data.cell_data);
  out.arrays("Points", {data.points});
  if (surface) {
    const std::span<const std::uint32_t> corners{data.triangles.front().data(), 3 * data.triangles.size()};
    out.arrays("Polys", cells(data.triangles.size(), 3, corners));
  } else if (net) {
    const std::span<const std::uint32_t> ends{data.lines.front().data(), 2 * data.lines.size()};
    out.arrays("Lines", cells(data.lines.size(), 2, ends));
  } else {
    out.arrays("Verts", cells(vertices, 1, {}));
  }
  out.text("</Piece>\n");
  replace_file(file, std::string_view{out.finish()});
}

}  // namespace scree
