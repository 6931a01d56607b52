#include "scree/geometry/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>

#include "scree/base/error.hpp"
#include "scree/geometry/ply_file.hpp"

namespace scree {
namespace {

/// The ending of a file, in lower case.
std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

void check_ending(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  constexpr std::array known{".stl", ".obj", ".ply"};
  if (std::ranges::find(known, ending) == known.end()) {
    throw Error{ErrorKind::usage, "the mesh file '" + file.string() + "' ends in '" + ending +
                                      "'; scree reads .stl, .obj and .ply: convert it"};
  }
}

void check_readable(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) {
    throw Error{ErrorKind::io, "the mesh file '" + file.string() + "' does not exist; check the path"};
  }
  if (std::filesystem::file_size(file, code) == 0) {
    throw Error{ErrorKind::io, "the mesh file '" + file.string() + "' is empty; export it again"};
  }
}

void append(const aiMesh& part, double scale, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.push_back(scale * Vec3{v.x, v.y, v.z});
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // lines and points of an OBJ bound nothing
    mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

TriangleMesh read_by_assimp(const std::filesystem::path& file, double scale) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    throw Error{ErrorKind::io, "the mesh file '" + file.string() + "' could not be read as a mesh (" +
                                   importer.GetErrorString() + "); export it again as STL, OBJ or PLY"};
  }
  TriangleMesh soup;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], scale, soup);
  return soup;
}

/// By scree itself: Assimp 5.2 reads past the end of a damaged PLY file.
TriangleMesh read_ply_file(const std::filesystem::path& file, double scale) {
  std::ifstream in{file, std::ios::binary};
  return read_ply(in, file.string(), scale);
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& file, double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    throw Error{ErrorKind::usage, "the scale of the mesh file '" + file.string() + "' must be a positive number"};
  }
  check_ending(file);
  check_readable(file);

  const TriangleMesh soup = ending_of(file) == ".ply" ? read_ply_file(file, scale) : read_by_assimp(file, scale);
  if (soup.triangles.empty() || !std::ranges::all_of(soup.vertices, [](const Vec3& v) { return is_finite(v); })) {
    throw Error{ErrorKind::io, "the mesh file '" + file.string() +
                                   "' holds no triangles with finite corners; export a triangulated surface"};
  }
  const Aabb box = bounds_of(soup.vertices);
  return welded(soup, 1e-6 * norm(box.upper - box.lower));
}

}  // namespace scree
