// Frame: the world, or the frame of a body that moves, in which an observer looks.
#pragma once

#include <string>

#include "scree/config/options.hpp"
#include "scree/model/body.hpp"

namespace scree {

class SceneServices;

/// The frame of a body as the scene writes it (the frame of its shape, not that of its principal axes), or the world.
class Frame {
 public:
  /// The setting `frame`: the name of a body, empty for the world.
  static Parameter parameter();

  Frame() = default;
  /// @throws Error (usage) when no body has the name.
  Frame(const Options& options, SceneServices& services);

  /// Takes the pose of the body. Nothing lies anywhere in the frame of a body that is gone: its places are NaN.
  void update(const BodyView& bodies);
  /// A place of the world [m] in this frame, as of the last update.
  [[nodiscard]] Vec3 local(const Vec3& world) const { return in_world_ ? world : transform_back(pose_, world); }
  [[nodiscard]] bool in_world() const { return in_world_; }
  /// For titles: "" in the world, " (frame of NAME)" else.
  [[nodiscard]] const std::string& label() const { return label_; }

 private:
  bool in_world_ = true;
  BodyId body_ = 0;
  Pose shape_to_body_;  // as written, in the body frame
  Pose pose_;           // of the frame in the world
  std::string label_;
};

}  // namespace scree
