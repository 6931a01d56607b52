#include "family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "scan_family.hpp"
#include "scree/config/parameter_text.hpp"
#include "scree/config/suggest.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"

namespace scree {
namespace {

/// The mean mass of a family is sampled until its standard error falls below this part of it [1], or to the most draws.
constexpr double kMassError = 2e-3;
constexpr int kLeastMassSamples = 20000;
constexpr int kMostMassSamples = 2000000;

/// A law that reaches down to zero may, once in a long while, hit it.
double positive(const Distribution& law, RandomStream& random) {
  for (;;) {
    if (const double value = law.sample(random); value > 0.0) return value;
  }
}

double sphere_volume(double diameter) { return std::numbers::pi / 6.0 * diameter * diameter * diameter; }

std::string describe(const std::string& name, const TemplateSet& set) {
  double volume = 0.0, hausdorff = 0.0;
  std::size_t spheres = 0;
  for (const ParticleTemplate& unit : set.templates) {
    volume = std::max(volume, std::abs(unit.volume_error));
    hausdorff = std::max(hausdorff, unit.hausdorff);
    spheres = std::max(spheres, unit.spheres.size());
  }
  char text[240];
  std::snprintf(
      text, sizeof text,
      "family '%s': up to %zu spheres a particle, volume within %.2f %%, Hausdorff distance within %.2f %% of %s",
      name.c_str(), spheres, 100 * volume, 100 * hausdorff, set.rows.used > 0 ? "the largest extent" : "the size");
  return set.redrawn == 0 ? text : text + ("; " + std::to_string(set.redrawn) + " random hulls were drawn again");
}

/// Mean mass of a family's particles [kg]; logs when a wide law leaves it uncertain.
double mean_mass(const Family& family, const SceneServices& services) {
  RandomStream random = services.random_stream("mean mass of " + family.name());
  double mean = 0.0, squares = 0.0;  // Welford: running mean, sum of squared deviations
  for (int n = 1;; ++n) {
    const double mass = family.draw_mass(random), before = mass - mean;
    mean += before / n;
    squares += before * (mass - mean);
    if (n < kLeastMassSamples) continue;
    const double error = std::sqrt(squares) / n / mean;
    if (error <= kMassError) return mean;
    if (n < kMostMassSamples) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "family '%s': its sizes spread so widely that the mean mass, and with it the share, is known to "
                  "%.1f %% only",
                  family.name().c_str(), 100 * error);
    services.log(text);
    return mean;
  }
}

}  // namespace

std::vector<Parameter> Family::parameters() {
  std::vector<Variant> shapes = particle_shapes();
  shapes.push_back(scan_shape());
  Parameter size =
      Distribution::parameter("size", "m", "diameter of the sphere of equal volume; not for scans").optional();
  return {Parameter::text("name", "of the family, for messages"),
          Parameter::text("material", "name of a material"),
          Parameter::number("share", "1", "its part of the feed, relative to the other families'")
              .above(0.0)
              .by_default(1.0),
          std::move(size),
          Parameter::variant("density", Distribution::variants("kg/m3"), "mass density; the material's when left out")
              .with_shorthand("constant", "value")
              .optional(),
          Parameter::variant("shape", std::move(shapes), "the shape of its particles"),
          Parameter::choice("alignment", {"random", "fixed"}, "orientation at birth").by_default("random"),
          Parameter::columns("attributes", Distribution::variants("1"), "1", "body attributes, in SI")
              .with_shorthand("constant", "value")
              .optional()};
}

Family::Family(const Options& options, SceneServices& services)
    : name_{options.text("name")},
      share_{options.number("share")},
      random_alignment_{options.text("alignment") == "random"} {
  const std::string& wanted = options.text("material");
  const std::int64_t material = services.materials().find(wanted);
  if (material < 0) {
    const std::vector<std::string> known = services.materials().names();
    throw options.error("material", "of family '" + name_ + "' is '" + wanted + "', but the scene has " +
                                        list_of(known) + suggestion(wanted, known));
  }
  material_ = static_cast<std::uint32_t>(material);
  if (options.table("shape").type() == "scan") {
    make_scanned(options, services);
  } else {
    make_designed(options, services);
  }
  if (options.has("attributes")) {
    const Options& columns = options.table("attributes");
    for (const std::string& column : columns.names()) {
      const AttributeId id = services.provide_attribute({column, "1", "given by feeds", 0.0, {}});
      attributes_.emplace_back(id, Distribution{columns.table(column)});
    }
  }
}

void Family::make_scanned(const Options& options, SceneServices& services) {
  for (const char* key : {"size", "density"}) {
    if (options.has(key)) {
      throw options.error(key, "of family '" + name_ + "' is measured: its scanned particles have the " +
                                   std::string{key} + " of their table; leave it out");
    }
  }
  TemplateSet set = make_scan_templates(options.table("shape"), name_, services);
  services.log(describe(name_, set));
  templates_ = std::move(set.templates);
  rows_ = set.rows;
  for (const ParticleTemplate& unit : templates_)
    shared_.push_back(services.shapes().add(scaled_shape(unit, unit.measured.size)));
}

