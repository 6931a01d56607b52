// VtkXml: how all kinds of VTK XML files are put together, arrays in an appended raw block.
//
// Each array is divided into blocks and compressed with zlib, as "VTK File Formats" describes it: [number of blocks, size, size of
// the last if smaller, compressed sizes...] as UInt64, then the blocks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vtp/poly_data.hpp"

namespace scree {

/// The bytes of values as they lie in memory.
template <class Value>
std::vector<std::byte> bytes_of(std::span<const Value> values) {
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

/// One file in the making: the XML head grows while the arrays behind it do, because it names their offsets.
class VtkXml {
 public:
  /// `type`: "PolyData", "ImageData", ...; `attributes` of its element, such as an extent.
  explicit VtkXml(std::string_view type, std::string_view attributes = {});

  void text(std::string_view piece) { head_ += piece; }
  /// An element of arrays: "PointData", "CellData", "Points", ...
  void arrays(std::string_view element, const std::vector<DataArray>& list);
  /// The time [s] and the words that go with the file.
  void field_data(double time, const std::vector<TextArray>& texts = {});
  /// Ends the file and gives its bytes.
  [[nodiscard]] std::string finish();

 private:
  void array(const DataArray& array);
  std::string type_;
  std::string head_;
  std::string appended_;
};

}  // namespace scree
