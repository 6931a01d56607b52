// Bed files: many spheres as a plain text table.
//
//     1000 0.05                       <- number of spheres, side of the square box they lie in [m]
//     x y z r vx vy vz                <- a sphere a line: centre [m], radius [m], velocity [m/s]
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "scree/math/vec3.hpp"

namespace scree {

/// A sphere of a bed.
struct BedSphere {
  Vec3 centre;          ///< [m]
  double radius = 0.0;  ///< [m]
  Vec3 velocity;        ///< [m/s]
};

/// What a bed file holds.
struct Bed {
  double side = 0.0;  ///< of the box [m]
  std::vector<BedSphere> spheres;
};

/// Reads the first `limit` spheres of a bed file. Rows beyond the limit are not looked at; a file read to its end has to
/// hold as many rows as its first line says. Empty lines and what follows a '#' are passed over.
/// @throws Error (io) when the file cannot be read; (usage) with file and line for a row that is not seven finite numbers
/// with a positive radius, and for a wrong count.
[[nodiscard]] Bed read_bed(const std::filesystem::path& file,
                           std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace scree
