#include "family.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"

namespace scree {
namespace {

/// Particles drawn to learn the mean mass of a family: its relative error is below 1 % for any sensible size law.
constexpr int kMassSamples = 20000;

std::string describe(const std::string& name, const std::vector<ParticleTemplate>& templates) {
  double volume = 0.0, hausdorff = 0.0;
  std::size_t spheres = 0;
  for (const ParticleTemplate& unit : templates) {
    volume = std::max(volume, std::abs(unit.volume_error));
    hausdorff = std::max(hausdorff, unit.hausdorff);
    spheres = std::max(spheres, unit.spheres.size());
  }
  char text[200];
  std::snprintf(
      text, sizeof text,
      "family '%s': up to %zu spheres a particle, volume within %.2f %%, Hausdorff distance within %.2f %% of the size",
      name.c_str(), spheres, 100 * volume, 100 * hausdorff);
  return text;
}

}  // namespace

std::vector<Parameter> Family::parameters() {
  return {Parameter::text("name", "of the family, for messages"),
          Parameter::text("material", "name of a material"),
          Parameter::number("share", "1", "its part of the feed, relative to the other families'")
              .above(0.0)
              .by_default(1.0),
          Distribution::parameter("size", "m", "diameter of the sphere of equal volume"),
          Parameter::variant("density", Distribution::variants("kg/m3"), "mass density; the material's when left out")
              .with_shorthand("constant", "value")
              .optional(),
          Parameter::variant("shape", particle_shapes(), "the shape of its particles"),
          Parameter::choice("alignment", {"random", "fixed"}, "orientation at birth").by_default("random"),
          Parameter::columns("attributes", Distribution::variants("1"), "1", "body attributes, in SI")
              .with_shorthand("constant", "value")
              .optional()};
}

Family::Family(const Options& options, SceneServices& services)
    : name_{options.text("name")},
      share_{options.number("share")},
      size_{options.table("size")},
      random_alignment_{options.text("alignment") == "random"},
      templates_{make_templates(options.table("shape"), name_)} {
  const std::int64_t material = services.materials().find(options.text("material"));
  if (material < 0) static_cast<void>(services.material(options.text("material")));  // throws the sentence
  material_ = static_cast<std::uint32_t>(material);
  density_ = options.has("density") ? Distribution{options.table("density")}
                                    : Distribution{services.materials()[material_].density};
  if (size_.minimum() <= 0.0 || density_.minimum() <= 0.0) {
    throw options.error("size",
                        "family '" + name_ + "': sizes and densities have to be above zero; give the law a `min`");
  }
  if (options.has("attributes")) {
    const Options& columns = options.table("attributes");
    for (const std::string& column : columns.names()) {
      const AttributeId id = services.provide_attribute({column, "1", "given by feeds", 0.0, {}});
      attributes_.emplace_back(id, Distribution{columns.table(column)});
    }
  }
  if (options.table("shape").type() != "sphere") services.log(describe(name_, templates_));
}

Particle Family::draw(RandomStream& random) const {
  const double size = size_.sample(random);
  const double density = density_.sample(random);
  const std::size_t pick = templates_.size() == 1 ? 0 : random() % templates_.size();
  Particle particle;
  particle.shape = scaled_shape(templates_[pick], size);
  particle.bounding_radius = size * templates_[pick].bounding_radius;
  NewBody& body = particle.body;
  body.motion = Motion::dynamic;
  body.material = material_;
  body.pose.orientation = random_alignment_ ? random.orientation() : Quat{};
  body.mass = density * particle.shape.volume;
  body.inertia = density * particle.shape.unit_inertia;
  body.radius = 0.5 * size;
  for (const auto& [column, law] : attributes_) body.attributes.emplace_back(column, law.sample(random));
  return particle;
}

double Family::draw_mass(RandomStream& random) const {
  const double size = size_.sample(random);
  return density_.sample(random) * std::numbers::pi / 6.0 * size * size * size;
}

std::vector<Parameter> Mixture::parameters() {
  return {
      Parameter::choice("share_by", {"number", "mass"}, "what the shares of the families count").by_default("number"),
      Parameter::tables("families", Family::parameters(), "the kinds of particle in the feed")};
}

Mixture::Mixture(const Options& options, SceneServices& services) {
  for (const Options& family : options.tables("families")) families_.emplace_back(family, services);
  if (families_.empty()) throw options.error("families", "a feed needs at least one family");
  for (const Family& family : families_) {
    double weight = family.share();
    if (options.text("share_by") == "mass") {
      // Shares by mass become probabilities by number through the mean mass of a particle, on a stream of its own.
      RandomStream random = services.random_stream("mean mass of " + family.name());
      double mass = 0.0;
      for (int i = 0; i < kMassSamples; ++i) mass += family.draw_mass(random) / kMassSamples;
      weight /= mass;
    }
    cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + weight);
  }
}

Particle Mixture::draw(RandomStream& random) const {
  const double u = random.uniform() * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
  const auto index = static_cast<std::size_t>(found - cumulative_.begin());
  return families_[std::min(index, families_.size() - 1)].draw(random);
}

}  // namespace scree
