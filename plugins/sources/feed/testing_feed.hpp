// What the tests of feeds share: a scene with two materials, and brute-force looks at particles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "scree/config/validate.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/model/body_store.hpp"
#include "scree/model/shape_set.hpp"
#include "support/fake_scene_services.hpp"

namespace scree::testing_feed {

inline constexpr double kStep = 1e-3;  // [s]

/// A scene in which sources emit into a store of bodies.
struct FeedScene {
  FeedScene() {
    services.materials().add({"copper", 8400.0, {}, {}});
    services.materials().add({"plastic", 946.0, {}, {}});
  }

  template <class SourceType>
  std::unique_ptr<SourceType> make(const std::string& toml) {
    auto source = std::make_unique<SourceType>(options_from_text(toml, SourceType::parameters()));
    source->setup(services);
    return source;
  }

  /// Lets `source` emit for step `step`; the bodies join the store and are returned.
  std::vector<NewBody> emit(Source& source, int step, double dt = kStep) {
    std::vector<NewBody> born;
    source.emit(bodies.view(), step * dt, dt, born);
    for (const NewBody& body : born) bodies.add(body);
    return born;
  }
  /// Moves every body on by one step.
  void move() {
    const BodyState state = bodies.state();
    for (std::size_t i = 0; i < state.position.size(); ++i) state.position[i] += kStep * state.velocity[i];
  }
  void remove_all() { bodies.remove(std::vector<char>(bodies.size(), 1)); }

  test::FakeSceneServices services;
  BodyStore bodies;
};

/// The balls that collision sees of a body, in the world [m].
inline std::vector<Sphere> world_spheres(const ShapeSet& shapes, std::uint32_t shape, const Pose& pose) {
  const Primitive& part = shapes.primitives(shapes.shapes()[shape])[0];
  if (part.kind == ShapeKind::sphere) return {{pose.position, part.size.x}};
  std::vector<Sphere> spheres;
  for (const Sphere& sphere : shapes.spheres().subspan(part.first_sphere, part.sphere_count))
    spheres.push_back({transform(pose, sphere.centre), sphere.radius});
  return spheres;
}

/// The smallest gap between the last `newest` bodies and all others [m], over all pairs of balls.
inline double smallest_gap(FeedScene& scene, std::size_t newest) {
  const BodyView view = scene.bodies.view();
  std::vector<std::vector<Sphere>> spheres;
  const ShapeSet& shapes = scene.services.shapes();
  for (std::size_t i = 0; i < view.size(); ++i)
    spheres.push_back(world_spheres(shapes, view.shape[i], {view.position[i], view.orientation[i]}));
  double gap = 1e300;
  for (std::size_t i = view.size() - newest; i < view.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const Sphere& a : spheres[i])
        for (const Sphere& b : spheres[j]) gap = std::min(gap, norm(a.centre - b.centre) - a.radius - b.radius);
    }
  }
  return gap;
}

}  // namespace scree::testing_feed
