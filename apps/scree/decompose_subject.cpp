#include "decompose_subject.hpp"

#include <utility>

#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/base/error.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/mesh_examination.hpp"
#include "scree/geometry/mesh_file.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {
namespace {

DecomposeSubject from_hull(const std::vector<Vec3>& points) {
  const ConvexHull hull = convex_hull(points);
  DecomposeSubject subject;
  subject.surface = surface_of(hull);
  subject.mass = mesh_mass_properties(subject.surface);
  subject.decompose = [hull](const SphereDecompositionOptions& options) { return decompose_hull(hull, options); };
  return subject;
}

DecomposeSubject from_mesh(TriangleMesh mesh, const std::string& what) {
  if (check_mesh(mesh).inside_out) {
    warn(what + " is inside out (its normals point inwards) and is taken the right way round");
    mesh = turned_inside_out(std::move(mesh));
  }
  std::string problems;
  for (const std::string& problem : examine_mesh(mesh).problems())
    problems += (problems.empty() ? "" : "; also, ") + problem;
  if (!problems.empty()) {
    throw Error{ErrorKind::usage,
                what + " does not bound a solid: " + problems + "; or take its convex hull with --hull"};
  }
  DecomposeSubject subject;
  subject.mass = mesh_mass_properties(mesh);
  subject.surface = mesh;
  subject.decompose = [mesh](const SphereDecompositionOptions& options) { return decompose_mesh(mesh, options); };
  return subject;
}

DecomposeSubject from_box(const Vec3& half) {
  return {"", "", box_mesh(half), box_mass_properties(half),
          [half](const SphereDecompositionOptions& options) { return decompose_box(half, options); }};
}

DecomposeSubject from_cylinder(double radius, double half) {
  return {"", "", cylinder_mesh(radius, half, 96), cylinder_mass_properties(radius, half),
          [=](const SphereDecompositionOptions& options) { return decompose_cylinder(radius, half, options); }};
}

const NamedOptions& find_shape(const SceneModel& model, const SubjectChoice& choice) {
  std::vector<std::string> names;
  for (const NamedOptions& shape : model.shape_options) {
    if (shape.name == choice.shape) return shape;
    names.push_back(shape.name);
  }
  if (choice.shape.empty() && names.size() == 1) return model.shape_options.front();
  if (choice.shape.empty()) {
    throw Error{ErrorKind::usage,
                "say which shape of " + choice.file.string() + " with --shape; it has " + list_of(names)};
  }
  throw Error{ErrorKind::usage, choice.file.string() + " has no shape '" + choice.shape + "'; it has " +
                                    list_of(names) + suggestion(choice.shape, names)};
}

DecomposeSubject from_scene(const SubjectChoice& choice) {
  const SceneModel model = read_scene_model(SceneDocument::load(scene_file(choice.file)));
  const NamedOptions& shape = find_shape(model, choice);
  ShapeRemarks remarks;
  const ShapeData data = build_shape(shape.name, shape.options, ShapeFrame::as_written, remarks);
  const PrimitiveData& part = data.primitives.front();
  const Vec3& size = part.primitive.size;
  const std::string what = "shape '" + shape.name + "' of " + choice.file.string();
  DecomposeSubject subject;
  const ShapeKind kind = part.primitive.kind;
  const bool mesh = kind == ShapeKind::triangle_mesh, hull = kind == ShapeKind::convex_hull;
  if (data.primitives.size() == 1 && (hull || (mesh && choice.hull))) {
    subject = from_hull(part.vertices);
  } else if (data.primitives.size() == 1 && mesh) {
    subject = from_mesh({part.vertices, part.triangles}, what);
  } else if (data.primitives.size() == 1 && kind == ShapeKind::box) {
    subject = from_box(size);
  } else if (data.primitives.size() == 1 && kind == ShapeKind::cylinder && !part.primitive.hollow) {
    subject = from_cylinder(size.x, size.y);
  } else {
    throw shape.options.error(
        what + " is a " + shape.options.type() +
        "; spheres can stand for a solid box, cylinder, convex_hull, triangle_mesh or heightfield");
  }
  subject.name = shape.name;
  subject.what = what + ", a " + shape.options.type();
  return subject;
}

}  // namespace

DecomposeSubject find_subject(const SubjectChoice& choice) {
  if (choice.file.extension() == ".toml" || std::filesystem::is_directory(choice.file)) return from_scene(choice);
  const TriangleMesh mesh = read_mesh_file(choice.file, choice.scale);
  const std::string file = choice.file.filename().string();
  DecomposeSubject subject = choice.hull ? from_hull(mesh.vertices) : from_mesh(mesh, "the mesh file '" + file + "'");
  subject.name = choice.file.stem().string();
  subject.what = (choice.hull ? "the convex hull of " : "") + file + ", " +
                 std::to_string(subject.surface.triangles.size()) + " triangles";
  return subject;
}

}  // namespace scree
