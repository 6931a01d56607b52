// ReportTable: what a part reports at the end of a run.
#pragma once

#include <string>
#include <vector>

namespace scree {

/// Quantities that a part reports at the end, for the terminal and run.json.
struct ReportTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

}  // namespace scree
