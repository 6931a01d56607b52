// PLY files (Turk, "The PLY polygon file format", 1994): text and binary, of either byte order.
#pragma once

#include <iosfwd>
#include <string>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Reads the elements `vertex` (properties x, y, z) and `face` (a list of vertex indices) and skips all else. A face of more than
/// three corners becomes triangles about its first corner.
/// @param name of the file, for messages
/// @param scale multiplies every coordinate [m per unit of the file]
/// @throws Error (io) for what is no such file, ends early, or names vertices that are not there.
[[nodiscard]] TriangleMesh read_ply(std::istream& in, const std::string& name, double scale);

}  // namespace scree
