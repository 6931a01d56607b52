// New shapes, added while running, cost only themselves: counted, not timed.
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "collision_parts.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "scree/model/random.hpp"
#include "scree/model/shape_set.hpp"
#include "support/allocation_count.hpp"

namespace scree {
namespace {

/// A hull of six random corners, and as a mesh.
ShapeData random_shape(RandomStream& random, bool as_mesh) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 6; ++i) corners.push_back(1e-3 * rotate(random.orientation(), {0, 0, 1}));
  const ConvexHull hull = convex_hull(corners);
  PrimitiveData part;
  part.primitive.kind = as_mesh ? ShapeKind::triangle_mesh : ShapeKind::convex_hull;
  part.vertices = hull.vertices;
  part.triangles = hull.triangles;
  if (!as_mesh) part.faces = hull.faces;
  ShapeData shape;
  shape.primitives.push_back(part);
  shape.volume = 1e-9;
  return shape;
}

void add(ShapeSet& shapes, int count) {
  static const std::vector<ShapeData> some = [] {
    RandomStream random{1, "shapes"};
    std::vector<ShapeData> few;
    for (int i = 0; i < 20; ++i) few.push_back(random_shape(random, i % 4 == 0));
    return few;
  }();
  for (int i = 0; i < count; ++i) (void)shapes.add(some[static_cast<std::size_t>(i) % some.size()]);
}

/// Allocations of a phase that is told of 1000 new shapes when it knows `before` already.
std::uint64_t allocations_of_binding(const std::string& phase_name, int before) {
  const auto phase = test::make_plugin<NarrowPhase>(phase_name);
  ShapeSet shapes;
  add(shapes, before);
  phase->bind(shapes, 0);
  const std::size_t known = shapes.primitives().size();
  add(shapes, 1000);
  const std::uint64_t first = test::allocation_count();
  phase->bind(shapes, known);
  return test::allocation_count() - first;
}

TEST(new_shapes, are_bound_by_every_narrow_phase_at_a_cost_that_knows_no_others) {
  for (const char* const name : {"sphere_cluster", "polyhedron"}) {
    const std::uint64_t among_few = allocations_of_binding(name, 100), among_many = allocations_of_binding(name, 10000);
    // What a shape needs of its own, and the few buffers of the phase that may grow once.
    EXPECT_LE(among_many, among_few + 40) << name << " looks at what it knows already";
  }
}

/// Counts the records of a buffer that had to move, because it grew.
class MoveCounter {
 public:
  template <class Record>
  void look(std::span<const Record> buffer) {
    if (buffer.data() != where_) moved_ += size_;
    where_ = buffer.data();
    size_ = buffer.size();
  }
  [[nodiscard]] double moved() const { return static_cast<double>(moved_); }
  [[nodiscard]] double size() const { return static_cast<double>(size_); }

 private:
  const void* where_ = nullptr;
  std::size_t size_ = 0, moved_ = 0;
};

TEST(new_shapes, move_a_bounded_number_of_records_of_those_that_are_there) {
  ShapeSet shapes;
  MoveCounter records, primitives, vertices, triangles;
  const auto add_one_by_one = [&](int count) {
    for (int i = 0; i < count; ++i) {
      add(shapes, 1);
      records.look(shapes.shapes());
      primitives.look(shapes.primitives());
      vertices.look(shapes.vertices());
      triangles.look(shapes.triangles());
    }
  };
  add_one_by_one(10000);
  for (const MoveCounter* buffer : {&records, &primitives, &vertices, &triangles}) {
    // Buffers grow by an eighth or more: a record moves 1 / (1 - 8/9) - 1 = 8 times on average at most; one more at the start.
    EXPECT_LE(buffer->moved(), 9.0 * buffer->size());
  }
  const double before = records.moved() + primitives.moved() + vertices.moved() + triangles.moved();
  const double there = records.size() + primitives.size() + vertices.size() + triangles.size();
  add_one_by_one(1000);
  const double after = records.moved() + primitives.moved() + vertices.moved() + triangles.moved();
  EXPECT_LE(after - before, 1.1 * there) << "a tenth more moves every buffer once at most";
}

}  // namespace
}  // namespace scree
