// Tables of scanned particles: prisms from measured outlines, with measured mass and inertia.
//
// One particle a line, numbers apart by blanks, tabs, commas or semicolons; `#` and `%` begin comments, and a first line
// without a single number counts as a heading. The columns are
//
//   material id, particle id, thickness [mm], mass [mg], I1 I2 I3 [mg mm2], N, N x-coordinates [mm], N y-coordinates [mm]
//
// I1, I2 and I3 are the principal moments about the file's x axis, its y axis and the normal, through the centre of mass.
// The outline is convex and runs either way round. Rows are filled up with NaN: behind all coordinates, or behind x and
// behind y, and N counts the corners with or without that filling. The prism is the outline between +-thickness / 2; its
// centre is taken for the centre of mass, and the file's axes for the principal ones.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "scree/math/vec3.hpp"

namespace scree {

/// A scanned particle, in SI.
struct ScannedParticle {
  int line = 0;  ///< of the file, from 1
  long long material = 0;
  long long id = 0;
  double thickness = 0.0;  ///< [m]
  double mass = 0.0;       ///< [kg]
  Vec3 inertia;            ///< about file x, file y and the normal [kg m2]
  std::vector<Vec3>
      outline;        ///< corners of its convex hull, counter-clockwise, about the centre of the prism; z = 0 [m]
  double area = 0.0;  ///< of the outline [m2]

  [[nodiscard]] double volume() const { return area * thickness; }  // [m3]
  /// Corners of the prism, lower and upper in turn [m].
  [[nodiscard]] std::vector<Vec3> corners() const;
};

/// A row that is of no use.
struct RefusedRow {
  int line = 0;        ///< of the file, from 1
  std::string reason;  ///< what is wrong with it, as part of a sentence
};

/// What a table holds.
struct ScanTable {
  std::vector<ScannedParticle> particles;
  std::vector<RefusedRow> refused;
};

/// Reads a table; never throws for its contents. A row is refused when
///   - a word is no number, or columns are missing or left over;
///   - thickness, mass or a moment is not positive and finite, or N no whole number from 3 on;
///   - NaN stands among the coordinates, or in x and not in y;
///   - the outline has no area, or its area is more than 1 % below that of its convex hull (not convex, or crossing itself);
///   - a moment is larger than the sum of the other two, or than a body of that mass within the prism can have (both by
///     more than 5 %, for errors of measurement): a wrong unit, most likely;
///   - an earlier row has the same material and particle id.
[[nodiscard]] ScanTable read_scan_table(std::istream& in);

/// Reads a file. @throws Error (io) when it cannot be read, (usage) when it holds no row at all.
[[nodiscard]] ScanTable read_scan_file(const std::filesystem::path& file);

}  // namespace scree
