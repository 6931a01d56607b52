#include "analysis/frame.hpp"

#include <algorithm>
#include <limits>

#include "scree/interfaces/scene_services.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

Parameter Frame::parameter() {
  return Parameter::text("frame", "body in whose frame (that of its shape) places are given; empty for the world")
      .by_default("");
}

Frame::Frame(const Options& options, SceneServices& services) {
  const std::string& name = options.text("frame");
  if (name.empty()) return;
  const NamedBody body = services.body(name);
  in_world_ = false;
  body_ = body.id;
  const std::int64_t shape = services.shapes().find(body.shape);
  if (shape >= 0) shape_to_body_ = inverse(services.shapes().body_to_shape(static_cast<std::uint32_t>(shape)));
  pose_ = body.pose * shape_to_body_;
  label_ = " (frame of " + name + ")";
}

void Frame::update(const BodyView& bodies) {
  if (in_world_) return;
  const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), body_);
  if (at == bodies.id.end() || *at != body_) {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    pose_.position = {kNowhere, kNowhere, kNowhere};
    return;
  }
  const auto i = static_cast<std::size_t>(at - bodies.id.begin());
  pose_ = Pose{bodies.position[i], bodies.orientation[i]} * shape_to_body_;
}

}  // namespace scree
