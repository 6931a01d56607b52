// What is made of the cells of a CoarseField: arrays of a file, means over layers, values for a slice.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coarse_field.hpp"
#include "vtp/poly_data.hpp"

namespace scree {

/// The place of a cell along x, y and z.
[[nodiscard]] std::array<std::size_t, 3> cell_places(const CellGrid& grid, std::size_t cell);

/// All fields as arrays of a VTK file: solid_fraction [1], density [kg/m3], velocity [m/s], granular_temperature [m2/s2],
/// kinetic_stress and contact_stress [Pa], samples [1].
[[nodiscard]] std::vector<DataArray> field_arrays(const std::vector<CoarseCell>& cells, bool contact_stress);

/// A field that a slice can show.
struct SliceField {
  std::string name, title, label, unit;
  double (*value)(const CoarseCell&);  ///< [unit]
};
[[nodiscard]] std::vector<std::string> slice_field_names();
/// @throws std::logic_error for an unknown name.
[[nodiscard]] const SliceField& slice_field(const std::string& name);

/// Means over the cells of a layer: by volume, but velocity and temperature by mass.
class LayerMean {
 public:
  void add(const CoarseCell& cell);
  [[nodiscard]] double solid_fraction() const { return solid_fraction_ / cells_; }  ///< [1]
  [[nodiscard]] double density() const { return density_ / cells_; }                ///< [kg/m3]
  [[nodiscard]] Vec3 velocity() const;                                              ///< [m/s]; NaN in an empty layer
  [[nodiscard]] double temperature() const;  ///< [m2/s2]; NaN where none is known
  [[nodiscard]] double kinetic_pressure() const { return kinetic_ / 3.0 / cells_; }  ///< tr(s_k) / 3 [Pa]
  [[nodiscard]] Mat3 contact_stress() const;                                         ///< [Pa]

 private:
  double cells_ = 0.0, solid_fraction_ = 0.0, density_ = 0.0, kinetic_ = 0.0;
  double warm_density_ = 0.0, temperature_ = 0.0;  // of cells whose temperature is known
  Vec3 momentum_;
  Mat3 contact_stress_;
};

}  // namespace scree
