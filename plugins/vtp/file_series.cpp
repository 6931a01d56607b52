#include "vtp/file_series.hpp"

#include <fmt/format.h>

#include <sstream>

#include "scree/results/output_file.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

std::string numbered_file(const std::string& series, std::uint64_t step) {
  return fmt::format("{}_{:08}.vtp", series, step);
}

void FileSeries::write(const std::filesystem::path& collection) const {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const Frame& frame : frames_) {
    text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", frame.time, frame.part,
                        frame.file);
  }
  replace_file(collection, std::string_view{text + "</Collection>\n</VTKFile>\n"});
}

void FileSeries::save(StateWriter& out, const std::string& name) const {
  std::string text;
  for (const Frame& frame : frames_) text += fmt::format("{} {} {}\n", frame.time, frame.part, frame.file);
  out.write(name, text);
}

void FileSeries::load(const StateReader& in, const std::string& name, const std::filesystem::path& results) {
  std::istringstream text{in.text(name)};
  Frame frame{};
  frames_.clear();
  while (text >> frame.time >> frame.part >> frame.file) {
    if (std::filesystem::exists(results / frame.file)) frames_.push_back(frame);
  }
}

}  // namespace scree
