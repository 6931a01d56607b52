// What mesh files go through, whatever their format: read, examined, and measured if they bound a solid.
#pragma once

#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "scree/base/error.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/mesh_examination.hpp"
#include "scree/geometry/mesh_file.hpp"

/// Assimp loses memory when it gives up on a file; that is not what is looked for here.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): what the leak sanitizer asks for
extern "C" inline const char* __lsan_default_suppressions() { return "leak:libassimp"; }

namespace scree::fuzz {

/// Gives the bytes to the reader as a file with this ending: it loads or throws an Error, and what loads has a report.
inline void read_as_mesh(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  try {
    const TriangleMesh mesh = read_mesh_file(file_of(data, size, ending));
    const MeshReport report = examine_mesh(mesh);
    if (report.bad_indices + report.bad_vertices > 0) std::abort();
    if (!check_mesh(without_degenerate(mesh)).problem().empty() || !report.is_solid()) return;
    const MassProperties mass = mesh_mass_properties(mesh);
    if (!(mass.volume > 0.0)) std::abort();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::io && error.kind() != ErrorKind::usage) throw;
  }
}

}  // namespace scree::fuzz
