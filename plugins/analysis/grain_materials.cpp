#include "analysis/grain_materials.hpp"

#include "scree/base/error.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

GrainMaterials::GrainMaterials(const Materials& materials) : names_{materials.names()}, seen_(names_.size(), 0) {}

std::vector<std::string> GrainMaterials::columns_of_walls(std::string_view prefix) const {
  std::vector<std::string> columns;
  for (std::size_t m = 0; m < names_.size(); ++m) {
    if (seen_[m] == 0) columns.push_back(std::string{prefix} + lower_snake(names_[m]));
  }
  return columns;
}

void GrainMaterials::save(StateWriter& out, std::string_view name) const { out.write(name, seen_); }

void GrainMaterials::load(const StateReader& in, std::string_view name) {
  const std::vector<std::uint64_t> seen = in.integers(name);
  if (seen.size() != seen_.size()) {
    throw Error{ErrorKind::io,
                "what an observer has seen of materials is of a scene with others; resume the scene it is of."};
  }
  seen_ = seen;
}

}  // namespace scree
