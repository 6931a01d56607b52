// LinearSpringDashpot: the contact law of Cundall and Strack, a linear spring and a dashpot along the normal and along the
// surface.
//
//     F = k x + C v,        Ft = -min( mu F / |S + Ct vt|, 1 ) (S + Ct vt),   S' = kt vt
//
// x overlap, v speed of approach. Rolling resistance and cohesion come from solvers/contact_laws/granular.
#pragma once

#include "granular/cohesion.hpp"
#include "granular/rolling_resistance.hpp"
#include "linear_pairs.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/contact_reader.hpp"

namespace scree {

class LinearSpringDashpot final : public ContactLaw, public ContactReader {
 public:
  explicit LinearSpringDashpot(const Options& options);
  static std::vector<Parameter> parameters();

  /// Logs stiffness, damping and contact time of each pair of materials.
  void setup(SceneServices& services) override;
  [[nodiscard]] std::size_t history_size() const override;
  [[nodiscard]] bool resists_rolling() const override { return rolling_.acts(); }
  [[nodiscard]] bool coheres() const override { return cohesion_ != granular::Cohesion::none; }
  [[nodiscard]] std::optional<UnreadValue> unread(const ContactMaterial& values) const override;
  /// A twentieth of the contact time; half of the longest stable step where that is less.
  [[nodiscard]] double stable_step(const ContactScale& contact) const override;
  void forces(ContactBatch& batch) const override;

 private:
  void push(ContactBatch& batch, granular::ContactLanes& lanes) const;

  LinearPairs pairs_;
  double stiffness_ratio_ = 0.0, damping_ratio_ = 0.0;  ///< along the surface over along the normal [1]
  granular::RollingResistance rolling_;
  granular::Cohesion cohesion_ = granular::Cohesion::none;
  SourceLocation cohesion_place_;  // in the scene
  granular::PairColumn cohesion_column_;
};

}  // namespace scree
