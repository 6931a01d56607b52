#include "fcl_tree.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "scree/collision/box_register.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

/// FCL's idea of a box: a geometry whose local bounds are the box in the world.
class BoxGeometry final : public fcl::CollisionGeometryd {
 public:
  void computeLocalAABB() override {}
  void set(const Aabb& box) {
    aabb_local.min_ = {box.lower.x, box.lower.y, box.lower.z};
    aabb_local.max_ = {box.upper.x, box.upper.y, box.upper.z};
  }
};

/// A box in one of the trees.
struct Leaf {
  explicit Leaf(bool can_move) : movable{can_move} { object.setUserData(this); }
  void set(std::uint32_t box_index, const Aabb& box) {
    index = box_index;
    geometry->set(box);
    object.computeAABB();
  }

  bool movable;
  std::uint32_t index = 0;
  std::shared_ptr<BoxGeometry> geometry = std::make_shared<BoxGeometry>();
  fcl::CollisionObjectd object{geometry};
};

/// What the callback needs.
struct Report {
  const BoxView& boxes;
  std::vector<CandidatePair>& out;
};

bool report_pair(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* report) {
  const auto& [boxes, out] = *static_cast<Report*>(report);
  const std::uint32_t a = static_cast<const Leaf*>(first->getUserData())->index;
  const std::uint32_t b = static_cast<const Leaf*>(second->getUserData())->index;
  if (boxes.owner[a] != boxes.owner[b] && overlap(boxes.box[a], boxes.box[b])) out.push_back({a, b});
  return false;  // go on
}

}  // namespace

struct FclTree::World {
  [[nodiscard]] fcl::DynamicAABBTreeCollisionManagerd& tree(bool is_movable) { return is_movable ? movable : resting; }

  fcl::DynamicAABBTreeCollisionManagerd movable, resting;
  BoxRegister<std::unique_ptr<Leaf>> leaves;
  std::vector<fcl::CollisionObjectd*> added[2];  ///< of this step: resting, movable
};

FclTree::FclTree() : world_{std::make_unique<World>()} {}
FclTree::~FclTree() = default;

void FclTree::find_pairs(const BoxView& boxes, const Executor& /*executor*/, std::vector<CandidatePair>& out) {
  World& world = *world_;
  world.leaves.update(
      boxes,
      [&](std::uint32_t i) {
        auto leaf = std::make_unique<Leaf>(boxes.movable[i] != 0);
        leaf->set(i, boxes.box[i]);
        world.added[leaf->movable ? 1 : 0].push_back(&leaf->object);
        return leaf;
      },
      [&](const std::unique_ptr<Leaf>& leaf, std::uint32_t i) { leaf->set(i, boxes.box[i]); },
      [&](const std::unique_ptr<Leaf>& leaf) { world.tree(leaf->movable).unregisterObject(&leaf->object); });
  for (const bool movable : {false, true}) {
    std::vector<fcl::CollisionObjectd*>& added = world.added[movable ? 1 : 0];
    world.tree(movable).update();
    world.tree(movable).registerObjects(added);
    world.tree(movable).setup();
    added.clear();
  }
  Report report{boxes, out};
  if (world.movable.empty()) return;
  world.movable.collide(&report, &report_pair);
  if (!world.resting.empty()) world.movable.collide(&world.resting, &report, &report_pair);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::FclTree>("fcl_tree",
                                                 "FCL's dynamic tree of bounding boxes, kept between steps.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("fcl_tree", "1.0.0", &list)};
