// Region: the box in which an observer counts, and the grid of cells that a box may be divided into.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/frame.hpp"
#include "scree/math/aabb.hpp"

namespace scree {

/// A box in the world or in the frame of a body; everywhere when the scene names none.
class Region {
 public:
  /// The table `region` with `lower`, `upper` and `frame`; may be left out.
  static Parameter parameter();
  /// The settings of a box, for a table of other things as well.
  static std::vector<Parameter> box_parameters();

  Region() = default;
  /// Of the options of an observer that has parameter(). @throws Error (usage) for an empty box or an unknown body.
  Region(const Options& options, SceneServices& services);
  /// Of a table that has box_parameters().
  static Region of_box(const Options& table, SceneServices& services);

  void update(const BodyView& bodies) { frame_.update(bodies); }
  [[nodiscard]] bool contains(const Vec3& world) const { return everywhere_ || scree::contains(box_, local(world)); }
  [[nodiscard]] bool everywhere() const { return everywhere_; }
  [[nodiscard]] const Aabb& box() const { return box_; }  ///< [m], in the frame
  [[nodiscard]] Vec3 local(const Vec3& world) const { return frame_.local(world); }
  [[nodiscard]] const Frame& frame() const { return frame_; }

 private:
  bool everywhere_ = true;
  Aabb box_ = Aabb::everywhere();
  Frame frame_;
};

/// The part [first, second] of the straight way between two places [m], as shares of it, that lies in a box; none when it
/// passes by.
[[nodiscard]] std::optional<std::pair<double, double>> part_inside(const Aabb& box, const Vec3& from, const Vec3& to);

/// A region divided into nx x ny x nz equal cells, x fastest.
class CellGrid {
 public:
  /// The table `grid` with `lower`, `upper`, `cells` and `frame`.
  static Parameter parameter();

  CellGrid() = default;
  /// Of the options of an observer that has parameter(). @throws Error (usage).
  CellGrid(const Options& options, SceneServices& services);
  /// In the world. `count` >= 1 along each axis.
  CellGrid(const Aabb& box, const std::array<std::size_t, 3>& count);

  void update(const BodyView& bodies) { region_.update(bodies); }
  /// The cell of a place of the world [m], or -1 outside.
  [[nodiscard]] std::int64_t cell(const Vec3& world) const;
  [[nodiscard]] std::size_t size() const { return count_[0] * count_[1] * count_[2]; }
  [[nodiscard]] const std::array<std::size_t, 3>& count() const { return count_; }
  [[nodiscard]] const Vec3& spacing() const { return spacing_; }  ///< edges of a cell [m]
  [[nodiscard]] const Aabb& box() const { return box_; }          ///< [m], in the frame

 private:
  void divide();
  Region region_;
  Aabb box_;
  std::array<std::size_t, 3> count_{1, 1, 1};
  Vec3 spacing_;
};

}  // namespace scree
