#include "scree/geometry/mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/base/require.hpp"
#include "scree/geometry/sphere_union.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDiagonalTolerance = 1e-9;  // of the trace; rounding of a symmetrical cluster stays below

double trace(const Mat3& m) { return m.row0.x + m.row1.y + m.row2.z; }

Mat3 scaled(const Mat3& m, double s) { return {s * m.row0, s * m.row1, s * m.row2}; }

Mat3 outer(const Vec3& a, const Vec3& b) { return {a.x * b, a.y * b, a.z * b}; }

/// I = trace(S) 1 - S; the same map takes I back to 2 S when the trace is halved.
Mat3 inertia_of_second_moments(const Mat3& s) {
  const double t = trace(s);
  return Mat3::diagonal({t, t, t}) + scaled(s, -1.0);
}

Quat to_quat(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q{r};
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  return {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

/// Chooses the order and signs of the eigenvectors that turn the frame least, so that the answer is unique.
void arrange_axes(Eigen::Matrix3d& axes, Eigen::Vector3d& values) {
  std::array<int, 3> order{0, 1, 2}, best = order;
  double best_score = -1.0;
  do {
    const double score = std::abs(axes(0, order[0])) + std::abs(axes(1, order[1])) + std::abs(axes(2, order[2]));
    if (score > best_score + 1e-12) {
      best_score = score;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));

  Eigen::Matrix3d arranged;
  Eigen::Vector3d arranged_values;
  int weakest = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = axes.col(best[static_cast<std::size_t>(k)]);
    arranged.col(k) = axis(k) < 0.0 ? Eigen::Vector3d{-axis} : axis;
    arranged_values(k) = values(best[static_cast<std::size_t>(k)]);
    if (arranged(k, k) < arranged(weakest, weakest)) weakest = k;
  }
  if (arranged.determinant() < 0.0) arranged.col(weakest) *= -1.0;
  axes = arranged;
  values = arranged_values;
}

void diagonalise(const Mat3& inertia, MassProperties& out) {
  const double off = std::max({std::abs(inertia.row0.y), std::abs(inertia.row0.z), std::abs(inertia.row1.z)});
  if (off <= kDiagonalTolerance * trace(inertia)) {
    out.inertia = {inertia.row0.x, inertia.row1.y, inertia.row2.z};
    out.orientation = {};
    return;
  }
  Eigen::Matrix3d m;
  m << inertia.row0.x, inertia.row0.y, inertia.row0.z,  //
      inertia.row0.y, inertia.row1.y, inertia.row1.z,   //
      inertia.row0.z, inertia.row1.z, inertia.row2.z;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{m};
  Eigen::Matrix3d axes = solver.eigenvectors();
  Eigen::Vector3d values = solver.eigenvalues();
  arrange_axes(axes, values);
  out.inertia = {values(0), values(1), values(2)};
  out.orientation = to_quat(axes);
}

}  // namespace

VolumeMoments& VolumeMoments::operator+=(const VolumeMoments& other) {
  volume += other.volume;
  first += other.first;
  second = second + other.second;
  return *this;
}

MassProperties to_mass_properties(const VolumeMoments& moments) {
  if (!(moments.volume > 0.0) || !std::isfinite(moments.volume)) {
    throw Error{ErrorKind::usage, "a solid must have a positive, finite volume, but this one has " +
                                      std::to_string(moments.volume) + " m^3; check its sizes"};
  }
  MassProperties result;
  result.volume = moments.volume;
  result.centre = moments.first / moments.volume;
  const Mat3 central = moments.second + scaled(outer(result.centre, result.centre), -moments.volume);
  diagonalise(inertia_of_second_moments(central), result);
  return result;
}

Mat3 inertia_matrix(const MassProperties& p) {
  const Mat3 r = to_matrix(p.orientation);
  return r * Mat3::diagonal(p.inertia) * transpose(r);
}

VolumeMoments to_moments(const MassProperties& p) {
  const Mat3 inertia = inertia_matrix(p);
  const double half = 0.5 * trace(inertia);  // trace(I) = 2 trace(S), hence S = trace(I)/2 - I
  const Mat3 central = Mat3::diagonal({half, half, half}) + scaled(inertia, -1.0);
  return {p.volume, p.volume * p.centre, central + scaled(outer(p.centre, p.centre), p.volume)};
}

MassProperties sphere_mass_properties(double radius) {
  const double volume = 4.0 / 3.0 * kPi * radius * radius * radius;
  const double inertia = 0.4 * volume * radius * radius;
  return {volume, {}, {inertia, inertia, inertia}, {}};
}

