// ElasticPairs: what the elastic constants of two materials make of their contact.
//
//     1/E = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b,      1/G = 2 (2 - nu_a)(1 + nu_a)/E_a + 2 (2 - nu_b)(1 + nu_b)/E_b
//
// A rigid material adds nothing to either sum.
#pragma once

#include <string>
#include <vector>

#include "granular/cohesion.hpp"
#include "granular/contact_lanes.hpp"
#include "granular/restitution.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"

namespace scree {

class ElasticPairs {
 public:
  explicit ElasticPairs(const Options& options);
  static std::vector<Parameter> parameters();

  /// @throws Error (usage) for a material that has no modulus and is not called rigid, or that is called rigid and has one.
  void setup(SceneServices& services, granular::Cohesion cohesion);

  /// Of two materials, as ContactBatch::materials counts them.
  [[nodiscard]] std::size_t index(std::uint32_t a, std::uint32_t b) const { return a * solids_.size() + b; }
  /// A sentence on pair (a, b), for the log.
  [[nodiscard]] std::string describe(const Materials& materials, std::uint32_t a, std::uint32_t b) const;
  /// Rayleigh's time pi r sqrt(rho / G) / (0.163 nu + 0.877) of a ball [s]: that of a wave along its surface to the other
  /// side. @param mass, radius of the contact: the ball is no smaller than both allow. Infinite for a rigid material.
  [[nodiscard]] double rayleigh_time(std::uint32_t material, double mass, double radius) const;
  /// @throws Error (usage) when both materials are rigid.
  void require_elastic(std::uint32_t a, std::uint32_t b) const;

  granular::PairColumn modulus, shear;  ///< E, G [Pa]; 0 between rigid materials
  granular::PairColumn ratio;           ///< damping ratio zeta [1]
  granular::PairColumn friction;        ///< [1]
  granular::PairColumn adhesion;        ///< of the kind of cohesion [J/m2] or [J/m3]
  granular::RestitutionOptions end;

 private:
  struct Solid {
    std::string name;
    double density, young, poisson;  ///< [kg/m3], [Pa], [1]
    bool rigid = false;
  };
  void read_solids(SceneServices& services);
  void refuse_springs(const Materials& materials) const;

  Options options_;
  std::vector<Solid> solids_;
};

}  // namespace scree
