// AndersonMixing: fewer steps to the fixed point of a map (Anderson 1965; Walker & Ni 2011, algorithm AA).
//
// Glossary: s, the point; f = G(s) - s, how far the map G moves it; dS, dF, differences to the points before. In place of s
// + f the next point is s + f - (dS + dF) c, with the c for which ||f - dF c|| is least: the secant method in many dimensions.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace scree {

/// The mixing; keeps its memory between uses.
class AndersonMixing {
 public:
  /// Points before the last one that are made use of.
  static constexpr std::size_t kDepth = 5;

  /// Forgets all points; the next ones have `size` numbers.
  void restart(std::size_t size);
  /// The next point in place of `s`, for `f` = G(s) - s, moved by `damping` (0 .. 1] times what the map asks for.
  void advance(std::span<double> s, std::span<const double> f, double damping);

 private:
  struct Difference {
    std::vector<double> s, f;
    std::vector<double> direction;  ///< of f, perpendicular to those of newer differences [1]
  };
  [[nodiscard]] Difference& newest(std::size_t age) { return differences_[(next_ + kDepth - 1 - age) % kDepth]; }
  std::size_t orthogonalise();

  std::array<Difference, kDepth> differences_;
  std::size_t next_ = 0, count_ = 0;  ///< where the next difference goes; how many there are
  bool begun_ = false;                ///< the point before is known
  std::vector<double> last_s_, last_f_;
  std::array<std::array<double, kDepth>, kDepth> triangle_{};  ///< dF = directions times this, newest first
};

}  // namespace scree
