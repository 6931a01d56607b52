#include "bullet_dbvt.hpp"

#include "conformance/broad_phase_case.hpp"

namespace scree {
namespace {

using namespace test;

// Law: a phase that lived through other steps reports what a new one does. Sizes change a hundredfold on the way, boxes
// pass through each other, keys vanish and others come, some in no order, some become movable.
TEST(BulletDbvt, history_does_not_show) {
  RandomNumbers random{17};
  BulletDbvt old;
  TestBoxes boxes;
  std::size_t found = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const double size = frame < 15 ? 1e-3 : 1e-1;
    for (int k = 0; k < 60; ++k) boxes.add(random.in_cube(6 * size), size * Vec3{1, 0.5, 0.8}, k % 4 != 0);
    while (boxes.key.size() > 200) boxes.remove(random.below(boxes.key.size()));
    for (Aabb& box : boxes.box) {
      const Vec3 way = random.in_cube(size);
      box = {box.lower + way, box.upper + way};
    }
    const std::size_t i = random.below(boxes.key.size()), j = random.below(boxes.key.size());
    std::swap(boxes.key[i], boxes.key[j]);
    boxes.movable[i] = 1;
    BulletDbvt fresh;
    const PairSet pairs = pairs_of(old, boxes.view());
    EXPECT_EQ(pairs, pairs_of(fresh, boxes.view())) << "frame " << frame;
    EXPECT_EQ(pairs, brute_force(boxes.view())) << "frame " << frame;
    found += pairs.size();
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace scree
