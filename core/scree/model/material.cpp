#include "scree/model/material.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/require.hpp"

namespace scree {
namespace {

double combine(PairRule rule, double a, double b) {
  switch (rule) {
    case PairRule::minimum:
      return std::min(a, b);
    case PairRule::maximum:
      return std::max(a, b);
    case PairRule::mean:
      return 0.5 * (a + b);
    case PairRule::geometric_mean:
      return std::sqrt(a * b);
  }
  return a;
}

/// Friction and restitution follow the rule; springs of the two materials act in series, so compliances add up.
ContactMaterial combine(PairRule rule, const ContactMaterial& a, const ContactMaterial& b) {
  return {.friction = combine(rule, a.friction, b.friction),
          .restitution = combine(rule, a.restitution, b.restitution),
          .rolling_friction = combine(rule, a.rolling_friction, b.rolling_friction),
          .spinning_friction = combine(rule, a.spinning_friction, b.spinning_friction),
          .compliance = a.compliance + b.compliance,
          .damping = combine(rule, a.damping, b.damping),
          .surface_energy = combine(rule, a.surface_energy, b.surface_energy),
          .cohesion_energy_density = combine(rule, a.cohesion_energy_density, b.cohesion_energy_density)};
}

}  // namespace

std::uint32_t Materials::add(Material material) {
  SCREE_REQUIRE(find(material.name) < 0, "material '" + material.name + "' was added twice");
  materials_.push_back(std::move(material));
  refresh();
  return static_cast<std::uint32_t>(materials_.size() - 1);
}

void Materials::set_rule(PairRule rule) {
  rule_ = rule;
  refresh();
}

void Materials::set_pair(std::uint32_t a, std::uint32_t b, const ContactMaterial& values) {
  SCREE_REQUIRE(a < materials_.size() && b < materials_.size(), "a pair needs two existing materials");
  listed_.push_back({a, b, values});
  refresh();
}

std::int64_t Materials::find(std::string_view name) const {
  const auto found =
      std::find_if(materials_.begin(), materials_.end(), [&](const Material& m) { return m.name == name; });
  return found == materials_.end() ? -1 : found - materials_.begin();
}

std::vector<std::string> Materials::names() const {
  std::vector<std::string> names;
  for (const Material& material : materials_) names.push_back(material.name);
  return names;
}

bool Materials::is_listed(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(listed_.begin(), listed_.end(),
                     [&](const Listed& l) { return (l.a == a && l.b == b) || (l.a == b && l.b == a); });
}

void Materials::refresh() {
  const std::size_t n = materials_.size();
  table_.resize(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b)
      table_[a * n + b] = combine(rule_, materials_[a].contact, materials_[b].contact);
  }
  for (const Listed& l : listed_) table_[l.a * n + l.b] = table_[l.b * n + l.a] = l.values;
}

}  // namespace scree
