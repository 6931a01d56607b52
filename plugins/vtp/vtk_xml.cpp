#include "vtp/vtk_xml.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "scree/base/error.hpp"

namespace scree {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kBlockSize = 1 << 20;  // [byte]
constexpr int kCompressionLevel = 1;         // noise in the last bits gains little from more, and time is output's cost

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

}  // namespace

VtkXml::VtkXml(std::string_view type, std::string_view attributes) : type_{type} {
  head_ = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{0}{1}{2}>\n",
      type, attributes.empty() ? "" : " ", attributes);
}

void VtkXml::array(const DataArray& array) {
  head_ += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                       array.type, escaped(array.name), array.components, appended_.size());
  head_ += '\n';
  append_compressed(appended_, array.bytes);
}

void VtkXml::arrays(std::string_view element, const std::vector<DataArray>& list) {
  head_ += fmt::format("<{}>\n", element);
  for (const DataArray& item : list) array(item);
  head_ += fmt::format("</{}>\n", element);
}

// Texts are written as codes of their bytes, each text ended by a zero.
void VtkXml::field_data(double time, const std::vector<TextArray>& texts) {
  text("<FieldData>\n");
  text(fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n", time));
  for (const TextArray& array : texts) {
    std::string codes;
    for (const std::string& words : array.texts) {
      for (const char c : words) codes += fmt::format("{} ", static_cast<unsigned char>(c));
      codes += "0 ";
    }
    text(fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</Array>\n",
                     escaped(array.name), array.texts.size(), codes));
  }
  text("</FieldData>\n");
}

std::string VtkXml::finish() {
  return head_ + fmt::format("</{}>\n", type_) + "<AppendedData encoding=\"raw\">\n_" + appended_ +
         "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace scree
