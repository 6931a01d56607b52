// Lacey: how well two classes of particles are mixed, judged by samples.
//
// Lacey, P.M.C. (1954), Developments in the theory of particle mixing, J. Appl. Chem. 4, 257-268:
//
//     M = (s0^2 - s^2) / (s0^2 - sr^2)                     0 segregated, 1 random, above 1 ordered
//
// with the samples of c = 1..m cells, of which N_c particles and the share a_c of the first class lie in cell c:
//
//     s^2  = sum_c w_c (a_c - P)^2,   w_c = N_c / N        the variance, each sample with its weight
//     s0^2 = P (1 - P)                                     of the segregated state; P is the share of all samples
//     sr^2 = S (m - 1) / (N - 1)                           of a random mixture of these very particles, drawn without
//                                                          replacement: P (1 - P) / n for many cells of n particles
//     S    = sum_i (m_i / m_mean)^2 (x_i - P)^2 / N        x_i = 1 in the first class, else 0; S = P (1 - P) by number
//
// By mass, a_c and P are shares of mass and w_c = M_c / M; S then holds the spread of particle masses (Poole, Taylor and
// Wall 1964, Trans. Inst. Chem. Eng. 42, T305), to first order in 1 / N_c.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/classes.hpp"
#include "analysis/region.hpp"

namespace scree {

/// Lacey's index at one time. NaN where there are fewer than two cells or classes.
struct LaceyIndex {
  double value = 0.0;     ///< M [1]
  double width = 0.0;     ///< standard deviation of M of a random mixture, sr^2 sqrt(2 / (m - 1)) / (s0^2 - sr^2) [1]
  double variance = 0.0;  ///< s^2 [1]
  double variance_segregated = 0.0;  ///< s0^2 [1]
  double variance_random = 0.0;      ///< sr^2 [1]
  double share = 0.0;                ///< P [1]
  std::uint64_t cells = 0;           ///< m: those with enough particles
  std::uint64_t particles = 0;       ///< N: those in these cells
};

/// Counts particles into cells. Keeps its workspace from look to look.
class Lacey {
 public:
  /// Cells with fewer than `least` >= 1 particles are left out.
  Lacey(std::size_t cells, std::uint64_t least, bool by_mass);

  /// `cell` -1: outside; `mass` [kg].
  struct Particle {
    std::int64_t cell = -1;
    BodyClass of = BodyClass::neither;
    double mass = 0.0;
  };
  [[nodiscard]] LaceyIndex index(std::span<const Particle> particles);

 private:
  struct Cell {
    std::uint64_t number = 0;
    double amount = 0.0;  // particles, or their mass [kg]
    double first = 0.0;   // of it of the first class
  };
  [[nodiscard]] double amount(const Particle& particle) const { return by_mass_ ? particle.mass : 1.0; }

  std::uint64_t least_;
  bool by_mass_;
  std::vector<Cell> cells_;
};

}  // namespace scree
