// Scanned particles as templates of a family: one a row of a table.
#pragma once

#include <string>
#include <vector>

#include "particle_template.hpp"

namespace scree {

class SceneServices;

/// The settings of a family's `shape` of type "scan".
[[nodiscard]] Variant scan_shape();

/// Reads the table that `shape` names and makes a template of each row that the family uses: prism, hull, cluster. Rows are
/// fitted on all threads. What becomes of the rows stands in `rows` of the set; bad ones are logged with file, line and reason.
/// @throws Error (usage) at the setting when a row is bad and `bad_rows` is "refuse", or when no row is left; (io) when
/// the file cannot be read.
[[nodiscard]] TemplateSet make_scan_templates(const Options& shape, const std::string& family, SceneServices& services);

}  // namespace scree
