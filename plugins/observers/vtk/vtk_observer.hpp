// VtkObserver: particles and walls as series of VTK files, for ParaView and other readers.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/observer.hpp"
#include "vtp/cut_view.hpp"
#include "vtp/file_series.hpp"
#include "vtp/poly_data.hpp"
#include "vtp/surface.hpp"

namespace scree {

class Materials;

/// Writes particles_*.vtp (dynamic bodies), walls_*.vtp (fixed and kinematic ones, when they moved), optionally
/// spheres_*.vtp, and the collections run.pvd and spheres.pvd. An observer with a name puts it behind each stem:
/// particles_NAME_*.vtp, run_NAME.pvd.
class VtkObserver final : public Observer {
 public:
  explicit VtkObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;
  [[nodiscard]] int version() const override { return 2; }

 private:
  /// Beginnings of the names of files.
  struct Stems {
    std::string run, particles, walls, spheres;
  };

  void write_frame(const Observation& now);
  void write_particles(const Observation& now, const std::string& file) const;
  void write_spheres(const Observation& now, const std::string& file) const;
  void write_walls(const Observation& now);
  [[nodiscard]] std::vector<BodyIndex> shown_particles(const BodyView& bodies) const;
  [[nodiscard]] bool walls_moved(const BodyView& bodies);
  [[nodiscard]] std::vector<TextArray> texts() const;

  Options options_;
  CutView cut_;
  double interval_;  ///< [s]
  bool walls_;
  bool spheres_;
  Precision precision_;
  SurfaceOptions surface_options_;

  std::filesystem::path results_;
  Stems stems_{"run", "particles", "walls", "spheres"};
  const ShapeSet* shapes_ = nullptr;
  const Materials* materials_ = nullptr;
  std::uint64_t steps_between_ = 1;
  std::uint64_t last_step_ = ~std::uint64_t{0};  ///< written last
  std::vector<Pose> wall_poses_;                 ///< when they were written last
  std::string wall_file_;
  FileSeries frames_;  ///< part 0: particles, 1: walls
  FileSeries sphere_frames_;
};

}  // namespace scree
