// WearAccount: what sliding and impacts have done to one body, on each of its faces and in all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

class StateReader;
class StateWriter;

/// What one contact does to a body in a step, or contacts have done.
struct WearAmount {
  double sliding_volume = 0.0;  ///< [m3]
  double impact_volume = 0.0;   ///< [m3]
  double sliding_energy = 0.0;  ///< taken by friction [J]
  double impact_energy = 0.0;   ///< kinetic energy along the normal, of impacts [J]

  WearAmount& operator+=(const WearAmount& o) {
    sliding_volume += o.sliding_volume;
    impact_volume += o.impact_volume;
    sliding_energy += o.sliding_energy;
    impact_energy += o.impact_energy;
    return *this;
  }
  [[nodiscard]] double volume() const { return sliding_volume + impact_volume; }
};

class WearAccount {
 public:
  explicit WearAccount(std::size_t faces = 0) : faces_(faces), reference_(faces) {}

  /// `impacts`: how many of them are in it.
  void add(std::size_t face, const WearAmount& amount, double impacts);
  [[nodiscard]] const std::vector<WearAmount>& faces() const { return faces_; }
  /// Summed contact by contact: what the faces must add up to.
  [[nodiscard]] const WearAmount& total() const { return total_; }
  [[nodiscard]] double impacts() const { return impacts_; }

  /// Volume that each face has lost since the last mark() [m3].
  [[nodiscard]] double since_mark(std::size_t face) const { return faces_[face].volume() - reference_[face]; }
  void mark();

  void save(StateWriter& out) const;
  /// @throws Error (io) when the state has other faces.
  void load(const StateReader& in);

 private:
  std::vector<WearAmount> faces_;
  std::vector<double> reference_;  // volume at the last mark [m3]
  WearAmount total_;
  double impacts_ = 0.0;
};

}  // namespace scree