MassProperties box_mass_properties(const Vec3& h) {
  const double volume = 8.0 * h.x * h.y * h.z;
  const Vec3 s = hadamard(h, h) * (volume / 3.0);
  return {volume, {}, {s.y + s.z, s.z + s.x, s.x + s.y}, {}};
}

MassProperties cylinder_mass_properties(double radius, double half_length) {
  const double volume = 2.0 * kPi * radius * radius * half_length;
  const double across = volume * (radius * radius / 4.0 + half_length * half_length / 3.0);
  return {volume, {}, {across, across, volume * radius * radius / 2.0}, {}};
}

MassProperties capsule_mass_properties(double radius, double half_length) {
  const MassProperties barrel = cylinder_mass_properties(radius, half_length);
  const double ball = 4.0 / 3.0 * kPi * radius * radius * radius;
  // Two half balls: each half's centre lies 3r/8 beyond the barrel's end; parallel axes from the ball's centre.
  const double across = ball * (0.4 * radius * radius + half_length * half_length + 0.75 * half_length * radius);
  const double along = 0.4 * ball * radius * radius;
  return {
      barrel.volume + ball, {}, {barrel.inertia.x + across, barrel.inertia.y + across, barrel.inertia.z + along}, {}};
}

MassProperties cone_mass_properties(double radius, double half_height) {
  const double volume = 2.0 / 3.0 * kPi * radius * radius * half_height;
  const double height = 2.0 * half_height;
  const double across = volume * (0.15 * radius * radius + 0.0375 * height * height);
  return {volume, {0, 0, -0.5 * half_height}, {across, across, 0.3 * volume * radius * radius}, {}};
}

MassProperties ellipsoid_mass_properties(const Vec3& half_axes) {
  const double volume = 4.0 / 3.0 * kPi * half_axes.x * half_axes.y * half_axes.z;
  const Vec3 s = hadamard(half_axes, half_axes);
  return {volume, {}, 0.2 * volume * Vec3{s.y + s.z, s.x + s.z, s.x + s.y}, {}};
}

MassProperties mesh_mass_properties(const TriangleMesh& mesh) {
  if (const std::string problem = check_mesh(mesh).problem(); !problem.empty()) {
    throw Error{ErrorKind::usage, "the mesh does not bound a solid: " + problem};
  }
  const Aabb box = bounds_of(mesh.vertices);
  const Vec3 middle = 0.5 * (box.lower + box.upper);  // an origin near the solid keeps digits
  VolumeMoments sum;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - middle, b = mesh.vertices[t[1]] - middle, c = mesh.vertices[t[2]] - middle;
    const double volume = dot(a, cross(b, c)) / 6.0;
    const Vec3 all = a + b + c;
    // Over a tetrahedron with one corner at the origin: S = V/20 (sum of x x^T + (sum of x)(sum of x)^T).
    const Mat3 second = outer(a, a) + outer(b, b) + outer(c, c) + outer(all, all);
    sum += {volume, 0.25 * volume * all, scaled(second, volume / 20.0)};
  }
  MassProperties result = to_mass_properties(sum);
  result.centre += middle;
  return result;
}

MassProperties cluster_mass_properties(std::span<const Sphere> spheres) {
  return to_mass_properties(sphere_union_moments(spheres));
}

MassProperties placed(const MassProperties& part, const Pose& pose) {
  return {part.volume, transform(pose, part.centre), part.inertia, normalized(pose.orientation * part.orientation)};
}

MassProperties scaled(const MassProperties& part, double factor) {
  SCREE_REQUIRE(factor > 0.0, "scaled(): the factor must be positive");
  const double cube = factor * factor * factor;
  return {cube * part.volume, factor * part.centre, cube * factor * factor * part.inertia, part.orientation};
}

MassProperties composed(std::span<const WeightedPart> parts) {
  SCREE_REQUIRE(!parts.empty(), "composed(): a body needs at least one part");
  const Vec3 middle = parts.front().properties.centre;
  VolumeMoments sum;
  for (const WeightedPart& part : parts) {
    MassProperties local = part.properties;
    local.centre -= middle;
    const VolumeMoments m = to_moments(local);
    sum += {part.density * m.volume, part.density * m.first, scaled(m.second, part.density)};
  }
  MassProperties result = to_mass_properties(sum);
  result.centre += middle;
  return result;
}

MassProperties composed(std::span<const MassProperties> parts) {
  std::vector<WeightedPart> weighted;
  for (const MassProperties& part : parts) weighted.push_back({part, 1.0});
  return composed(weighted);
}

double equivalent_diameter(double volume) { return std::cbrt(6.0 * volume / kPi); }

}  // namespace scree
