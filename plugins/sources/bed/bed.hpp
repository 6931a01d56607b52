// Source `bed`: spheres read from a file at the beginning.
#pragma once

#include "bed_file.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/source.hpp"

namespace scree {

class ShapeSet;

/// Adds the spheres of a bed file at the first step. Spheres of the same radius share a shape.
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
  Options options_;
  std::uint32_t material_ = 0;
  double density_ = 0.0;  // [kg/m3]
  ShapeSet* shapes_ = nullptr;
  Bed bed_;  // emptied once it is in the scene
  bool done_ = false;
};

}  // namespace scree
