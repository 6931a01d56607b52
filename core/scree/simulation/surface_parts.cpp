// Parts of shapes that are made of points and triangles.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/heightfield.hpp"
#include "scree/geometry/mesh_examination.hpp"
#include "scree/geometry/mesh_file.hpp"
#include "scree/geometry/sphere_decomposition.hpp"
#include "scree/simulation/built_part.hpp"

namespace scree {
namespace {

/// A cluster beyond these is worth a warning: what feeds refuse.
constexpr double kVolumeLimit = 0.05;     // of the volume [1]
constexpr double kHausdorffLimit = 0.10;  // of the size [1]

std::vector<Vec3> to_points(const Options& options, const char* key) {
  const std::vector<double>& flat = options.numbers(key);
  if (flat.empty() || flat.size() % 3 != 0) {
    throw options.error(key, "needs three numbers a point, but has " + std::to_string(flat.size()) +
                                 "; write x, y, z of each point, one after the other");
  }
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return points;
}

/// Exactly one of an inline list and a file must be given.
bool from_file(const Options& options, const char* inline_key) {
  if (options.has(inline_key) == options.has("file")) {
    throw options.error(std::string{"a "} + options.type() + " needs either '" + inline_key + "' or 'file'");
  }
  return options.has("file");
}

/// What `read` reads of the file that 'file' names. @throws Error at the setting when it cannot be read.
template <class Read>
auto read_at(const Options& options, Read&& read) {
  try {
    return read(options.path("file"), options.number("scale"));
  } catch (const Error& problem) {
    throw Error{problem.kind(), options.location("file"), problem.what()};
  }
}

std::vector<Triangle> to_triangles(const Options& options, std::size_t vertices) {
  const std::vector<double>& flat = options.numbers("triangles");
  if (flat.size() % 3 != 0) {
    throw options.error("triangles", "needs three indices a triangle, but has " + std::to_string(flat.size()));
  }
  std::vector<Triangle> triangles(flat.size() / 3);
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    if (flat[i] < 0.0 || flat[i] >= static_cast<double>(vertices) || flat[i] != std::floor(flat[i])) {
      throw options.error("triangles", "names a vertex that does not exist in triangle " + std::to_string(i / 3) +
                                           "; " + "indices run from 0 to " + std::to_string(vertices - 1));
    }
    triangles[i / 3][i % 3] = static_cast<std::uint32_t>(flat[i]);
  }
  return triangles;
}

/// The words by which messages name a surface.
std::string surface_name(const Options& options, const PartContext& context) {
  const std::string file = options.has("file") ? " (" + options.path("file").filename().string() + ")" : "";
  return "the " + options.type() + file + " of shape '" + context.name + "'";
}

void warn(const Options& options, const PartContext& context, const std::string& sentence) {
  const Error placed{ErrorKind::usage, options.location(), surface_name(options, context) + " " + sentence};
  context.remarks.warnings.emplace_back(placed.what());
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += (all.empty() ? "" : "; also, ") + sentence;
  return all;
}

/// What a body that no force moves can do with: everything but triangles without an area.
void accept_as_wall(TriangleMesh& mesh, const Options& options, const PartContext& context) {
  MeshReport report = examine_mesh(mesh);
  if (report.degenerate_triangles > 0) {
    const std::size_t before = mesh.triangles.size();
    mesh = without_degenerate(mesh);
    warn(options, context,
         "has " + std::to_string(before - mesh.triangles.size()) + " triangles without an area, which are left out");
    if (mesh.triangles.empty()) throw options.error(surface_name(options, context) + " has no triangle with an area");
    report = examine_mesh(mesh);
  }
  if (report.is_solid()) return;
  const bool only_open = report.open_edges > 0 && report.problems().size() == 1;
  if (only_open) {
    context.remarks.notes.push_back(surface_name(options, context) + " is open at " +
                                    std::to_string(report.open_edges) +
                                    " edges, so that it has no inside and is touched from both sides");
  } else {
    warn(options, context,
         "is used as it is, since the body is fixed or moves as told, but: " + joined(report.problems()));
  }
}

/// The mesh as a part: the surface of a solid where a solid is needed.
BuiltPart part_of(TriangleMesh mesh, const Options& options, const PartContext& context) {
  BuiltPart part;
  if (check_mesh(mesh).inside_out) {
    mesh = turned_inside_out(mesh);
    warn(options, context, "is inside out (its normals point inwards) and is taken the right way round");
  }
  if (context.frame == ShapeFrame::principal) {
    const std::vector<std::string> problems = examine_mesh(mesh).problems();
    part.has_volume = problems.empty();
    part.why_not = surface_name(options, context) + " does not bound a solid: " + joined(problems);
  } else {
    accept_as_wall(mesh, options, context);
    part.has_volume = check_mesh(mesh).is_solid();
  }
  if (part.has_volume) part.mass = mesh_mass_properties(mesh);
  part.data.primitive.kind = ShapeKind::triangle_mesh;
  part.data.vertices = std::move(mesh.vertices);
  part.data.triangles = std::move(mesh.triangles);
  return part;
}

/// Puts spheres in the place of a hull or mesh; its mass stays.
void replace_by_spheres(BuiltPart& part, const SphereDecomposition& cluster, const Options& options,
                        const PartContext& context) {
  PrimitiveData data;
  data.primitive.kind = ShapeKind::sphere_cluster;
  data.spheres = cluster.spheres;
  part.data = std::move(data);
  char text[200];
  std::snprintf(text, sizeof text,
                "is %zu spheres to collision: volume %+.2f %%, Hausdorff distance %.2f %% of its size",
                cluster.spheres.size(), 100 * cluster.volume_error, 100 * cluster.hausdorff);
  if (std::abs(cluster.volume_error) > kVolumeLimit || cluster.hausdorff > kHausdorffLimit) {
    warn(options, context, text + std::string{"; allow more spheres"});
  } else {
    context.remarks.notes.push_back(surface_name(options, context) + " " + text);
  }
}

}  // namespace

