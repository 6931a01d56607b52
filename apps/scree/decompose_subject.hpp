// What `scree decompose` takes apart: a solid from a mesh file or from a shape of a scene.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/sphere_decomposition.hpp"

namespace scree {

/// A solid, in the frame in which it was written.
struct DecomposeSubject {
  std::string name;      ///< for the new shape
  std::string what;      ///< one line on where it comes from
  TriangleMesh surface;  ///< for pictures [m]
  MassProperties mass;
  std::function<SphereDecomposition(const SphereDecompositionOptions&)> decompose;
};

/// The arguments that say what it is.
struct SubjectChoice {
  std::filesystem::path file;  ///< a mesh file, or a scene
  std::string shape;           ///< of the scene; empty for the only one
  double scale = 1.0;          ///< factor on the coordinates of a mesh file [m per unit of the file]
  bool hull = false;           ///< the convex hull of the corners
};

/// @throws Error (usage, io) when there is no such solid, with what is wrong with the mesh.
[[nodiscard]] DecomposeSubject find_subject(const SubjectChoice& choice);

}  // namespace scree
