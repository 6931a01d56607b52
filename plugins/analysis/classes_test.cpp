#include "analysis/classes.hpp"

#include <gtest/gtest.h>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

class ClassesTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"glass", "steel", "wood"}) services.materials().add({name, 1000.0, {}, {}});
  }
  [[nodiscard]] TwoClasses make(const std::string& toml) {
    return TwoClasses{options_from_text(toml, TwoClasses::parameters()), services};
  }
  [[nodiscard]] std::string refusal(const std::string& toml) {
    try {
      (void)make(toml);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  }
  static constexpr BodyClass kA = BodyClass::first, kB = BodyClass::second, kNone = BodyClass::neither;
  test::FakeSceneServices services;
};

TEST_F(ClassesTest, part_by_material) {
  test::TestBodies bodies{services.attributes()};
  for (const BodyId id : {1u, 2u, 3u}) {
    bodies.add_sphere(id, {}, 1e-3, 1000.0);
    bodies.material.back() = static_cast<std::uint32_t>(id - 1);
  }
  TwoClasses others = make("classes = {type = 'material', first = ['steel']}");
  others.look(bodies.view(), 0.0);
  EXPECT_EQ(others.of_dynamic(), (std::vector{kB, kA, kB}));
  EXPECT_EQ(others.names()[1], "others");
  TwoClasses two = make("classes = {type = 'material', first = ['steel'], second = ['wood']}");
  two.look(bodies.view(), 0.0);
  EXPECT_EQ(two.of_dynamic(), (std::vector{kNone, kA, kB}));
}

TEST_F(ClassesTest, part_by_size_and_by_attribute_at_the_threshold) {
  test::TestBodies bodies{services.attributes()};
  services.attributes().declare({"moisture", "1", "", 0.0, {}});
  bodies.add_sphere(1, {}, 0.9e-3, 1000.0);
  bodies.add_sphere(2, {}, 1e-3, 1000.0);
  services.attributes().column(0)[0] = 0.3;
  TwoClasses size = make("classes = {type = 'size', threshold = '2 mm'}");
  size.look(bodies.view(), 0.0);
  EXPECT_EQ(size.of_dynamic(), (std::vector{kA, kB}));
  TwoClasses moist = make("classes = {type = 'attribute', attribute = 'moisture', threshold = 0.2}");
  moist.look(bodies.view(), 0.0);
  EXPECT_EQ(moist.of_dynamic(), (std::vector{kB, kA}));
  EXPECT_TRUE(services.requires_column("moisture"));
}

// The side is that of the time `at`, or of the first sight for what comes later, wherever a body goes then.
TEST_F(ClassesTest, remember_the_side_while_bodies_come_and_go) {
  TwoClasses sides = make("classes = {type = 'side', normal = [0, 0, 2], point = [0, 0, 1], at = 1.0}");
  test::TestBodies start{services.attributes()};
  start.add_immovable(0, {0, 0, 5});
  start.add_sphere(1, {0, 0, 0.5}, 1e-3, 1000.0);
  start.add_sphere(2, {0, 0, 1.5}, 1e-3, 1000.0);
  start.add_sphere(3, {0, 0, 1.5}, 1e-3, 1000.0);
  sides.look(start.view(), 0.5);
  EXPECT_EQ(sides.of_dynamic(), (std::vector{kA, kB, kB}));
  start.position[1].z = 1.2;  // changes sides before the bodies are asked for good
  sides.look(start.view(), 1.0);
  EXPECT_EQ(sides.of_dynamic(), (std::vector{kB, kB, kB}));
  test::TestBodies later{services.attributes()};
  later.add_immovable(0, {0, 0, 5});
  later.add_sphere(1, {0, 0, 0.1}, 1e-3, 1000.0);  // 2 is gone
  later.add_sphere(3, {0, 0, 0.1}, 1e-3, 1000.0);
  later.add_sphere(7, {0, 0, 0.1}, 1e-3, 1000.0);
  MemoryState saved;
  sides.save(saved.writer());
  TwoClasses resumed = make("classes = {type = 'side', normal = [0, 0, 2], point = [0, 0, 1], at = 1.0}");
  resumed.load(saved.reader());
  for (TwoClasses* rule : {&sides, &resumed}) {
    rule->look(later.view(), 1.1);
    EXPECT_EQ(rule->of_dynamic(), (std::vector{kB, kB, kA}));
  }
}

TEST_F(ClassesTest, refuse_what_parts_nothing) {
  EXPECT_NE(refusal("classes = {type = 'material', first = ['gold']}").find("'gold'"), std::string::npos);
  EXPECT_NE(refusal("classes = {type = 'material', first = ['steel'], second = ['steel']}").find("one class"),
            std::string::npos);
  EXPECT_NE(refusal("classes = {type = 'side', normal = [0, 0, 0]}").find("must not be zero"), std::string::npos);
  EXPECT_NE(refusal("classes = {type = 'size', threshold = 0.1}\nclass_names = ['a']").find("two different"),
            std::string::npos);
}

}  // namespace
}  // namespace scree