BuiltPart build_hull(const Options& options, const PartContext& context) {
  BuiltPart part;
  const std::vector<Vec3> points =
      from_file(options, "points") ? read_at(options, read_mesh_file).vertices : to_points(options, "points");
  try {
    const ConvexHull hull = convex_hull(points);
    part.data.primitive.kind = ShapeKind::convex_hull;
    part.data.vertices = hull.vertices;
    part.data.faces = hull.faces;
    part.data.triangles = hull.triangles;
    part.mass = mesh_mass_properties(surface_of(hull));
    if (options.has("spheres")) {
      const SphereDecompositionOptions wanted{static_cast<int>(options.integer("spheres")), 0.0};
      replace_by_spheres(part, decompose_hull(hull, wanted), options, context);
    }
  } catch (const Error& problem) {
    throw options.error(problem.what());
  }
  return part;
}

BuiltPart build_mesh(const Options& options, const PartContext& context) {
  TriangleMesh mesh;
  if (from_file(options, "vertices")) {
    mesh = read_at(options, read_mesh_file);
  } else {
    if (!options.has("triangles")) throw options.error("a triangle_mesh with 'vertices' needs 'triangles' as well");
    mesh.vertices = to_points(options, "vertices");
    mesh.triangles = to_triangles(options, mesh.vertices.size());
  }
  BuiltPart part = part_of(std::move(mesh), options, context);
  if (!options.has("spheres")) return part;
  const TriangleMesh surface{part.data.vertices, part.data.triangles};
  const std::vector<std::string> problems = examine_mesh(surface).problems();
  if (!problems.empty()) {
    throw options.error("spheres", "need a solid to stand for, but " + surface_name(options, context) +
                                       " bounds none: " + joined(problems));
  }
  const SphereDecompositionOptions wanted{static_cast<int>(options.integer("spheres")), 0.0};
  replace_by_spheres(part, decompose_mesh(surface, wanted), options, context);
  return part;
}

BuiltPart build_heightfield(const Options& options, const PartContext& context) {
  HeightGrid grid;
  if (from_file(options, "heights")) {
    grid = read_at(options, read_height_file);
  } else {
    if (!options.has("columns")) throw options.error("a heightfield with 'heights' needs 'columns' as well");
    grid.heights = options.numbers("heights");
    grid.columns = static_cast<std::size_t>(options.integer("columns"));
    grid.rows = (grid.heights.size() + grid.columns - 1) / grid.columns;
  }
  grid.dx = options.number("spacing");
  grid.dy = options.has("spacing_y") ? options.number("spacing_y") : grid.dx;
  std::optional<double> base;
  if (options.has("base")) base = options.number("base");
  TriangleMesh mesh;
  try {
    mesh = heightfield_mesh(grid, base);
  } catch (const Error& problem) {
    throw options.error(problem.what());
  }
  return part_of(std::move(mesh), options, context);
}

BuiltPart build_cluster(const Options& options) {
  BuiltPart part;
  for (const Options& sphere : options.tables("spheres")) {
    part.data.spheres.push_back({sphere.vector("centre"), sphere.number("radius")});
  }
  if (part.data.spheres.empty()) throw options.error("spheres", "must hold at least one sphere");
  part.data.primitive.kind = ShapeKind::sphere_cluster;
  if (!options.has("solid")) {
    part.mass = cluster_mass_properties(part.data.spheres);
    return part;
  }
  const Options& solid = options.table("solid");
  const std::vector<double>& i = solid.numbers("inertia");
  const double half_trace = 0.5 * (i[0] + i[1] + i[2]);
  MassProperties centred;
  try {
    centred = to_mass_properties(
        {solid.number("volume"),
         {},
         Mat3{
             {half_trace - i[0], -i[3], -i[4]}, {-i[3], half_trace - i[1], -i[5]}, {-i[4], -i[5], half_trace - i[2]}}});
  } catch (const Error& problem) {
    throw solid.error(problem.what());
  }
  const Vec3& m = centred.inertia;
  if (!(m.x > 0.0 && m.y > 0.0 && m.z > 0.0))
    throw solid.error("inertia", "has a principal moment that is not positive");
  const double slack = 1.0 + 1e-9;
  if (m.x > slack * (m.y + m.z) || m.y > slack * (m.z + m.x) || m.z > slack * (m.x + m.y)) {
    throw solid.error("inertia", "is that of no body: a principal moment is larger than the sum of the other two");
  }
  part.mass = centred;
  part.mass.centre = solid.vector("centre");
  return part;
}

}  // namespace scree
