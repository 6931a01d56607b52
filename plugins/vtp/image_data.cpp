#include "vtp/image_data.hpp"

#include <fmt/format.h>

#include <string_view>

#include "scree/results/output_file.hpp"
#include "vtp/vtk_xml.hpp"

namespace scree {

void write_vti(const ImageData& data, const std::filesystem::path& file) {
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", data.cells[0], data.cells[1], data.cells[2]);
  VtkXml out{"ImageData",
             fmt::format("WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\"", extent, data.origin.x,
                         data.origin.y, data.origin.z, data.spacing.x, data.spacing.y, data.spacing.z)};
  out.field_data(data.time);
  out.text(fmt::format("<Piece Extent=\"{}\">\n", extent));
  out.arrays("CellData", data.cell_data);
  out.text("</Piece>\n");
  replace_file(file, std::string_view{out.finish()});
}

}  // namespace scree
