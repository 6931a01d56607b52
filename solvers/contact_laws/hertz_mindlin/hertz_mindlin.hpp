// HertzMindlin: elastic spheres. Along the normal Hertz' force, along the surface Mindlin's no-slip stiffness up to Coulomb's
// limit, and dashpots with which the restitution does not depend on the speed:
//
//     a = sqrt(R x),     F = 4/3 E a x + 2 sqrt(5/6) zeta sqrt(2 E a m) v,     kt = 8 G a,    Ct = 2 sqrt(5/6) zeta sqrt(kt m)
//
// x overlap, v speed of approach, R and m effective, E and G of elastic_pairs.hpp. The tangential force grows by kt vt dt; when
// the circle of contact shrinks, it shrinks with it (Thornton, Cummins, Cleary, Powder Technology 210 (2011) 189, eq. 19),
// without which a cycle of loads could create energy (Elata and Berryman, Mech. Mater. 24 (1996) 229).
#pragma once

#include "elastic_pairs.hpp"
#include "granular/cohesion.hpp"
#include "granular/rolling_resistance.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/contact_reader.hpp"

namespace scree {

class HertzMindlin final : public ContactLaw, public ContactReader {
 public:
  explicit HertzMindlin(const Options& options);
  static std::vector<Parameter> parameters();

  /// Logs moduli and damping of each pair of materials.
  void setup(SceneServices& services) override;
  [[nodiscard]] std::size_t history_size() const override;
  [[nodiscard]] double reach(double radius) const override;
  [[nodiscard]] bool resists_rolling() const override { return rolling_.acts(); }
  [[nodiscard]] bool coheres() const override { return cohesion_ != granular::Cohesion::none; }
  [[nodiscard]] std::optional<UnreadValue> unread(const ContactMaterial& values) const override;
  /// `rayleigh_fraction` of Rayleigh's time; a twentieth of the time of an impact where that is less.
  [[nodiscard]] double stable_step(const ContactScale& contact) const override;
  void forces(ContactBatch& batch) const override;

 private:
  void press(ContactBatch& batch, granular::ContactLanes& lanes) const;
  void press_necks(ContactBatch& batch, granular::ContactLanes& lanes) const;
  void finish(ContactBatch& batch, granular::ContactLanes& lanes, const granular::Lane& modulus,
              const granular::Lane& pull_off) const;
  [[nodiscard]] bool has_necks() const { return cohesion_ == granular::Cohesion::jkr; }

  ElasticPairs pairs_;
  double fraction_ = 0.0;            ///< of Rayleigh's time [1]
  double tangential_damping_ = 0.0;  ///< factor on Ct [1]
  granular::RollingResistance rolling_;
  granular::Cohesion cohesion_ = granular::Cohesion::none;
  SourceLocation cohesion_place_;  // in the scene
};

}  // namespace scree
