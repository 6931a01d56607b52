// Splitting: how well splitters part what lies in the bins.
//
// For a target T in a product P (masses):
//     grade            G = m(T, P) / m(all, P)           how pure the product is
//     recovery         R = m(T, P) / m(T, all products)  how much of the target it holds
//     separation efficiency  E = R - m(others, P) / m(others, all products)      (Schulz 1970)
#pragma once

#include <cstddef>
#include <vector>

namespace scree {

/// What splitters are judged by.
enum class Objective { recovery_times_grade, separation_efficiency };

/// Masses [kg] that one product holds.
struct ProductMass {
  double target = 0.0;
  double all = 0.0;
};

/// The quality of a product with respect to a target; zero for an empty product.
[[nodiscard]] double grade(const ProductMass& product);
[[nodiscard]] double recovery(const ProductMass& product, const ProductMass& total);
[[nodiscard]] double value(Objective objective, const ProductMass& product, const ProductMass& total);

/// Masses of all targets by strip of the collector along u [kg]: `target[t][strip]`, and of everything.
struct StripMasses {
  std::vector<std::vector<double>> target;
  std::vector<double> all;
};

/// The best places for splitters.
struct BestSplit {
  std::vector<std::size_t> edges;  ///< strip edges of the splitters, ascending; edge e is in front of strip e
  double value = 0.0;              ///< mean of the objective over the products that have a target [1]
};

/// A product without a target.
inline constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);

/// Tries every combination of strip edges for `wanted.size() - 1` splitters; `wanted[p]` is the target of product p
/// along u, or kNoTarget. Products have at least one strip. The objective is a sum over products, so that the best
/// combination is found edge by edge (dynamic programming), at the cost products x strips^2.
[[nodiscard]] BestSplit best_split(const StripMasses& masses, const std::vector<std::size_t>& wanted,
                                   Objective objective);

}  // namespace scree
