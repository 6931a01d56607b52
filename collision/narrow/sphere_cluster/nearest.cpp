#include "nearest.hpp"

#include <algorithm>
#include <cmath>

namespace scree::sphere_cluster {
namespace {

/// Unit vector from the z axis to p; the x axis for a point on the axis.
Vec3 radial(const Vec3& p, double rho) { return rho > 0.0 ? Vec3{p.x / rho, p.y / rho, 0.0} : Vec3{1, 0, 0}; }

}  // namespace

Nearest nearest_on_box(const Vec3& half, const Vec3& p) {
  // Excess over each pair of faces; all negative inside.
  const Vec3 q{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  if (q.x <= 0.0 && q.y <= 0.0 && q.z <= 0.0) {
    const int axis = q.x >= q.y ? (q.x >= q.z ? 0 : 2) : (q.y >= q.z ? 1 : 2);
    Vec3 normal;
    normal[axis] = std::copysign(1.0, p[axis]);
    return {q[axis], normal};
  }
  const auto part = [](double excess, double side) { return excess > 0.0 ? std::copysign(excess, side) : 0.0; };
  const Vec3 away{part(q.x, p.x), part(q.y, p.y), part(q.z, p.z)};
  const double distance = norm(away);
  return {distance, away / distance};
}

Nearest nearest_on_cylinder(double r, double h, const Vec3& p) {
  const double rho = std::hypot(p.x, p.y);
  const Vec3 out = radial(p, rho);
  const Vec3 up{0, 0, std::copysign(1.0, p.z)};
  const double side = rho - r;
  const double end = std::abs(p.z) - h;
  if (side <= 0.0 || end <= 0.0) return side > end ? Nearest{side, out} : Nearest{end, up};
  const double distance = std::hypot(side, end);
  return {distance, (side / distance) * out + (end / distance) * up};
}

Nearest nearest_on_capsule(double r, double h, const Vec3& p) {
  const Vec3 away{p.x, p.y, p.z - std::clamp(p.z, -h, h)};
  const double d = norm(away);
  return {d - r, d > 0.0 ? away / d : Vec3{1, 0, 0}};
}

Nearest nearest_on_cone(double r, double h, const Vec3& p) {
  const double rho = std::hypot(p.x, p.y);
  const Vec3 out = radial(p, rho);
  const double length = std::hypot(r, 2.0 * h);
  // Outward normal of the mantle, and excess over mantle and base.
  const double normal_rho = 2.0 * h / length;
  const double normal_z = r / length;
  const double mantle = normal_rho * rho + normal_z * (p.z - h);
  const double base = -h - p.z;
  if (mantle <= 0.0 && base <= 0.0) {
    return mantle >= base ? Nearest{mantle, normal_rho * out + Vec3{0, 0, normal_z}} : Nearest{base, {0, 0, -1}};
  }
  // Outside: the nearer of the mantle's segment, from the apex down, and the base disc.
  const double along = std::clamp(normal_z * rho - normal_rho * (p.z - h), 0.0, length);
  const double mantle_rho = rho - along * normal_z;
  const double mantle_z = p.z - h + along * normal_rho;
  const double base_rho = std::max(0.0, rho - r);
  const double to_mantle = std::hypot(mantle_rho, mantle_z);
  const double to_base = std::hypot(base_rho, base);
  if (to_base < to_mantle) return {to_base, (base_rho / to_base) * out + Vec3{0, 0, -base / to_base}};
  return {to_mantle, (mantle_rho / to_mantle) * out + Vec3{0, 0, mantle_z / to_mantle}};
}

std::array<Nearest, 3> walls_of_drum(double r, double h, const Vec3& p) {
  const double rho = std::hypot(p.x, p.y);
  return {Nearest{r - rho, -radial(p, rho)}, Nearest{h - p.z, {0, 0, -1}}, Nearest{h + p.z, {0, 0, 1}}};
}

}  // namespace scree::sphere_cluster
