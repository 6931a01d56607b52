#include "spectra.hpp"

#include "scree/model/material.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

Spectra::Spectra(const Materials& materials, const SpectrumRange& range) : materials_{materials.size()} {
  const LogHistogram bins{range.lower, range.upper, range.per_decade};
  for (std::uint32_t a = 0; a < materials_; ++a) {
    for (std::uint32_t b = a; b < materials_; ++b) {
      pairs_.push_back({materials[a].name + " - " + materials[b].name, bins, bins, bins});
    }
  }
}

void Spectra::add(const Collision& c) {
  // Row a of the upper triangle begins after a rows of materials_, materials_ - 1, ... entries.
  const std::size_t a = c.material_a, first = a * materials_ - a * (a + 1) / 2 + a;
  PairSpectra& pair = pairs_[first + (c.material_b - a)];
  pair.normal.add(c.normal_energy, c.normal_energy);
  pair.tangential.add(c.tangential_energy, c.tangential_energy);
  pair.dissipated.add(c.dissipated, c.dissipated);
}

void Spectra::save(StateWriter& out) const {
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto group = out.group("pair_" + std::to_string(k));
    pairs_[k].normal.save(*group->group("normal"));
    pairs_[k].tangential.save(*group->group("tangential"));
    pairs_[k].dissipated.save(*group->group("dissipated"));
  }
}

void Spectra::load(const StateReader& in) {
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto group = in.group("pair_" + std::to_string(k));
    pairs_[k].normal.load(*group->group("normal"));
    pairs_[k].tangential.load(*group->group("tangential"));
    pairs_[k].dissipated.load(*group->group("dissipated"));
  }
}

}  // namespace scree
