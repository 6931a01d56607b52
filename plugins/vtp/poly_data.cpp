#include "vtp/poly_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "scree/base/error.hpp"
#include "scree/results/output_file.hpp"

namespace scree {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kBlockSize = 1 << 20;  // [byte]
constexpr int kCompressionLevel = 1;         // noise in the last bits gains little from more, and time is output's cost

template <class Value>
std::vector<std::byte> bytes_of(std::span<const Value> values) {
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

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

void append_number(std::string& out, std::uint64_t number) {
  std::array<char, sizeof number> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  out.append(bytes.data(), bytes.size());
}

// Appends one array in VTK's compressed form.
void append_compressed(std::string& out, std::span<const std::byte> bytes) {
  const std::size_t blocks = (bytes.size() + kBlockSize - 1) / kBlockSize;
  std::string compressed;
  std::string sizes;
  std::vector<Bytef> block(compressBound(kBlockSize));
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto part = bytes.subspan(b * kBlockSize, std::min(kBlockSize, bytes.size() - b * kBlockSize));
    uLongf size = block.size();
    if (compress2(block.data(), &size, reinterpret_cast<const Bytef*>(part.data()), part.size(), kCompressionLevel) !=
        Z_OK) {
      throw Error{ErrorKind::io, "zlib could not compress an array; is there enough memory?"};
    }
    append_number(sizes, size);
    compressed.append(reinterpret_cast<const char*>(block.data()), size);
  }
  append_number(out, blocks);
  append_number(out, kBlockSize);
  append_number(out, bytes.size() % kBlockSize);
  out += sizes + compressed;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// The XML head grows while the arrays behind it do, because it names their offsets.
class Composer {
 public:
  void text(std::string_view piece) { head_ += piece; }
  void array(const DataArray& array) {
    head_ += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                         array.type, escaped(array.name), array.components, appended_.size());
    head_ += '\n';
    append_compressed(appended_, array.bytes);
  }
  void arrays(std::string_view element, const std::vector<DataArray>& list) {
    head_ += fmt::format("<{}>\n", element);
    for (const DataArray& item : list) array(item);
    head_ += fmt::format("</{}>\n", element);
  }
  [[nodiscard]] std::string finish() const {
    return head_ + "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string head_;
  std::string appended_;
};

// Texts are written as codes of their bytes, each text ended by a zero.
void add_field_data(Composer& out, const PolyData& data) {
  out.text("<FieldData>\n");
  out.text(fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
      data.time));
  for (const TextArray& array : data.texts) {
    std::string codes;
    for (const std::string& text : array.texts) {
      for (const char c : text) codes += fmt::format("{} ", static_cast<unsigned char>(c));
      codes += "0 ";
    }
    out.text(fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</Array>\n",
                         escaped(array.name), array.texts.size(), codes));
  }
  out.text("</FieldData>\n");
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
DataArray to_array(std::string name, std::span<const std::uint64_t> values) {
  return {std::move(name), "UInt64", 1, bytes_of(values)};
}
DataArray to_array(std::string name, std::span<const std::int32_t> values) {
  return {std::move(name), "Int32", 1, bytes_of(values)};
}

void write_vtp(const PolyData& data, const std::filesystem::path& file) {
  const bool surface = !data.triangles.empty(), net = !data.lines.empty();
  const std::size_t vertices = surface || net || !data.vertices ? 0 : data.point_count;
  Composer out;
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n");
  add_field_data(out, data);
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
  out.text("</Piece>\n</PolyData>\n");
  replace_file(file, std::string_view{out.finish()});
}

}  // namespace scree
