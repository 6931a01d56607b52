// Families: the kinds of particle that a feed mixes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "particle_template.hpp"
#include "scree/model/body_store.hpp"
#include "scree/model/distribution.hpp"
#include "scree/model/random.hpp"

namespace scree {

class SceneServices;

/// A particle before it has a place.
struct Particle {
  NewBody body;                    ///< all but place and velocity, and the shape if it is an own one
  std::optional<ShapeData> shape;  ///< its own; none when body.shape is one that the family shares
  double bounding_radius = 0.0;    ///< about the centre of mass [m]
};

/// The body of a particle that has its place; adds its shape to `shapes` unless it is shared.
[[nodiscard]] NewBody to_body(Particle&& particle, ShapeSet& shapes);

/// One kind of particle.
class Family {
 public:
  /// @throws Error (usage) for an unknown material or a shape that cannot be made.
  Family(const Options& options, SceneServices& services);

  /// The settings of a family.
  static std::vector<Parameter> parameters();

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double share() const { return share_; }
  /// Draws a particle.
  [[nodiscard]] Particle draw(RandomStream& random) const;
  /// Mass of a drawn particle [kg], without making its shape.
  [[nodiscard]] double draw_mass(RandomStream& random) const;

 private:
  std::string name_;
  double share_;  // [1]
  std::uint32_t material_ = 0;
  Distribution size_;     // diameter of the sphere of equal volume [m]
  Distribution density_;  // [kg/m3]
  bool random_alignment_;
  std::vector<ParticleTemplate> templates_;
  std::vector<std::uint32_t> shared_;  // shapes of the templates, if all particles are of one size; else empty
  std::vector<std::pair<AttributeId, Distribution>> attributes_;
};

/// The mixture of a feed: which family the next particle is of.
class Mixture {
 public:
  /// Settings `families` and `share_by`.
  static std::vector<Parameter> parameters();

  Mixture(const Options& options, SceneServices& services);
  [[nodiscard]] Particle draw(RandomStream& random) const;

 private:
  std::vector<Family> families_;
  std::vector<double> cumulative_;  // probability by number, summed up [1]
};

}  // namespace scree
