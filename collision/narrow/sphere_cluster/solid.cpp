#include "solid.hpp"

#include <stdexcept>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"

namespace scree::sphere_cluster {

namespace {

constexpr std::uint32_t kSphere = ~0u;

Solid solid_like(const Primitive& p, std::uint32_t i) {
  Solid solid;
  solid.kind = p.kind;
  solid.hollow = p.hollow;
  solid.primitive = i;
  solid.size = p.size;
  solid.bounding_radius = p.bounding_radius;
  return solid;
}

}  // namespace

Solid SolidSet::solid(std::uint32_t primitive) const {
  const std::uint32_t at = solid_of[primitive];
  return at == kSphere ? solid_like(shapes->primitives()[primitive], primitive) : solids[at];
}

void SolidSet::add(const ShapeSet& from, std::size_t first_new) {
  SCREE_REQUIRE(first_new <= solid_of.size(), "narrow phase sphere_cluster: bind() left out primitives");
  shapes = &from;
  const auto primitives = from.primitives();
  grow_to(primitives.size(), solid_of);
  grow_to(from.spheres().size(), spheres);
  for (std::size_t i = solid_of.size(); i < primitives.size(); ++i) {
    const Primitive& p = primitives[i];
    if (p.kind == ShapeKind::sphere) {
      solid_of.push_back(kSphere);
      continue;
    }
    Solid solid = solid_like(p, static_cast<std::uint32_t>(i));
    if (p.kind == ShapeKind::sphere_cluster) {
      solid.first = static_cast<std::uint32_t>(spheres.size());
      solid.sphere_count = p.sphere_count;
      const auto parts = from.spheres().subspan(p.first_sphere, p.sphere_count);
      spheres.insert(spheres.end(), parts.begin(), parts.end());
    } else if (p.kind == ShapeKind::convex_hull) {
      SCREE_REQUIRE(p.face_count > 0 && p.triangle_count > 0, "a convex hull needs its faces and its triangles");
    } else if (p.kind == ShapeKind::triangle_mesh) {
      solid.first = static_cast<std::uint32_t>(meshes.size());
      meshes.emplace_back(from.vertices(), from.triangles().subspan(p.first_triangle, p.triangle_count));
    }
    solid_of.push_back(static_cast<std::uint32_t>(solids.size()));
    grow_to(solids.size() + 1, solids);
    solids.push_back(solid);
  }
}

}  // namespace scree::sphere_cluster
