// Families: the kinds of particle that a feed mixes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "particle_template.hpp"
#include "scree/interfaces/report_table.hpp"
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
  /// What became of the rows of its table; empty for a family that has none.
  [[nodiscard]] std::optional<ReportTable> report() const;
  /// Draws a particle.
  [[nodiscard]] Particle draw(RandomStream& random) const;
  /// Mass of a drawn particle [kg], without making its shape.
  [[nodiscard]] double draw_mass(RandomStream& random) const;

 private:
  /// Of a family of scanned particles, or of any other. @{
  void make_scanned(const Options& options, SceneServices& services);
  void make_designed(const Options& options, SceneServices& services);
  /// @}
  /// Reads the laws of size and density. @throws Error (usage) when one may fall below zero.
  void read_laws(const Options& options, SceneServices& services);
  /// Size [m] and density [kg/m3] of a particle of this template.
  [[nodiscard]] Measured draw_measures(const ParticleTemplate& unit, RandomStream& random) const;
  [[nodiscard]] std::size_t draw_template(RandomStream& random) const;

  std::string name_;
  double share_;  // [1]
  std::uint32_t material_ = 0;
  Distribution size_;     // diameter of the sphere of equal volume [m]; scanned particles have their own
  Distribution density_;  // [kg/m3]; scanned particles have their own
  bool random_alignment_;
  std::vector<ParticleTemplate> templates_;
  std::optional<ScanRows> rows_;
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
  /// Tables of what became of scanned particles.
  [[nodiscard]] std::vector<ReportTable> report() const;

 private:
  std::vector<Family> families_;
  std::vector<double> cumulative_;  // probability by number, summed up [1]
};

}  // namespace scree
