// Reading triangle meshes from files, by Assimp.
#pragma once

#include <filesystem>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Reads an STL (text or binary), OBJ or PLY file as one mesh. Polygons are cut into triangles, and corners that lie
/// together (within 1e-6 of the extent: files hold single precision) become one vertex. Whether the result bounds a
/// solid is for check_mesh() to say.
/// @param file path of the file; the ending tells the format
/// @param scale multiplies every coordinate; 1e-3 for files in millimetres [m per unit of the file]
/// @throws Error (io) when the file is missing, empty, no such mesh or holds no triangle; (usage) for another ending or
/// a scale that is not positive. The sentence names the file.
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& file, double scale = 1.0);

}  // namespace scree
