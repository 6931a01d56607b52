#include "vtk_observer.hpp"

#include <algorithm>
#include <cmath>

#include "particle_arrays.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

VtkObserver::VtkObserver(const Options& options)
    : options_{options},
      interval_{options.number("interval")},
      walls_{options.boolean("walls")},
      spheres_{options.boolean("spheres")},
      precision_{options.text("precision") == "double" ? Precision::double_precision : Precision::single_precision},
      surface_options_{static_cast<int>(options.integer("segments")), options.number("plane_size")} {}

std::vector<Parameter> VtkObserver::parameters() {
  std::vector<Parameter> list{
      Parameter::number("interval", "s", "simulated time between two frames; rounded to whole steps")
          .above(0.0)
          .by_default(0.02),
      Parameter::boolean("walls", "write the surfaces of fixed and kinematic bodies").by_default(true),
      Parameter::boolean("spheres", "write a second series with one point per sphere of every particle")
          .by_default(false),
      Parameter::choice("precision", {"single", "double"}, "of floating-point arrays").by_default("double"),
      Parameter::integer("segments", "of a full circle of a wall's surface").at_least(8).at_most(512).by_default(64),
      Parameter::number("plane_size", "m", "edge of the square that stands for an unbounded plane")
          .above(0.0)
          .by_default(1.0),
  };
  for (Parameter& parameter : CutView::parameters()) list.push_back(std::move(parameter));
  return list;
}

void VtkObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  const auto stem = [name = services.part_name()](const char* plain) { return result_stem(plain, "vtk", name); };
  stems_ = {stem("run"), stem("particles"), stem("walls"), stem("spheres")};
  claim_results(services, stems_.run, {".pvd"});
  claim_results(services, stems_.particles, {"_*.vtp"});
  if (walls_) claim_results(services, stems_.walls, {"_*.vtp"});
  if (spheres_) claim_results(services, stems_.spheres, {"_*.vtp", ".pvd"});
  results_ = results;
  services.show_all_attributes();
  cut_.setup(options_, services);
  shapes_ = &services.shapes();
  materials_ = &services.materials();
  steps_between_ = static_cast<std::uint64_t>(std::max(1.0, std::round(interval_ / services.time_step())));
}

void VtkObserver::observe(const Observation& now, Attributes&) {
  if (!results_.empty() && now.step % steps_between_ == 0) write_frame(now);
}

void VtkObserver::finish(const Observation& last) {
  if (!results_.empty() && last.step != last_step_) write_frame(last);
}

void VtkObserver::write_frame(const Observation& now) {
  last_step_ = now.step;
  const std::string particles = numbered_file(stems_.particles, now.step);
  write_particles(now, particles);
  frames_.add(now.time, 0, particles);
  if (walls_) {
    write_walls(now);
    if (!wall_file_.empty()) frames_.add(now.time, 1, wall_file_);
  }
  frames_.write(results_ / (stems_.run + ".pvd"));
  if (!spheres_) return;
  const std::string balls = numbered_file(stems_.spheres, now.step);
  write_spheres(now, balls);
  sphere_frames_.add(now.time, 0, balls);
  sphere_frames_.write(results_ / (stems_.spheres + ".pvd"));
}

std::vector<TextArray> VtkObserver::texts() const {
  TextArray kinds{"type_names", {}};
  for (std::size_t kind = 0; kind < kShapeKindCount; ++kind) {
    kinds.texts.emplace_back(to_string(static_cast<ShapeKind>(kind)));
  }
  kinds.texts.emplace_back("compound");
  return {{"material_names", materials_->names()}, kinds};
}

std::vector<BodyIndex> VtkObserver::shown_particles(const BodyView& bodies) const {
  std::vector<BodyIndex> which;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (cut_.is_wall(bodies, i) || cut_.hides(bodies.id[i])) continue;
    if (cut_.keeps(bodies.position[i], shapes_->shapes()[bodies.shape[i]].bounding_radius)) which.push_back(i);
  }
  return which;
}

void VtkObserver::write_particles(const Observation& now, const std::string& file) const {
  PolyData data = particle_data(now.bodies, shown_particles(now.bodies), *shapes_, precision_);
  data.time = now.time;
  data.texts = texts();
  write_vtp(data, results_ / file);
}

void VtkObserver::write_spheres(const Observation& now, const std::string& file) const {
  PolyData data = sphere_data(now.bodies, shown_particles(now.bodies), *shapes_, precision_);
  data.time = now.time;
  data.texts = texts();
  write_vtp(data, results_ / file);
}

bool VtkObserver::walls_moved(const BodyView& bodies) {
  std::vector<Pose> poses;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (cut_.is_wall(bodies, i)) poses.push_back({bodies.position[i], bodies.orientation[i]});
  }
  if (poses == wall_poses_) return false;
  wall_poses_ = std::move(poses);
  return true;
}

void VtkObserver::write_walls(const Observation& now) {
  const BodyView& bodies = now.bodies;
  if (!walls_moved(bodies)) return;
  Surface surface;
  std::vector<std::uint64_t> owner;
  std::vector<std::int32_t> material;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (!cut_.is_wall(bodies, i) || cut_.hides(bodies.id[i])) continue;
    const std::size_t first = surface.triangles.size();
    append_surface(*shapes_, shapes_->shapes()[bodies.shape[i]], {bodies.position[i], bodies.orientation[i]},
                   surface_options_, surface);
    cut_.clip(surface, first);
    owner.resize(surface.triangles.size(), bodies.id[i]);
    material.resize(surface.triangles.size(), static_cast<std::int32_t>(bodies.material[i]));
  }
  if (surface.triangles.empty()) return;
  drop_unused_points(surface);
  PolyData data;
  data.time = now.time;
  data.texts = texts();
  data.point_count = surface.points.size();
  data.points = to_array("Points", std::span<const Vec3>{surface.points}, precision_);
  data.triangles = std::move(surface.triangles);
  data.cell_data = {to_array("id", owner), to_array("material", material)};
  wall_file_ = numbered_file(stems_.walls, now.step);
  write_vtp(data, results_ / wall_file_);
}

void VtkObserver::save(StateWriter& out) const {
  frames_.save(out, "frames");
  sphere_frames_.save(out, "sphere_frames");
}

void VtkObserver::load(const StateReader& in) {
  frames_.load(in, "frames", results_);
  sphere_frames_.load(in, "sphere_frames", results_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::VtkObserver>("vtk", "Particles and walls as VTK files, for ParaView.",
                                                   scree::VtkObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("vtk", "1.0.0", &list)};
