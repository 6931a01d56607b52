#include "scan_family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/scan_table.hpp"
#include "scree/geometry/sphere_decomposition.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

/// Bad rows that the log names one by one; a count stands for the rest.
constexpr std::size_t kNamedRows = 20;

/// What became of a row: a template, or the reason why not.
struct Fitted {
  std::optional<ParticleTemplate> unit;
  std::string reason;
};

/// The prism's cluster; its mass and inertia are the table's.
Fitted fit(const ScannedParticle& particle, int max_spheres) {
  SphereDecomposition cluster;
  try {
    const ConvexHull prism = convex_hull(particle.corners());
    cluster = decompose_hull(prism, {max_spheres, kEnoughHausdorff});
    if (std::abs(cluster.volume_error) > kVolumeLimit) cluster = decompose_hull(prism, {max_spheres, 0.0});
  } catch (const Error& problem) {
    return {{}, problem.what()};
  }
  if (std::abs(cluster.volume_error) > kVolumeLimit || cluster.hausdorff > kHausdorffLimit) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "%zu spheres come within %.1f %% of its volume and %.1f %% of its largest extent only, but %g %% and "
                  "%g %% are needed",
                  cluster.spheres.size(), 100 * std::abs(cluster.volume_error), 100 * cluster.hausdorff,
                  100 * kVolumeLimit, 100 * kHausdorffLimit);
    return {{}, text};
  }
  const double density = particle.mass / particle.volume();
  ParticleTemplate unit =
      normalised(std::move(cluster.spheres), {particle.volume(), {}, particle.inertia / density, {}});
  unit.volume_error = cluster.volume_error;
  unit.hausdorff = cluster.hausdorff;
  unit.measured = {equivalent_diameter(particle.volume()), density};
  return {std::move(unit), {}};
}

std::vector<Fitted> fit_all(const std::vector<ScannedParticle>& particles, int max_spheres, const Executor& executor) {
  std::vector<Fitted> fitted(particles.size());
  executor.for_chunks(particles.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) fitted[i] = fit(particles[i], max_spheres);
  });
  return fitted;
}

std::string place_of(const Options& shape, int line) {
  return shape.path("file").string() + ":" + std::to_string(line);
}

/// Says which rows are bad, or ends with the first. `bad` in order of line.
void tell(const std::map<int, std::string>& bad, const Options& shape, const std::string& family,
          const SceneServices& services) {
  if (bad.empty()) return;
  if (shape.text("bad_rows") == "refuse") {
    throw shape.error("file", "of family '" + family + "' has " + std::to_string(bad.size()) +
                                  (bad.size() == 1 ? " bad row: " : " bad rows; the first is ") +
                                  place_of(shape, bad.begin()->first) + ": " + bad.begin()->second +
                                  "; correct them, or set bad_rows = \"skip\"");
  }
  std::size_t named = 0;
  for (const auto& [line, reason] : bad) {
    if (named++ == kNamedRows) break;
    services.log("family '" + family + "': row skipped, " + place_of(shape, line) + ": " + reason);
  }
  if (bad.size() > kNamedRows) {
    services.log("family '" + family + "': and " + std::to_string(bad.size() - kNamedRows) + " rows more");
  }
}

}  // namespace

Variant scan_shape() {
  return {"scan",
          "Scanned particles: prisms of measured outlines, with measured mass and inertia.",
          {Parameter::path("file", "table: material, particle, thickness, mass, I1 I2 I3, N, x..., y... in mm and mg"),
           Parameter::integer("material_id", "only rows of this material id; all when left out").optional(),
           Parameter::choice("bad_rows", {"refuse", "skip"}, "a bad row ends the run, or is named and left out")
               .by_default("refuse"),
           Parameter::integer("max_spheres", "most spheres that collision may see of a particle")
               .at_least(1)
               .at_most(128)
               .by_default(32)}};
}

TemplateSet make_scan_templates(const Options& shape, const std::string& family, SceneServices& services) {
  ScanTable table;
  try {
    table = read_scan_file(shape.path("file"));
  } catch (const Error& problem) {
    throw Error{problem.kind(), shape.location("file"), problem.what()};
  }
  TemplateSet set;
  std::map<int, std::string> bad;
  for (const RefusedRow& row : table.refused) bad[row.line] = row.reason;
  tell(shape.text("bad_rows") == "refuse" ? bad : std::map<int, std::string>{}, shape, family,
       services);  // before the work
  if (shape.has("material_id")) {
    set.rows.of_other_materials = std::erase_if(
        table.particles, [&](const ScannedParticle& p) { return p.material != shape.integer("material_id"); });
  }
  const std::vector<Fitted> fitted =
      fit_all(table.particles, static_cast<int>(shape.integer("max_spheres")), services.executor());
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    if (fitted[i].unit) set.templates.push_back(*fitted[i].unit);
    if (!fitted[i].unit) bad[table.particles[i].line] = fitted[i].reason;
  }
  tell(bad, shape, family, services);
  set.rows.used = set.templates.size();
  set.rows.refused = bad.size();
  if (!set.templates.empty()) return set;
  const std::string first =
      bad.empty() ? "" : "; the first bad one is " + place_of(shape, bad.begin()->first) + ": " + bad.begin()->second;
  throw shape.error("file", "of family '" + family + "' has no row to use: " + std::to_string(bad.size()) +
                                " are bad and " + std::to_string(set.rows.of_other_materials) +
                                " are of other materials" + first);
}

}  // namespace scree
