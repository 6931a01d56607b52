// Spectra: histograms of collisions for every pair of materials.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contact_study/log_histogram.hpp"
#include "impact_book.hpp"

namespace scree {

class Materials;

/// The spectra of one pair of materials.
struct PairSpectra {
  std::string name;         ///< "steel - ore"
  LogHistogram normal;      ///< by 1/2 m_eff v_n^2 [J], weight the same
  LogHistogram tangential;  ///< by 1/2 m_eff v_t^2 [J], weight the same
  LogHistogram dissipated;  ///< by what the whole collision took [J], weight the same
};

/// Which energies collisions are binned by.
struct SpectrumRange {
  double lower = 1e-9, upper = 1.0;  ///< [J]
  int per_decade = 5;
};

/// All pairs, in the order (0,0), (0,1), ..., (1,1), ...
class Spectra {
 public:
  Spectra() = default;
  Spectra(const Materials& materials, const SpectrumRange& range);
  void add(const Collision& collision);

  [[nodiscard]] const std::vector<PairSpectra>& pairs() const { return pairs_; }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  std::size_t materials_ = 0;
  std::vector<PairSpectra> pairs_;
};

}  // namespace scree
