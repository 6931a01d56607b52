// GrainMaterials: which materials the grains of a run have had.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

class Materials;
class StateReader;
class StateWriter;

/// The materials of a scene, and which of them a dynamic body had. Which materials sources will add is not known at setup:
/// tables begin with a column for each material, and end without those of walls alone (Series::leave_out()).
class GrainMaterials {
 public:
  GrainMaterials() = default;
  explicit GrainMaterials(const Materials& materials);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t size() const { return names_.size(); }
  /// A dynamic body has it.
  void see(std::uint32_t material) { seen_[material] = 1; }
  /// The columns `prefix` and the material's name, in lower_snake, of materials that no dynamic body has had.
  [[nodiscard]] std::vector<std::string> columns_of_walls(std::string_view prefix) const;

  void save(StateWriter& out, std::string_view name) const;
  /// @throws Error (io) when the checkpoint is of a scene with other materials.
  void load(const StateReader& in, std::string_view name);

 private:
  std::vector<std::string> names_;
  std::vector<std::uint64_t> seen_;  // by material: 0 or 1
};

}  // namespace scree
