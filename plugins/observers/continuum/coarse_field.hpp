// CoarseField: continuum fields of grains on a grid, averaged over looks.
//
// Goldhirsch, I. (2010), Stress, stress asymmetry and couple stress: from discrete particles to continuous fields, Granular
// Matter 12, 239-252. With phi the kernel about the cell (normalised over the grid, per volume), < > the mean over looks:
//
//     solid fraction   <sum_i V_i phi_i>                  V_i: of the sphere of the body's volume
//     density     rho = <sum_i m_i phi_i>
//     velocity    u   = <sum_i m_i v_i phi_i> / rho
//     kinetic stress  s_k = <sum_i m_i v_i' v_i' phi_i>    v_i' = v_i - u, or with the gradient removed: v_i - u(x_i)
//     temperature T   = tr(s_k) / (3 rho)                  (1/3 <|v'|^2>)
//     contact stress  s_c = -<sum_contacts sum_{i in pair} f_i b_i int_0^1 phi(x_i + s b_i) ds>
//
// f_i is the force of the contact on body i (impulse of the step over the step) and b_i the branch from its centre to the
// contact point, so that contacts with walls count too (Weinhart, Thornton, Luding and Bokhove 2012, Granular Matter 14, 289).
// Stresses are positive in compression. Gauss's rule with three points takes the integral.
//
// The gradient of the mean velocity within the kernel looks like temperature, w^2 shear^2 for a shear flow. Removing it means
// the least-squares plane u(x) = u + L (x - mean x) through the velocities under the kernel: with the second moments
// C_vv, C_vx, C_xx of velocity and place, L = C_vx C_xx^-1 and s_k = rho (C_vv - L C_vx^T). Where all grains lie in one plane
// or line, C_xx is inverted in the directions that have extent.
#pragma once

#include <span>
#include <vector>

#include "kernel.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/math/mat3.hpp"

namespace scree {

class Executor;
class StateReader;
class StateWriter;

/// A grain, or a point of a branch, that is spread over the cells around it.
struct Grain {
  Vec3 place;           ///< [m]
  Vec3 velocity;        ///< [m/s]
  double mass = 0.0;    ///< [kg]
  double volume = 0.0;  ///< [m3]
};
struct BranchPoint {
  Vec3 place;   ///< [m]
  Mat3 moment;  ///< - force x branch, times the weight of the point [N m]
};

/// Fields of one cell; velocity, temperature and kinetic stress are NaN where there is nothing.
struct CoarseCell {
  double solid_fraction = 0.0;  ///< [1]
  double density = 0.0;         ///< [kg/m3]
  Vec3 velocity;                ///< [m/s]
  double temperature = 0.0;     ///< [m2/s2]
  Mat3 kinetic_stress;          ///< [Pa]
  Mat3 contact_stress;          ///< [Pa]
  double samples = 0.0;         ///< effective number of grains, summed over looks: (sum phi)^2 / sum phi^2 [1]
};

/// Sums of moments, which add up to the same bits for any number of threads.
class CoarseField {
 public:
  CoarseField(const CellGrid& grid, const Kernel& kernel);

  /// Adds a look. Workspace is kept.
  void add(std::span<const Grain> grains, std::span<const BranchPoint> branches, const Executor& executor);
  void clear();
  [[nodiscard]] double looks() const { return looks_; }
  [[nodiscard]] std::size_t size() const { return sums_.size() / kSums; }
  /// The fields of a cell. Temperature and kinetic stress are NaN below `least` effective grains.
  [[nodiscard]] CoarseCell cell(std::size_t index, bool remove_gradient, double least) const;

  void save(StateWriter& out) const;
  /// @throws Error (io) when the saved field has another size.
  void load(const StateReader& in);

 private:
  // Sums of a cell, in this order: weights, their squares, volume, mass, momentum 3, mass x place 3, mass x velocity velocity 6,
  // mass x place place 6, mass x velocity place 9, contact stress 9.
  static constexpr std::size_t kSums = 40;

  void spread_layers(std::span<const Grain> grains, std::span<const BranchPoint> branches, long first, long last);
  void spread(const Grain& grain, double normalisation, long first, long last);
  void spread(const BranchPoint& point, double normalisation, long first, long last);

  Lattice lattice_;
  Kernel kernel_;
  double cell_volume_;  // [m3]
  double looks_ = 0.0;
  std::vector<double> sums_;
  std::vector<double> grain_norm_, branch_norm_;  // workspace
};

/// The points and moments of the contacts of the step that ended, appended to `out`.
void append_branches(const Observation& now, std::vector<BranchPoint>& out);

}  // namespace scree
