// Separation: how far two classes of particles have parted along an axis, and how their mixture varies along it.
//
// Centres of mass z_A, z_B of the two classes along the axis; D = z_A - z_B.
//
//     index      S = D / D_max     D_max: of the same bed (the same mass at the same places) with all mass of the first class
//                                  at the end of the axis to which D points. 1 and -1: parted as far as the bed allows,
//                                  the first class ahead or behind; 0: no net separation
//     intensity  I = s^2 / (P (1 - P))     variance of the first class's share of mass over the bins, by their mass, over
//                                  that of a parted bed (Danckwerts 1952, Appl. Sci. Res. A 3, 279); 0: the same everywhere
//     correlation of size and of density with the place: Pearson's, over particles
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/classes.hpp"

namespace scree {

/// A particle on the axis.
struct OnAxis {
  double place = 0.0;     ///< along the axis [m]
  double mass = 0.0;      ///< [kg]
  double diameter = 0.0;  ///< of the sphere of equal volume [m]
  double density = 0.0;   ///< [kg/m3]
  BodyClass of = BodyClass::neither;
  std::uint32_t material = 0;
};

/// Separation at one time; NaN where it is not defined (a class is empty, all particles lie in one place or are alike).
struct Separation {
  double first_centre = 0.0, second_centre = 0.0;  ///< [m]
  double difference = 0.0;                         ///< D [m]
  double index = 0.0;                              ///< S [1]
  double intensity = 0.0;                          ///< I [1]
  double size_correlation = 0.0;                   ///< [1]
  double density_correlation = 0.0;                ///< [1]
};

/// What lies in a bin of the profile.
struct ProfileBin {
  double number = 0.0;
  double mass = 0.0;          ///< [kg]
  double volume = 0.0;        ///< of the particles [m3]
  double diameters = 0.0;     ///< their sum [m]
  double classed_mass = 0.0;  ///< of particles of either class [kg]
  double first_mass = 0.0;    ///< of the first class [kg]
};

/// Keeps its workspace from look to look.
class AxisProfile {
 public:
  /// Bins of equal width between `from` < `to` [m].
  AxisProfile(double from, double to, std::size_t bins, std::size_t materials);

  [[nodiscard]] Separation look(std::span<const OnAxis> particles);
  [[nodiscard]] std::span<const ProfileBin> bins() const { return bins_; }
  /// Mass of a material in a bin [kg].
  [[nodiscard]] double material_mass(std::size_t bin, std::size_t material) const {
    return material_mass_[bin * materials_ + material];
  }
  [[nodiscard]] double edge(std::size_t index) const;  ///< [m]

 private:
  void fill(std::span<const OnAxis> particles);
  [[nodiscard]] double intensity() const;
  /// D_max: the first class holds `mass` [kg] and lies ahead of the second, or behind it. [m]
  [[nodiscard]] double parted(double mass, bool ahead) const;

  double from_, to_;  // [m]
  std::size_t materials_;
  std::vector<ProfileBin> bins_;
  std::vector<double> material_mass_;
  std::vector<OnAxis> sorted_;  // of either class, along the axis
};

}  // namespace scree
