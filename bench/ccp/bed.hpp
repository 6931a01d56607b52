// A bed of spheres in a box, and the cone complementarity problem of one step of it, as dvi makes it.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "contact_assembly.hpp"
#include "scree/model/attributes.hpp"
#include "scree/model/body.hpp"

namespace scree::bench {

/// Spheres of density 1000 kg/m3, friction 0.5, in a box of five planes: |x|, |y| < side / 2, z > 0.
struct Bed {
  double side = 0.0;           ///< of the box [m]
  std::vector<Vec3> position;  ///< [m]
  std::vector<double> radius;  ///< [m]
  std::vector<Vec3> velocity;  ///< [m/s]
};

/// Reads "N side", then N lines "x y z r vx vy vz". @throws std::runtime_error when that fails.
Bed read_bed(const std::filesystem::path& file);
/// About `count` spheres on a cubic grid, each touching its neighbours with a little overlap or gap.
Bed synthetic_bed(std::size_t count);

/// The problem of one step of 1 ms under gravity; contacts closer than 2 % of a radius.
class BedProblem {
 public:
  explicit BedProblem(const Bed& bed);
  static constexpr std::size_t kWalls = 5;  ///< the first bodies; the spheres follow

  [[nodiscard]] CcpProblem problem() const { return assembly_.problem(); }
  /// Walls and spheres by number in the problem.
  [[nodiscard]] std::span<const BodyIndex> bodies() const { return assembly_.bodies(); }
  /// The problem's contacts in the order in which they were found: by body, and by the other body.
  [[nodiscard]] std::vector<std::uint32_t> found() const;

 private:
  dvi::ContactAssembly assembly_;
};

}  // namespace scree::bench
