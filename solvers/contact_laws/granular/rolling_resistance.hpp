// Rolling and spinning resistance, after Ai, Chen, Rotter, Ooi, Powder Technology 206 (2011) 269. w is the part of the relative
// angular velocity in the tangent plane (rolling) or along the normal (spinning), rho the arm [m] that the pair of materials
// has as rolling_friction or spinning_friction: their coefficient of rolling times the effective radius.
//
//   constant_directional   model A:  T = -rho load w / |w|
//   elastic_plastic        model C:  M' = k w, |M| <= rho load;  T = -M - c w, without c w while |M| is at its limit,
//                          and |T| <= rho load, which the paper does not ask of the dashpot; k = 2.25 kn rho^2, c = 2 eta sqrt(I k), I = 7/5 m R^2 (rolling) or 2/5 m R^2 (spinning)
//
// kn normal stiffness, m and R effective: I is that of a ball on a wall, about the point of contact. M [N m] is kept, and
// laid into the tangent plane as the contact turns.
#pragma once

#include <cstddef>
#include <optional>

#include "granular/contact_lanes.hpp"
#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"
#include "scree/interfaces/contact_reader.hpp"
#include "scree/model/material.hpp"

namespace scree::granular {

class RollingResistance {
 public:
  explicit RollingResistance(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(const Materials& materials);

  /// Doubles that a contact keeps.
  [[nodiscard]] std::size_t history_size() const;
  /// True when torques may differ from zero.
  [[nodiscard]] bool acts() const { return rolling_ != Model::none || spinning_ != Model::none; }
  /// The arm of rolling or of spinning that a pair has and no model reads.
  [[nodiscard]] std::optional<UnreadValue> unread(const ContactMaterial& pair) const;

  /// Fills in batch.torque from lanes.load and lanes.stiffness, and moves on what is kept from history[first] on.
  void add(ContactBatch& batch, const ContactLanes& lanes, std::size_t first) const;
  /// Two over the longest stable step [s] of the springs of rolling and spinning, in units of sqrt(kn / m) [1/s].
  [[nodiscard]] double rate(std::size_t pair, double radius) const;

 private:
  enum class Model { none, constant_directional, elastic_plastic };
  static Model model_of(const std::string& word);
  void roll(ContactBatch& batch, const ContactLanes& lanes, std::size_t first) const;
  void spin(ContactBatch& batch, const ContactLanes& lanes, std::size_t slot) const;

  Model rolling_ = Model::none, spinning_ = Model::none;
  double damping_ = 0.3;                   ///< eta [1]
  PairColumn rolling_arm_, spinning_arm_;  ///< [m]
};

}  // namespace scree::granular
