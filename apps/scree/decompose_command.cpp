// scree decompose FILE: a solid as a cluster of spheres, its errors, a picture, and the cluster as a shape for scenes.

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "decompose_picture.hpp"
#include "decompose_subject.hpp"
#include "say.hpp"
#include "scree/base/error.hpp"
#include "scree/geometry/decomposition_cache.hpp"
#include "scree/results/output_file.hpp"

namespace scree {
namespace {

struct DecomposeOptions {
  SubjectChoice subject;
  int spheres = 32;
  double enough = 0.0;      ///< [1]
  double density = 1000.0;  ///< [kg/m3]
  std::string name;         ///< of the new shape; empty: as the subject
  std::filesystem::path output;
  std::filesystem::path picture;
  bool no_cache = false;
};

/// The cluster as a shape of a scene, with the mass and inertia of the solid.
std::string as_shape(const std::string& name, const DecomposeSubject& subject, const SphereDecomposition& cluster) {
  const Mat3 i = inertia_matrix(subject.mass);
  const Vec3& c = subject.mass.centre;
  std::string text = fmt::format(
      "# {} spheres for {}.\n# Volume {:+.3f} %, Hausdorff distance {:.2f} % of the size.\n[shape.{}]\n"
      "type = \"sphere_cluster\"\n"
      "solid = {{ volume = {:.17g}, centre = [{:.17g}, {:.17g}, {:.17g}], inertia = [{:.17g}, {:.17g}, {:.17g}, "
      "{:.17g}, "
      "{:.17g}, {:.17g}] }}\nspheres = [\n",
      cluster.spheres.size(), subject.what, 100 * cluster.volume_error, 100 * cluster.hausdorff, name,
      subject.mass.volume, c.x, c.y, c.z, i.row0.x, i.row1.y, i.row2.z, i.row0.y, i.row0.z, i.row1.z);
  for (const Sphere& s : cluster.spheres) {
    text += fmt::format("  {{ centre = [{:.17g}, {:.17g}, {:.17g}], radius = {:.17g} }},\n", s.centre.x, s.centre.y,
                        s.centre.z, s.radius);
  }
  return text + "]\n";
}

/// `text` as a bare key of TOML: what is no letter, digit, dash or underscore becomes an underscore.
std::string as_key(std::string text) {
  for (char& c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (!plain) c = '_';
  }
  return text.empty() ? "cluster" : text;
}

void print(const DecomposeSubject& subject, const SphereDecomposition& cluster, double density) {
  const MassProperties& m = subject.mass;
  say("solid                {}\n", subject.what);
  say("volume               {:.6g} m3\n", m.volume);
  say("mass                 {:.6g} kg at {:.6g} kg/m3\n", density * m.volume, density);
  say("centre of mass       {:.6g} {:.6g} {:.6g} m\n", m.centre.x, m.centre.y, m.centre.z);
  say("principal inertia    {:.6g} {:.6g} {:.6g} kg m2\n", density * m.inertia.x, density * m.inertia.y,
      density * m.inertia.z);
  say("spheres              {}\n", cluster.spheres.size());
  say("volume error         {:+.4f} %\n", 100 * cluster.volume_error);
  say("hausdorff distance   {:.3f} % of the size, {:.3f} % of the diameter of the sphere of equal volume\n",
      100 * cluster.hausdorff, 100 * cluster.hausdorff_of_equivalent);
}

void decompose(const DecomposeOptions& options) {
  const std::string ending = options.picture.extension().string();
  if (!options.picture.empty() && ending != ".svg" && ending != ".png") {
    throw Error{ErrorKind::usage, "the picture '" + options.picture.string() + "' must end in .svg or .png"};
  }
  DecompositionCache& cache = DecompositionCache::of_program();
  if (options.no_cache) cache.keep_in({});
  const DecomposeSubject subject = find_subject(options.subject);
  const SphereDecomposition cluster = subject.decompose({options.spheres, options.enough});
  print(subject, cluster, options.density);
  if (cache.counts().read > 0) say("read from the cache of an earlier run\n");
  if (!options.output.empty()) {
    const std::string name = as_key(options.name.empty() ? subject.name : options.name);
    replace_file(options.output, as_shape(name, subject, cluster));
    say("shape '{}' in {}: include = [\"{}\"]\n", name, options.output.string(), options.output.filename().string());
  }
  if (!options.picture.empty()) {
    const std::string note = fmt::format("{} spheres: volume {:+.2f} %, Hausdorff distance {:.2f} % of the size",
                                         cluster.spheres.size(), 100 * cluster.volume_error, 100 * cluster.hausdorff);
    draw_decomposition(options.picture, subject.name, note, subject.surface, cluster.spheres);
    say("picture in {}\n", options.picture.string());
  }
}

}  // namespace

void add_decompose_command(CLI::App& app, int& /*exit_code*/) {
  const auto options = std::make_shared<DecomposeOptions>();
  CLI::App* command = app.add_subcommand("decompose", "Let spheres stand for a solid, and say how well they do");
  command->add_option("file", options->subject.file, "A mesh (.stl, .obj, .ply), or a scene (.toml) with --shape")
      ->required()
      ->type_name("FILE");
  command->add_option("--shape", options->subject.shape, "The shape of the scene")->type_name("NAME");
  command->add_option("--spheres", options->spheres, "So many spheres [32]")
      ->check(CLI::Range(1, 1000))
      ->type_name("K");
  command
      ->add_option(
          "--enough", options->enough,
          "Take the first of 1, 2, 4, ... spheres whose Hausdorff distance is at most this part of the diameter of "
          "the sphere of equal volume")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("X");
  command->add_option("--scale", options->subject.scale, "Factor on the coordinates of a mesh file, 1e-3 for mm [1]")
      ->type_name("X");
  command->add_flag("--hull", options->subject.hull, "Take the convex hull of the mesh");
  command->add_option("--density", options->density, "For the mass that is printed, in kg/m3 [1000]")
      ->check(CLI::PositiveNumber)
      ->type_name("X");
  command->add_option("-o,--output", options->output, "Write the cluster as a shape that a scene can include")
      ->type_name("FILE.toml");
  command->add_option("--name", options->name, "Name of that shape [that of the file or shape]")->type_name("NAME");
  command->add_option("--picture", options->picture, "Draw solid and spheres along the three axes, .svg or .png")
      ->type_name("FILE");
  command->add_flag("--no-cache", options->no_cache, "Compute anew, even when SCREE_CACHE names a folder");
  command->final_callback([options] { decompose(*options); });
}

}  // namespace scree
