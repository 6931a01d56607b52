// How shapes travel through checkpoints: records are flattened to numbers, one row each.
#include <array>

#include "scree/base/error.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

constexpr std::size_t kPrimitiveIntegers = 12;
constexpr std::size_t kPrimitiveDoubles = 11;
constexpr std::size_t kShapeDoubles = 13;

void put(std::vector<double>& out, const Vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); }
void put(std::vector<double>& out, const Pose& p) {
  put(out, p.position);
  out.insert(out.end(), {p.orientation.w, p.orientation.x, p.orientation.y, p.orientation.z});
}

Vec3 vector_at(const double* d) { return {d[0], d[1], d[2]}; }
Pose pose_at(const double* d) { return {vector_at(d), {d[3], d[4], d[5], d[6]}}; }

void require_size(std::size_t have, std::size_t want) {
  if (have != want)
    throw Error{ErrorKind::io, "the checkpoint's tables of shapes differ in length; the file is damaged"};
}

}  // namespace

void ShapeSet::save(StateWriter& out) const {
  std::vector<std::uint64_t> integers;
  std::vector<double> doubles;
  for (const Primitive& p : primitives_) {
    integers.insert(integers.end(), {static_cast<std::uint64_t>(p.kind), p.hollow, p.collides, p.first_sphere,
                                     p.sphere_count, p.first_vertex, p.vertex_count, p.first_face, p.face_count,
                                     p.first_triangle, p.triangle_count, 0});
    put(doubles, p.local);
    put(doubles, p.size);
    doubles.push_back(p.bounding_radius);
  }
  out.write("primitive_integers", std::span<const std::uint64_t>{integers});
  out.write("primitive_doubles", std::span<const double>{doubles});
  integers.clear();
  doubles.clear();
  std::string names;
  for (std::uint32_t k = 0; k < shapes_.size(); ++k) {
    const Shape& s = shapes_[k];
    integers.insert(integers.end(), {s.first_primitive, s.primitive_count});
    doubles.push_back(s.volume);
    put(doubles, s.unit_inertia);
    put(doubles, body_to_shape(k));
    doubles.insert(doubles.end(), {s.bounding_radius, s.equivalent_radius});
    names.append(name(k)) += '\n';
  }
  out.write("shape_integers", std::span<const std::uint64_t>{integers});
  out.write("shape_doubles", std::span<const double>{doubles});
  out.write("names", std::string_view{names});
  doubles.clear();
  for (const Sphere& s : spheres_) {
    put(doubles, s.centre);
    doubles.push_back(s.radius);
  }
  out.write("spheres", std::span<const double>{doubles});
  doubles.clear();
  for (const Face& f : faces_) {
    put(doubles, f.normal);
    doubles.push_back(f.offset);
  }
  out.write("faces", std::span<const double>{doubles});
  out.write("vertices", std::span<const Vec3>{vertices_});
  integers.clear();
  for (const Triangle& t : triangles_) integers.insert(integers.end(), t.begin(), t.end());
  out.write("triangles", std::span<const std::uint64_t>{integers});
}

void ShapeSet::load(const StateReader& in) {
  const std::vector<std::uint64_t> pi = in.integers("primitive_integers");
  const std::vector<double> pd = in.doubles("primitive_doubles");
  primitives_.resize(pi.size() / kPrimitiveIntegers);
  require_size(pd.size(), primitives_.size() * kPrimitiveDoubles);
  for (std::size_t k = 0; k < primitives_.size(); ++k) {
    const std::uint64_t* i = pi.data() + k * kPrimitiveIntegers;
    const double* d = pd.data() + k * kPrimitiveDoubles;
    const auto index = [&](std::size_t c) { return static_cast<std::uint32_t>(i[c]); };
    if (i[0] >= kShapeKindCount) throw Error{ErrorKind::io, "the checkpoint holds an unknown kind of shape"};
    primitives_[k] = {static_cast<ShapeKind>(i[0]),
                      i[1] != 0,
                      i[2] != 0,
                      pose_at(d),
                      vector_at(d + 7),
                      index(3),
                      index(4),
                      index(5),
                      index(6),
                      index(7),
                      index(8),
                      index(9),
                      index(10),
                      d[10]};
  }
  const std::vector<std::uint64_t> si = in.integers("shape_integers");
  const std::vector<double> sd = in.doubles("shape_doubles");
  const std::string names = in.text("names");
  shapes_.resize(si.size() / 2);
  require_size(sd.size(), shapes_.size() * kShapeDoubles);
  std::size_t at = 0;
  written_.clear();
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const std::size_t end = names.find('\n', at);
    if (end == std::string::npos) require_size(k, shapes_.size());
    const double* d = sd.data() + k * kShapeDoubles;
    shapes_[k] = {static_cast<std::uint32_t>(si[2 * k]),
                  static_cast<std::uint32_t>(si[2 * k + 1]),
                  d[0],
                  vector_at(d + 1),
                  d[11],
                  d[12]};
    write_down(static_cast<std::uint32_t>(k), std::string_view{names}.substr(at, end - at), pose_at(d + 4));
    at = end + 1;
  }
  const std::vector<double> spheres = in.doubles("spheres");
  spheres_.resize(spheres.size() / 4);
  for (std::size_t k = 0; k < spheres_.size(); ++k) spheres_[k] = {vector_at(&spheres[4 * k]), spheres[4 * k + 3]};
  const std::vector<double> faces = in.doubles("faces");
  faces_.resize(faces.size() / 4);
  for (std::size_t k = 0; k < faces_.size(); ++k) faces_[k] = {vector_at(&faces[4 * k]), faces[4 * k + 3]};
  vertices_ = in.vectors("vertices");
  const std::vector<std::uint64_t> triangles = in.integers("triangles");
  triangles_.resize(triangles.size() / 3);
  for (std::size_t k = 0; k < 3 * triangles_.size(); ++k) {
    triangles_[k / 3][k % 3] = static_cast<std::uint32_t>(triangles[k]);
  }
}

}  // namespace scree
