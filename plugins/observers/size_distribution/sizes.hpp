// Sizes: the distribution of particle sizes at one time, by number and by mass.
//
// d is the diameter of the sphere of equal volume. Q0 and Q3 are the shares by number and by mass below a size; a particle
// stands in the middle of its own share, and between particles the curve is straight (ISO 9276-1 for the names):
//
//     d10, d50, d90   sizes at which Q3 (Q0 for d10_number ...) is 10, 50 and 90 %
//     d32             Sauter mean, sum d^3 / sum d^2                    (ISO 9276-2)
//     span            (d90 - d10) / d50
#pragma once

#include <span>
#include <vector>

#include "analysis/statistics.hpp"

namespace scree {

/// A particle that counts.
struct Sized {
  double diameter = 0.0;  ///< [m]
  double mass = 0.0;      ///< [kg]
};

/// Numbers of a distribution; NaN sizes [m] without particles.
struct SizeNumbers {
  double number = 0.0;
  double mass = 0.0;  ///< [kg]
  double d10 = 0.0, d50 = 0.0, d90 = 0.0;
  double d10_number = 0.0, d50_number = 0.0, d90_number = 0.0;
  double d32 = 0.0;
  double smallest = 0.0, largest = 0.0;
};

/// Keeps its workspace from look to look.
class Sizes {
 public:
  void assign(std::span<const Sized> particles);
  [[nodiscard]] SizeNumbers numbers() const;
  [[nodiscard]] const Cumulative& by_number() const { return by_number_; }
  [[nodiscard]] const Cumulative& by_mass() const { return by_mass_; }

 private:
  double number_ = 0.0, mass_ = 0.0, cubes_ = 0.0, squares_ = 0.0;
  Cumulative by_number_, by_mass_;
  std::vector<Weighted> workspace_;
};

/// `count` classes of size between `smallest` and `largest` [m], equal in d or in log d: count + 1 edges [m].
[[nodiscard]] std::vector<double> size_classes(double smallest, double largest, std::size_t count, bool logarithmic);

/// What lies in a class: in the lower edge, below the upper one; the largest edge belongs to the last class. What lies
/// outside of all classes goes to `below` and `above`.
struct SizeHistogram {
  struct Amount {
    double number = 0.0;
    double mass = 0.0;  ///< [kg]
  };
  std::vector<Amount> in_class;
  Amount below, above;
};
void fill_histogram(std::span<const Sized> particles, std::span<const double> edges, SizeHistogram& out);

}  // namespace scree
