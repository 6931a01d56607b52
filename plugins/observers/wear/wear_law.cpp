#include "wear_law.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"

namespace scree {

namespace {

// The members of `values` that `options` has, over those of `base`.
WearPair over(const WearPair& base, const Options& options) {
  const auto value = [&](const char* name, double otherwise) {
    return options.has(name) ? options.number(name) : otherwise;
  };
  WearPair pair;
  pair.wear_coefficient = value("wear_coefficient", base.wear_coefficient);
  pair.hardness = value("hardness", base.hardness);
  // Finnie's flow stress is nearly the hardness, for want of a better value.
  pair.flow_stress = value("flow_stress", options.has("hardness") ? pair.hardness : base.flow_stress);
  pair.force_ratio = value("force_ratio", base.force_ratio);
  pair.cut_ratio = value("cut_ratio", base.cut_ratio);
  return pair;
}

std::vector<Parameter> members(bool whole) {
  Parameter hardness = Parameter::number("hardness", "Pa", "of what is worn").above(0.0);
  Parameter coefficient =
      Parameter::number("wear_coefficient", "1", "Archard's k; 0: sliding wears nothing").at_least(0.0);
  std::vector<Parameter> list;
  list.push_back(whole ? std::move(hardness) : std::move(hardness).optional());
  list.push_back(whole ? std::move(coefficient).by_default(1e-3) : std::move(coefficient).optional());
  list.push_back(Parameter::number("flow_stress", "Pa", "of what is worn, for impacts; the hardness when left out")
                     .above(0.0)
                     .optional());
  list.push_back(Parameter::number("force_ratio", "1", "Finnie's K, normal to tangential force").above(0.0).optional());
  list.push_back(Parameter::number("cut_ratio", "1", "Finnie's psi, length to depth of a cut").above(0.0).optional());
  return list;
}

}  // namespace

double archard_volume(const WearPair& pair, double force_way) {
  return pair.wear_coefficient * force_way / pair.hardness;
}

double finnie_volume(const WearPair& pair, double mass, double normal_speed, double tangential_speed) {
  const double n = normal_speed, t = tangential_speed, k = pair.force_ratio;
  if (!(n > 0.0)) return 0.0;
  const double scale = mass / (pair.flow_stress * pair.cut_ratio * k);
  // U^2 sin 2 alpha = 2 n t, U^2 sin^2 alpha = n^2, U^2 cos^2 alpha = t^2
  return 6.0 * n <= k * t ? scale * (2.0 * n * t - 6.0 / k * n * n) : scale * k / 6.0 * t * t;
}

std::vector<Parameter> WearTable::parameters() {
  std::vector<Parameter> list = members(true);
  std::vector<Parameter> pair = members(false);
  pair.insert(pair.begin(), {Parameter::text("worn", "material of the worn body"),
                             Parameter::text("by", "material of what touches it")});
  list.push_back(
      Parameter::tables("pair", std::move(pair), "other values for one material worn by another").optional());
  return list;
}

void WearTable::setup(const Options& options, SceneServices& services) {
  materials_ = services.materials().size();
  WearPair base;
  base = over(base, options);
  pairs_.assign(materials_ * materials_, base);
  std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
  for (const Options& table : options.tables("pair")) {
    const std::uint32_t worn = services.material(table.text("worn")), by = services.material(table.text("by"));
    if (!listed.emplace(worn, by).second) {
      throw table.error("worn", "'" + table.text("worn") + "' by '" + table.text("by") + "' is listed twice; keep one");
    }
    pairs_[worn * materials_ + by] = over(base, table);
  }
}

}  // namespace scree
