#include "roll.hpp"

#include "scree/base/error.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

Roll find_roll(SceneServices& services, const std::string& name) {
  const NamedBody body = services.body(name);
  const ShapeSet& shapes = services.shapes();
  const std::int64_t shape = shapes.find(body.shape);
  if (shape >= 0) {
    for (const Primitive& primitive : shapes.primitives(shapes.shapes()[static_cast<std::size_t>(shape)])) {
      if (primitive.kind != ShapeKind::cylinder) continue;
      const Pose world = body.pose * primitive.local;
      Vec3 axis = rotate(world.orientation, {0.0, 0.0, 1.0});
      // A cylinder looks the same from both ends: +z means the same zones however the scene turned it.
      if (axis.x + axis.y + axis.z < 0.0) axis = -axis;
      return {world.position, axis, primitive.size.x, primitive.size.y};
    }
  }
  throw Error{ErrorKind::usage, "image_force: the body '" + name + "' with the shape '" + body.shape +
                                    "' has no cylinder; the roll must be a body whose shape holds one"};
}

}  // namespace scree
