// LinearPairs: stiffness and damping of each pair of materials.
#pragma once

#include <string>

#include "granular/contact_lanes.hpp"
#include "granular/restitution.hpp"
#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"
#include "scree/model/material.hpp"

namespace scree {

/// Where a pair's stiffness comes from, first that applies: its compliance; `stiffness`; `overlap_target` at
/// `overlap_speed`, k = m (v / (target R))^2 with mass m and radius R of the contact. Its damping: its own, if it has a
/// compliance; `damping`; its restitution, C = 2 zeta sqrt(k m).
class LinearPairs {
 public:
  explicit LinearPairs(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(const Materials& materials);

  /// Of two materials, as ContactBatch::materials counts them.
  [[nodiscard]] std::size_t index(std::uint32_t a, std::uint32_t b) const { return a * materials_ + b; }
  /// A sentence on pair (a, b), for the log.
  [[nodiscard]] std::string describe(const Materials& materials, std::uint32_t a, std::uint32_t b) const;
  /// [N/m], of an effective mass [kg] and radius [m].
  [[nodiscard]] double stiffness(std::size_t pair, double mass, double radius) const {
    return stiffness_[pair] + scaled_[pair] * mass / (radius * radius);
  }
  /// [N s/m], of a stiffness [N/m] and an effective mass [kg].
  [[nodiscard]] double damping(std::size_t pair, double stiffness, double mass) const;
  [[nodiscard]] const granular::RestitutionOptions& end() const { return restitution_; }

  /// The same for the contacts of a batch.
  void find_stiffness(const ContactBatch& batch, granular::Lane& stiffness) const;
  void find_damping(const ContactBatch& batch, const granular::Lane& stiffness, granular::Lane& damping) const;
  void find_friction(const ContactBatch& batch, granular::Lane& friction) const {
    granular::spread(friction_, batch, friction);
  }

 private:
  void add(const ContactMaterial& pair);

  double option_stiffness_ = 0.0, option_damping_ = -1.0;  ///< [N/m], [N s/m]; 0 and -1: not given
  double target_ = 0.0, speed_ = 0.0;                      ///< overlap over radius [1], [m/s]
  granular::RestitutionOptions restitution_;
  granular::PairColumn stiffness_;  ///< of the pair [N/m], or 0
  granular::PairColumn scaled_;     ///< the same in units of m / R^2 [m2/s2]
  granular::PairColumn damping_;    ///< of the pair [N s/m], or 0
  granular::PairColumn twice_;      ///< 2 zeta [1], or 0
  granular::PairColumn friction_;   ///< [1]
  bool scales_ = false, has_damping_ = false;
  std::size_t materials_ = 0;
};

}  // namespace scree
