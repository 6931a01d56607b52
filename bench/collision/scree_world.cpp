#include <algorithm>

#include "plugins.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "world.hpp"

namespace scree::bench {
namespace {

ShapeData shape_of(const World& world, std::size_t i) {
  ShapeData data;
  data.primitives.emplace_back();
  PrimitiveData& part = data.primitives[0];
  if (world.hull.empty()) {
    part.primitive.size.x = world.radius[i];
    return data;
  }
  const ConvexHull hull = convex_hull(world.hull[i]);
  part.primitive.kind = ShapeKind::convex_hull;
  part.vertices = hull.vertices;
  part.faces = hull.faces;
  part.triangles = hull.triangles;
  return data;
}

class ScreeWorld final : public Contender {
 public:
  ScreeWorld(const World& world, const std::string& broad, const std::vector<std::string>& chain, int threads)
      : executor_{threads}, broad_{make_plugin<BroadPhase>(broad)} {
    std::vector<NarrowPhase*> phases;
    for (const std::string& name : chain) {
      narrow_.push_back(make_plugin<NarrowPhase>(name));
      phases.push_back(narrow_.back().get());
    }
    for (std::size_t i = 0; i < world.size(); ++i) {
      NewBody body;
      body.shape = shapes_.add(shape_of(world, i));
      body.pose = {world.position[i], world.orientation[i]};
      body.radius = world.radius[i];
      bodies_.add(body);
    }
    pipeline_ = std::make_unique<CollisionPipeline>(shapes_, *broad_, std::move(phases), executor_);
  }

  std::size_t frame(const std::vector<Vec3>& position) override {
    const BodyState bodies = bodies_.state();
    std::ranges::copy(position, bodies.position.begin());
    contacts_ = pipeline_->find(bodies.view, bodies.view.velocity, bodies.view.angular_velocity, 1e-3);
    return contacts_.size();
  }

  [[nodiscard]] std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (const Contact& contact : contacts_) {
      if (contact.gap > 0.0) continue;
      if (!out.empty() && out.back().a == contact.a && out.back().b == contact.b) {
        out.back().gap = std::min(out.back().gap, contact.gap);
      } else {
        out.push_back({contact.a, contact.b, contact.gap});
      }
    }
    return out;
  }

 private:
  ShapeSet shapes_;
  BodyStore bodies_;
  Executor executor_;
  std::unique_ptr<BroadPhase> broad_;
  std::vector<std::unique_ptr<NarrowPhase>> narrow_;
  std::unique_ptr<CollisionPipeline> pipeline_;
  std::span<const Contact> contacts_;
};

}  // namespace

std::unique_ptr<Contender> make_scree(const World& world, const std::string& broad,
                                      const std::vector<std::string>& chain, int threads) {
  return std::make_unique<ScreeWorld>(world, broad, chain, threads);
}

}  // namespace scree::bench