void Family::make_designed(const Options& options, SceneServices& services) {
  if (!options.has("size")) {
    throw options.error("family '" + name_ + "' needs 'size', the diameter of the sphere of equal volume");
  }
  TemplateSet set = make_templates(options.table("shape"), name_);
  if (options.table("shape").type() != "sphere") services.log(describe(name_, set));
  templates_ = std::move(set.templates);
  read_laws(options, services);
  if (size_.minimum() == size_.maximum()) {
    for (const ParticleTemplate& unit : templates_)
      shared_.push_back(services.shapes().add(scaled_shape(unit, size_.minimum())));
  }
}

void Family::read_laws(const Options& options, SceneServices& services) {
  size_ = Distribution{options.table("size")};
  density_ = options.has("density") ? Distribution{options.table("density")}
                                    : Distribution{services.materials()[material_].density};
  for (const Distribution* law : {&size_, &density_}) {
    if (law->minimum() >= 0.0 && law->maximum() > 0.0) continue;
    const std::string key = law == &size_ ? "size" : "density";
    if (!options.has(key))
      throw options.error("family '" + name_ + "': the density of its material must be above zero");
    const std::string least = quantity_text(law->minimum(), law == &size_ ? "m" : "kg/m3");
    if (options.table(key).type() == "constant") {
      throw options.error(key, "of family '" + name_ + "' is " + least + ", but must be above zero");
    }
    if (law->maximum() <= 0.0) {
      throw options.error(key, "of family '" + name_ + "' is " +
                                   quantity_text(law->maximum(), law == &size_ ? "m" : "kg/m3") +
                                   " at most, but must be above zero");
    }
    throw options.error(key, "of family '" + name_ + "' must never be below zero, but this law " +
                                 (std::isfinite(law->minimum()) ? "reaches " + least : std::string{"has no end"}) +
                                 "; give it a 'min' of zero or more");
  }
}

std::optional<ReportTable> Family::report() const {
  if (!rows_) return {};
  return ReportTable{
      "scanned particles of family " + name_,
      {"rows used", "rows refused", "rows of other materials"},
      {{std::to_string(rows_->used), std::to_string(rows_->refused), std::to_string(rows_->of_other_materials)}}};
}

NewBody to_body(Particle&& particle, ShapeSet& shapes) {
  if (particle.shape) particle.body.shape = shapes.add(*particle.shape);
  return std::move(particle.body);
}

std::size_t Family::draw_template(RandomStream& random) const {
  return templates_.size() == 1 ? 0 : random() % templates_.size();
}

Measured Family::draw_measures(const ParticleTemplate& unit, RandomStream& random) const {
  if (unit.measured.size > 0.0) return unit.measured;
  const double size = positive(size_, random);
  return {size, positive(density_, random)};
}

Particle Family::draw(RandomStream& random) const {
  // Scanned particles are drawn as a whole; others draw their size before their variant.
  const bool scanned = rows_.has_value();
  Measured own = scanned ? Measured{} : draw_measures(templates_[0], random);
  const std::size_t pick = draw_template(random);
  const ParticleTemplate& unit = templates_[pick];
  if (scanned) own = unit.measured;
  Particle particle;
  NewBody& body = particle.body;
  if (shared_.empty()) {
    particle.shape = scaled_shape(unit, own.size);
  } else {
    body.shape = shared_[pick];
  }
  particle.bounding_radius = own.size * unit.bounding_radius;
  body.motion = Motion::dynamic;
  body.material = material_;
  body.pose.orientation = random_alignment_ ? random.orientation() : Quat{};
  body.mass = own.density * sphere_volume(own.size);
  body.inertia = own.density * std::pow(own.size, 5) * unit.unit_inertia;
  body.radius = 0.5 * own.size;
  for (const auto& [column, law] : attributes_) body.attributes.emplace_back(column, law.sample(random));
  return particle;
}

double Family::draw_mass(RandomStream& random) const {
  const Measured own = draw_measures(rows_ ? templates_[draw_template(random)] : templates_[0], random);
  return own.density * sphere_volume(own.size);
}

std::vector<Parameter> Mixture::parameters() {
  return {
      Parameter::choice("share_by", {"number", "mass"}, "what the shares of the families count").by_default("number"),
      Parameter::tables("families", Family::parameters(), "the kinds of particle in the feed")};
}

Mixture::Mixture(const Options& options, SceneServices& services) {
  for (const Options& family : options.tables("families")) families_.emplace_back(family, services);
  if (families_.empty()) throw options.error("families", "must hold at least one family");
  for (const Family& family : families_) {
    double weight = family.share();
    if (options.text("share_by") == "mass") {
      // Shares by mass become probabilities by number.
      weight /= mean_mass(family, services);
    }
    cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + weight);
  }
}

std::vector<ReportTable> Mixture::report() const {
  std::vector<ReportTable> tables;
  for (const Family& family : families_) {
    if (std::optional<ReportTable> table = family.report()) tables.push_back(*std::move(table));
  }
  return tables;
}

Particle Mixture::draw(RandomStream& random) const {
  const double u = random.uniform() * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
  const auto index = static_cast<std::size_t>(found - cumulative_.begin());
  return families_[std::min(index, families_.size() - 1)].draw(random);
}

}  // namespace scree
