#include "conformance/narrow_phase_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace scree::test {
namespace {

PrimitiveData random_hull(ShapeKind kind, double size, RandomNumbers& random) {
  const Vec3 axes{random.uniform(0.4, 1.0), random.uniform(0.4, 1.0), random.uniform(0.4, 1.0)};
  std::vector<Vec3> points;
  const std::size_t count = 6 + random.below(11);
  while (points.size() < count) points.push_back(size * hadamard(axes, random.direction()));
  if (random.uniform(0, 1) < 0.3) {  // a block, which has parallel faces
    points.clear();
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) points.push_back(0.57 * size * hadamard(axes, {x, y, z}));
      }
    }
  }
  const ConvexHull hull = convex_hull(points);
  PrimitiveData data = mesh_data(hull.vertices, hull.triangles);
  data.primitive.kind = kind;
  if (kind == ShapeKind::convex_hull) data.faces = hull.faces;
  return data;
}

PrimitiveData random_cluster(double size, RandomNumbers& random) {
  std::vector<Sphere> spheres;
  const std::size_t count = 2 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    const double r = size * random.uniform(0.2, 0.5);
    spheres.push_back({random.direction() * random.uniform(0, size - r), r});
  }
  return cluster_data(spheres);
}

/// One of the 24 rotations that bring axes onto axes.
Quat quarter_turns(RandomNumbers& random) {
  const double c = std::sqrt(0.5);
  const std::array<Quat, 3> turns{Quat{c, c, 0, 0}, Quat{c, 0, c, 0}, Quat{c, 0, 0, c}};
  Quat q;
  for (int k = 0; k < 4; ++k) q = q * turns[random.below(3)];
  return normalized(q);
}

/// The poses of the two but for how far they are apart.
void orient(Meeting meeting, RandomNumbers& random, NarrowPhasePose& out) {
  out.pose_a = {random.in_cube(3.0), random.rotation()};
  out.pose_b.orientation = random.rotation();
  if (meeting == Meeting::parallel_faces || (meeting == Meeting::concentric && random.uniform(0, 1) < 0.5)) {
    out.pose_b.orientation = out.pose_a.orientation * quarter_turns(random);
  } else if (meeting == Meeting::parallel_edges) {
    const double half = random.uniform(0, std::numbers::pi);
    out.pose_b.orientation =
        out.pose_a.orientation * Quat{std::cos(half), 0, 0, std::sin(half)} * quarter_turns(random);
  }
}

void measure(NarrowPhasePose& out) {
  out.parts_a = reference_solids(out.a, out.pose_a);
  out.parts_b = reference_solids(out.b, out.pose_b);
  out.truth.clear();
  out.gap = std::numeric_limits<double>::infinity();
  for (const ReferenceSolid& a : out.parts_a) {
    for (const ReferenceSolid& b : out.parts_b) {
      out.truth.push_back(reference_gap(a, b));
      out.gap = std::min(out.gap, out.truth.back().gap);
    }
  }
}

/// Moves b along u, away from a, until the planes across u that support the two are `gap` apart.
void put_apart(NarrowPhasePose& out, const Vec3& u, double gap) {
  double now = std::numeric_limits<double>::infinity();
  for (const ReferenceSolid& a : reference_solids(out.a, out.pose_a)) {
    for (const ReferenceSolid& b : reference_solids(out.b, out.pose_b)) now = std::min(now, separation_along(a, b, u));
  }
  out.pose_b.position += (gap - now) * u;
}

/// The gap that a meeting asks for, in sizes.
double wanted_gap(Meeting meeting, bool shallow_only, RandomNumbers& random) {
  const double shallowest = shallow_only ? 2e-3 : 2e-2;
  if (meeting == Meeting::shallow) return -random.decades(1e-5, shallowest);
  if (meeting == Meeting::touching) return random.uniform(-1e-9, 1e-9);
  if (meeting == Meeting::apart) return random.decades(1e-5, 0.3);
  if (meeting == Meeting::deep && !shallow_only) return -random.uniform(0.02, 1.0);
  return random.uniform(-shallowest, 0.02);
}

