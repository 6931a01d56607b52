// CutView: what of a scene is shown, so that one sees below the surface: by region, by plane, by name.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/model/body.hpp"
#include "vtp/surface.hpp"

namespace scree {

class SceneServices;

/// A plane that cuts a view.
struct CutPlane {
  Vec3 point;             ///< [m], world
  Vec3 normal;            ///< unit, to the side that is taken away [1]
  bool only_cut = false;  ///< shows what the plane cuts, in place of all behind it
  /// Above the plane [m].
  [[nodiscard]] double height(const Vec3& p) const { return dot(normal, p - point); }
};

/// A cylinder between two points.
struct CutCylinder {
  Vec3 from, to;        ///< ends of its axis [m], world
  double radius = 0.0;  ///< [m]; 0: no cylinder
};

/// Part of an observer's parameters. Everything is shown by default.
class CutView {
 public:
  /// `plane`, `region`, `hide` and `as_walls`.
  static std::vector<Parameter> parameters();
  /// Reads them. @throws Error (usage) for a plane without normal, an empty region and unknown bodies.
  void setup(const Options& options, const SceneServices& services);

  [[nodiscard]] bool hides(BodyId id) const { return contains(hidden_, id); }
  /// True for bodies that are drawn as walls are: those that forces do not move, and those of `as_walls`.
  [[nodiscard]] bool is_wall(const BodyView& bodies, BodyIndex i) const {
    return bodies.motion[i] != Motion::dynamic || contains(walls_, bodies.id[i]);
  }
  /// Whether a thing with this centre and this radius about it [m], world, is shown: the centre is kept by planes and region; a
  /// plane that shows what it cuts is at most the radius away.
  [[nodiscard]] bool keeps(const Vec3& centre, double radius) const;
  /// The same for what is cut where the plane goes, or left whole: planes that show what they cut keep all of it.
  [[nodiscard]] bool keeps_point(const Vec3& p) const;
  /// Cuts triangles [first, end) of a surface along planes and the faces of a box; along a cylinder whole triangles go or stay by
  /// their centres. Planes that show what they cut keep the triangles that they cross. Points stay, used or not.
  void clip(Surface& surface, std::size_t first) const;

 private:
  [[nodiscard]] static bool contains(const std::vector<BodyId>& sorted, BodyId id);
  [[nodiscard]] bool in_cylinder(const Vec3& p) const;
  [[nodiscard]] bool crossed(const std::array<Vec3, 3>& corners) const;

  std::vector<CutPlane> planes_;  // those of a box, too
  CutCylinder cylinder_;
  std::vector<BodyId> hidden_, walls_;  // sorted
};

/// Takes out the points that no triangle has, as clip() leaves them.
void drop_unused_points(Surface& surface);

}  // namespace scree
