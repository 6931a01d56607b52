#include "elastic_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scree {

ElasticPairs::ElasticPairs(const Options& options) : end{options}, options_{options} {}

std::vector<Parameter> ElasticPairs::parameters() {
  std::vector<Parameter> list{
      Parameter::texts("rigid", "materials that do not deform, such as that of walls; all others need a young_modulus")
          .by_default(std::vector<std::string>{})};
  for (Parameter& parameter : granular::restitution_parameters()) list.push_back(std::move(parameter));
  return list;
}

void ElasticPairs::read_solids(SceneServices& services) {
  const Materials& materials = services.materials();
  solids_.clear();
  for (std::uint32_t k = 0; k < materials.size(); ++k) {
    const Material& m = materials[k];
    solids_.push_back({m.name, m.density, m.young_modulus, m.poisson_ratio});
  }
  for (const std::string& name : options_.texts("rigid")) solids_[services.material(name)].rigid = true;
  for (const Solid& solid : solids_) {
    if (solid.rigid && solid.young > 0.0) {
      throw options_.error("rigid",
                           "names material '" + solid.name + "', which has a young_modulus; take one of both away");
    }
    if (!solid.rigid && solid.young == 0.0) {
      throw options_.error("rigid", "does not name material '" + solid.name +
                                        "', whose young_modulus is not known; set [material." + solid.name +
                                        "] young_modulus, or name it in `rigid` when it is that of walls");
    }
  }
}

void ElasticPairs::refuse_springs(const Materials& materials) const {
  const auto refuse = [&](const ContactMaterial& contact, const std::string& who) {
    if (contact.compliance == 0.0 && contact.damping == 0.0) return;
    const std::string key = contact.compliance > 0.0 ? "compliance" : "damping";
    throw options_.error("hertz_mindlin takes stiffness from young_modulus and damping from restitution, but " + who +
                         " has a " + key +
                         ", which would be without effect; take it away, or take linear_spring_dashpot");
  };
  for (std::uint32_t a = 0; a < solids_.size(); ++a) {
    refuse(materials[a].contact, "material '" + solids_[a].name + "'");
    for (std::uint32_t b = 0; b <= a; ++b) {
      const std::string pair = "the pair of '" + solids_[b].name + "' and '" + solids_[a].name + "'";
      if (materials.is_listed(a, b)) refuse(materials.pair(a, b), pair);
    }
  }
}

void ElasticPairs::setup(SceneServices& services, granular::Cohesion cohesion) {
  read_solids(services);
  for (granular::PairColumn* column : {&modulus, &shear, &ratio, &friction, &adhesion}) column->clear();
  refuse_springs(services.materials());
  const auto give = [](const Solid& s) { return s.rigid ? 0.0 : (1.0 - s.poisson * s.poisson) / s.young; };
  const auto yield = [](const Solid& s) {
    return s.rigid ? 0.0 : 2.0 * (2.0 - s.poisson) * (1.0 + s.poisson) / s.young;
  };
  const auto inverse = [](double x) { return x > 0.0 ? 1.0 / x : 0.0; };
  const Materials& materials = services.materials();
  for (std::uint32_t a = 0; a < solids_.size(); ++a) {
    for (std::uint32_t b = 0; b < solids_.size(); ++b) {
      const ContactMaterial& pair = materials.pair(a, b);
      modulus.push_back(inverse(give(solids_[a]) + give(solids_[b])));
      shear.push_back(inverse(yield(solids_[a]) + yield(solids_[b])));
      ratio.push_back(end.ratio_of(pair.restitution));
      friction.push_back(pair.friction);
      adhesion.push_back(granular::cohesion_of_pair(cohesion, pair));
    }
  }
}

std::string ElasticPairs::describe(const Materials& materials, std::uint32_t a, std::uint32_t b) const {
  const std::size_t pair = index(a, b);
  const std::string who = fmt::format("{} on {}: ", solids_[a].name, solids_[b].name);
  if (modulus[pair] == 0.0) return who + "both rigid, for walls that do not touch each other";
  const double e = materials.pair(a, b).restitution;
  const std::string text =
      who + fmt::format("effective modulus {:.4g} Pa, shear {:.4g} Pa, restitution {:.4g} (damping ratio {:.4g})",
                        modulus[pair], shear[pair], std::max(e, end.least), ratio[pair]);
  return e < end.least ? text + fmt::format(", where {:.4g} is asked for", e) : text;
}

double ElasticPairs::rayleigh_time(std::uint32_t material, double mass, double radius) const {
  const Solid& solid = solids_[material];
  if (solid.rigid) return std::numeric_limits<double>::infinity();
  const double size = std::max(radius, std::cbrt(0.75 * mass / (std::numbers::pi * solid.density)));
  const double shear_modulus = 0.5 * solid.young / (1.0 + solid.poisson);
  return std::numbers::pi * size * std::sqrt(solid.density / shear_modulus) / (0.163 * solid.poisson + 0.877);
}

void ElasticPairs::require_elastic(std::uint32_t a, std::uint32_t b) const {
  if (modulus[index(a, b)] > 0.0) return;
  throw options_.error("rigid", "names the materials '" + solids_[a].name + "' and '" + solids_[b].name +
                                    "' of bodies that may touch each other; one of them needs a young_modulus instead");
}

}  // namespace scree
