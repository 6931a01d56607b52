#include "scene_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scree/model/material.hpp"

namespace scree {

namespace {

constexpr double kAlong = 0.999;  // cosine between two directions that count as one

/// Puts bodies into a picture, one after the other.
class SceneBuilder {
 public:
  SceneBuilder(const Observation& now, const SceneWords& words, const View& view, Picture& picture)
      : bodies_{now.bodies}, words_{words}, view_{view}, picture_{picture}, counts_(words.materials.size()) {}

  void add(std::size_t i) {
    if (view_.cut.hides(bodies_.id[i])) return;
    const Shape& shape = words_.shapes.shapes()[bodies_.shape[i]];
    const Pose pose{bodies_.position[i], bodies_.orientation[i]};
    parts_.clear();
    append_silhouettes(words_.shapes, shape, pose, view_.projection, parts_);
    const bool wall = view_.cut.is_wall(bodies_, static_cast<BodyIndex>(i));
    if (!wall && !view_.cut.keeps(bodies_.position[i], shape.bounding_radius)) return;
    if (wall) std::erase_if(parts_, [&](const Silhouette& part) { return !view_.cut.keeps_point(part.place); });
    for (const Silhouette& part : parts_) include(part, bounds_);
    if (!wall) return add_particle(i);
    add_wall(i);
    for (const Primitive& primitive : words_.shapes.primitives(shape)) {
      if (primitive.kind == ShapeKind::plane) add_plane(pose * primitive.local);
      if (primitive.kind == ShapeKind::cylinder) add_turn(i, primitive, pose * primitive.local);
    }
  }

  void finish() {
    const auto back_to_front = [](const auto& a, const auto& b) { return a.depth < b.depth; };
    for (WallPicture& wall : picture_.walls) std::stable_sort(wall.parts.begin(), wall.parts.end(), back_to_front);
    std::stable_sort(picture_.walls.begin(), picture_.walls.end(), back_to_front);
    std::stable_sort(picture_.grains.begin(), picture_.grains.end(),
                     [](const Grain& a, const Grain& b) { return a.shape.depth < b.shape.depth; });
    picture_.window = view_.window.value_or(with_margin(bounds_));
    add_colours();
    for (std::size_t m = 0; m < counts_.size(); ++m) {
      if (counts_[m] == 0) continue;
      const std::string& name = words_.materials[static_cast<std::uint32_t>(m)].name;
      picture_.legend.push_back({fmt::format("{} ({})", name, counts_[m]), m});
    }
  }

  [[nodiscard]] std::size_t particles() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
  }

 private:
  void add_particle(std::size_t i) {
    const std::uint32_t material = bodies_.material[i];
    ++counts_[material];
    for (Silhouette& part : parts_) picture_.grains.push_back({std::move(part), material});
    if (view_.velocity_arrows <= 0.0) return;
    const Vec3 to = bodies_.position[i] + view_.velocity_arrows * bodies_.velocity[i];
    picture_.arrows.push_back({view_.projection(bodies_.position[i]), view_.projection(to)});
  }

  void add_wall(std::size_t i) {
    if (parts_.empty()) return;
    const BodyId id = bodies_.id[i];
    std::string label = id < words_.names.size() ? words_.names[id] : std::string{};
    std::replace(label.begin(), label.end(), '_', ' ');
    picture_.walls.push_back({std::move(label), parts_, view_.projection.depth(bodies_.position[i])});
    wall_materials_.push_back(bodies_.material[i]);
  }

  void add_plane(const Pose& pose) {
    const Point2 normal = view_.projection(rotate(pose.orientation, {0, 0, 1}));
    const double length = std::hypot(normal.x, normal.y);
    if (length > kAlong) picture_.edges.push_back({view_.projection(pose.position), (1.0 / length) * normal});
  }

  void add_turn(std::size_t i, const Primitive& cylinder, const Pose& pose) {
    const Vec3 axis = rotate(pose.orientation, {0, 0, 1});
    const double rate = dot(bodies_.angular_velocity[i], view_.projection.to_viewer());
    if (rate == 0.0 || std::abs(dot(axis, view_.projection.to_viewer())) < kAlong) return;
    picture_.turns.push_back({view_.projection(pose.position), cylinder.size.x, rate > 0.0});
  }

  // What only particles are made of comes first, so that it has the colours that are told apart best.
  void add_colours() {
    const auto is_wall = [&](std::size_t m) {
      return std::find(wall_materials_.begin(), wall_materials_.end(), m) != wall_materials_.end();
    };
    picture_.colours.resize(counts_.size());
    std::size_t next = 0;
    for (const bool walls : {false, true}) {
      for (std::size_t m = 0; m < counts_.size(); ++m) {
        if (is_wall(m) == walls) picture_.colours[m] = next++;
      }
    }
  }

  const BodyView& bodies_;
  const SceneWords& words_;
  const View& view_;
  Picture& picture_;
  Window bounds_ = Window::empty();
  std::vector<std::size_t> counts_;  // particles by material
  std::vector<std::size_t> wall_materials_;
  std::vector<Silhouette> parts_;
};

}  // namespace

Picture scene_picture(const Observation& now, const SceneWords& words, const View& view) {
  Picture picture;
  SceneBuilder build{now, words, view, picture};
  for (std::size_t i = 0; i < now.bodies.size(); ++i) build.add(i);
  build.finish();
  picture.note = fmt::format("t = {:.4g} s, {} particles", now.time, build.particles());
  picture.x_label = axis_label(view.projection.right(), "right");
  picture.y_label = axis_label(view.projection.up(), "up");
  return picture;
}

}  // namespace scree