Vec3 direction_of(Meeting meeting, RandomNumbers& random, const NarrowPhasePose& pose) {
  for (const auto& [data, placed, sign] : {std::tuple{&pose.a, &pose.pose_a, 1.0}, {&pose.b, &pose.pose_b, -1.0}}) {
    if (data->primitive.kind == ShapeKind::plane) return sign * rotate(placed->orientation, {0, 0, 1});
  }
  if (meeting != Meeting::parallel_faces) return random.direction();
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  return rotate(pose.pose_a.orientation, axes[random.below(3)]) * (random.uniform(0, 1) < 0.5 ? 1.0 : -1.0);
}

}  // namespace

PrimitiveData random_solid(ShapeKind kind, double size, RandomNumbers& random) {
  const Vec3 dimensions =
      size * Vec3{random.uniform(0.25, 0.57), random.uniform(0.25, 0.57), random.uniform(0.25, 0.57)};
  switch (kind) {
    case ShapeKind::sphere:
      return sphere_data(size);
    case ShapeKind::sphere_cluster:
      return random_cluster(size, random);
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh:
      return random_hull(kind, size, random);
    case ShapeKind::plane:
      return plane_data();
    case ShapeKind::ellipsoid:
      return primitive_data(kind, dimensions / 0.57);
    case ShapeKind::box:
    case ShapeKind::cylinder:
    case ShapeKind::capsule:
    case ShapeKind::cone:
      break;
  }
  return primitive_data(kind, dimensions);
}

const char* to_string(Meeting meeting) {
  constexpr std::array<const char*, kMeetings> names{"shallow",        "deep",           "touching",   "apart",
                                                     "parallel faces", "parallel edges", "concentric", "anywhere"};
  return names[static_cast<std::size_t>(meeting)];
}

NarrowPhasePose narrow_phase_pose(ShapeKind a, ShapeKind b, int trial) {
  RandomNumbers random{static_cast<std::uint64_t>(trial) * 1000 + static_cast<std::uint64_t>(a) * 10 +
                       static_cast<std::uint64_t>(b)};
  auto meeting = static_cast<Meeting>(trial % kMeetings);
  const bool unbounded = a == ShapeKind::plane || b == ShapeKind::plane;
  // How a mesh holds what is inside of it is its phase's own matter: a surface has no depth of its own.
  const bool shallow_only = unbounded || a == ShapeKind::triangle_mesh || b == ShapeKind::triangle_mesh;
  if (shallow_only && (meeting == Meeting::concentric || meeting == Meeting::anywhere)) meeting = Meeting::shallow;
  NarrowPhasePose out;
  const double size_a = random.decades(1e-4, 10.0);
  const double size_b = std::clamp(size_a * random.decades(0.2, 5.0), 1e-4, 10.0);
  out.a = random_solid(a, size_a, random);
  out.b = random_solid(b, size_b, random);
  out.size = a == ShapeKind::plane ? size_b : (b == ShapeKind::plane ? size_a : std::min(size_a, size_b));
  out.reach = out.size * random.uniform(0.01, 0.5);
  orient(meeting, random, out);
  out.pose_b.position = out.pose_a.position;
  if (meeting == Meeting::anywhere) {
    out.pose_b.position += random.in_cube(0.8 * (size_a + size_b));
  } else if (meeting != Meeting::concentric) {
    const double gap = wanted_gap(meeting, shallow_only, random) * out.size;
    put_apart(out, direction_of(meeting, random, out), gap);
    // In general they are farther apart than across that direction: once more, across the right one.
    measure(out);
    const auto nearest = std::ranges::min_element(out.truth, {}, &ReferenceGap::gap);
    if (meeting != Meeting::parallel_faces && nearest->gap > gap) put_apart(out, nearest->normal, gap);
  }
  measure(out);
  out.description = std::string{to_string(meeting)} + ", trial " + std::to_string(trial) + ", sizes " +
                    std::to_string(size_a) + " m and " + std::to_string(size_b) + " m, true gap " +
                    std::to_string(out.gap / out.size) + " sizes";
  return out;
}

}  // namespace scree::test
