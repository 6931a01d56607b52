// SphereFit: places balls in a solid. The work of sphere_decomposition.hpp, which is the interface to use.
//
// Glossary, all lengths in units of the solid's size
//   phi(x)   signed distance of the solid, negative inside
//   c_i      centres; delta: how far balls may stick out, the same for all of them
//   r_i      = -phi(c_i) + delta. As phi changes by at most the way walked, no point of a ball lies further than delta
//            outside the solid: one side of the Hausdorff distance is bounded by construction.
//   d_j      distance of sample j, on the surface or inside, to the union; zero when a ball covers it. Samples deep
//            inside must be covered by a margin m, which is added to their distance
//   e_j      depth of sample j below the surface: how deep a hole is that leaves it uncovered
//   E        = sum over samples of w_j (d_j^4 + e_j^3 d_j): high powers make the largest gaps count most, as Hausdorff's
//            distance does
//
// Method: the greedy choice among grid points of the ball that lowers E most; then centres move (a pattern search) and
// idle balls jump to where they help most; delta is set in between so that the union has the solid's volume. A smaller E
// at the same delta means a larger union, hence a smaller delta: both errors fall together.
#pragma once

#include <cstddef>
#include <vector>

#include "scree/geometry/solid.hpp"
#include "scree/geometry/sphere.hpp"

namespace scree {

/// Fits at most a number of balls to a solid of size one.
class SphereFit {
 public:
  /// @param solid of size about 1, near the origin; must outlive the fit.
  SphereFit(const Solid& solid, int most_spheres);

  /// Chooses the balls anew, for balls that stick out by `delta`.
  void choose_greedily(double delta);
  /// Moves centres to lower E, `sweeps` times through all balls.
  void move_centres(int sweeps, double first_step);
  /// Lets the least useful ball jump to the best free place while that lowers E, at most `most` times.
  void relocate(int most);
  /// Sets delta so that the volume of the union is the solid's, to about `accuracy` [1].
  void match_volume(double accuracy);

  [[nodiscard]] double delta() const { return delta_; }
  /// The largest of delta and all gaps: about the Hausdorff distance.
  [[nodiscard]] double worst() const;
  [[nodiscard]] std::vector<Sphere> spheres() const;

 private:
  struct Ball {
    Vec3 centre;
    double depth;  ///< -phi(centre)
  };
  void make_samples(const Solid& solid);
  void make_candidates(const std::vector<SurfaceSample>& surface);
  void add_candidates_below(const std::vector<SurfaceSample>& surface);
  [[nodiscard]] double radius(const Ball& ball) const;
  /// E of the samples when their gaps are the least of `others` and the gap to `ball`.
  [[nodiscard]] double loss_with(const Ball& ball, const std::vector<double>& others) const;
  [[nodiscard]] double loss_of(const std::vector<double>& gaps) const;
  /// Gaps of all samples to one ball, unclamped.
  void gaps_to(const Ball& ball, std::vector<double>& gaps) const;
  /// The gaps left by all balls but number `skipped`.
  void gaps_without(std::size_t skipped, std::vector<double>& gaps) const;
  /// The candidate that lowers E most. What a candidate gains only falls as balls are added, so its last gain, kept in
  /// `bounds`, tells whether it is worth a look (lazy greedy choice; infinite: not looked at yet).
  [[nodiscard]] Ball best_candidate(const std::vector<double>& gaps, std::vector<double>& bounds) const;
  [[nodiscard]] double volume_at(double delta) const;

  const Solid& solid_;
  std::size_t most_;
  double delta_ = 0.0;
  std::vector<double> x_, y_, z_, weight_, depth_cubed_, margin_;  // samples, padded to a multiple of the lanes
  std::vector<Ball> candidates_;
  std::vector<Ball> balls_;
  std::vector<std::vector<double>> gaps_;  // of each ball to each sample
};

}  // namespace scree
