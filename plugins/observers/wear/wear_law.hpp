// Laws of wear: volumes that sliding and impacts take off a surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scree/config/options.hpp"

namespace scree {

class SceneServices;

/// What one material does to another.
struct WearPair {
  double wear_coefficient = 0.0;  ///< Archard's k [1]
  double hardness = 1.0;          ///< of what is worn, H [Pa]
  double flow_stress = 1.0;       ///< of what is worn, Finnie's p [Pa]
  double force_ratio = 2.0;       ///< normal to tangential force of a cutting grain, Finnie's K [1]
  double cut_ratio = 2.0;         ///< length to depth of a cut, Finnie's psi [1]
};

/// Sliding: V = k F_n s / H [m3] (Archard 1953, "Contact and rubbing of flat surfaces").
/// @param force_way sum of normal force times way of sliding [N m]
[[nodiscard]] double archard_volume(const WearPair& pair, double force_way);

/// One impact, ductile cutting [m3] (Finnie 1960, "Erosion of surfaces by solid particles", eq. 5 and 6):
///
///     V = m U^2 / (p psi K) (sin 2 alpha - 6/K sin^2 alpha)   for tan alpha <= K / 6
///     V = m U^2 / (p psi K)  K/6 cos^2 alpha                  for tan alpha >= K / 6
///
/// @param mass m [kg] @param normal_speed U sin(alpha) [m/s] @param tangential_speed U cos(alpha) [m/s]
[[nodiscard]] double finnie_volume(const WearPair& pair, double mass, double normal_speed, double tangential_speed);

/// The laws of every pair of materials: what the observer says for all, and its `pair` tables.
class WearTable {
 public:
  /// The parameters that a scene writes: those of WearPair, and `pair`.
  static std::vector<Parameter> parameters();
  /// @throws Error (usage) for unknown materials and pairs listed twice.
  void setup(const Options& options, SceneServices& services);

  /// What `by` does to `worn`, indices of materials.
  [[nodiscard]] const WearPair& pair(std::uint32_t worn, std::uint32_t by) const {
    return pairs_[worn * materials_ + by];
  }

 private:
  std::size_t materials_ = 0;
  std::vector<WearPair> pairs_;
};

}  // namespace scree
