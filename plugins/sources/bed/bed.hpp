// Source `bed`: spheres read from a file at the beginning.
#pragma once

#include <optional>

#include "bed_file.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/source.hpp"

namespace scree {

class ShapeSet;

/// Adds the spheres of a bed file at the first step, on request between a floor and four walls. Spheres of the same radius share a shape.
class BedSource final : public Source {
 public:
  explicit BedSource(const Options& options) : options_{options} {}
  static std::vector<Parameter> parameters();

  /// Reads the file, so that a bad one is refused before the run. @throws Error as read_bed() does.
  void setup(SceneServices& services) override;
  void emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// A floor at z = 0 and four walls at half the side of the box.
  void add_walls(const Vec3& offset, std::vector<NewBody>& out);

  Options options_;
  std::uint32_t material_ = 0;
  std::optional<std::uint32_t> wall_material_;
  double density_ = 0.0;  // [kg/m3]
  ShapeSet* shapes_ = nullptr;
  Bed bed_;  // emptied once it is in the scene
  bool done_ = false;
};

}  // namespace scree
