#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numbers>

#include "bed.hpp"
#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"

namespace scree {
namespace {

const char* const kThree =
    "3 0.05\n"
    "# a comment\n"
    "0.01 0.02 0.003 0.0025 0 0 0\n"
    "\n"
    "0.02 0.02 0.003 0.0025 1e-3 -2e-3 +3e-3   # another\r\n"
    "\t0.03 0.02 0.004 0.004 0 0 -1\n";

class bed : public testing::Test {
 protected:
  void SetUp() override {
    file = std::filesystem::temp_directory_path() / ("scree_bed_" + std::to_string(::getpid()) + ".txt");
    services.materials().add({"glass", 2500.0, {}, {}});
  }
  void TearDown() override { std::filesystem::remove(file); }

  void write(const std::string& text) const { std::ofstream{file} << text; }
  std::unique_ptr<BedSource> make(const std::string& more = "", const std::string& material = "glass") {
    auto source = std::make_unique<BedSource>(options_from_text(
        "file = '" + file.string() + "'\nmaterial = '" + material + "'\n" + more, BedSource::parameters()));
    source->setup(services);
    return source;
  }
  static std::vector<NewBody> emit(BedSource& source) {
    std::vector<NewBody> born;
    source.emit({}, 0.0, 1e-3, born);
    return born;
  }
  // The sentence with which a file of this text is refused, without its folder.
  std::string refusal(const std::string& text) {
    write(text);
    try {
      make();
    } catch (const Error& problem) {
      const std::string sentence = problem.what();
      return sentence.substr(std::min(sentence.size(), file.parent_path().string().size() + 1));
    }
    return "";
  }

  std::filesystem::path file;
  test::FakeSceneServices services;
};

TEST_F(bed, spheres_are_where_the_file_says) {
  write(kThree);
  const auto source = make("offset = [0, 0, 1]");
  const std::vector<NewBody> born = emit(*source);
  ASSERT_EQ(born.size(), 3U);
  EXPECT_EQ(born[0].pose.position, (Vec3{0.01, 0.02, 1.003}));
  EXPECT_EQ(born[1].velocity, (Vec3{1e-3, -2e-3, 3e-3}));
  EXPECT_EQ(born[2].radius, 0.004);
  // Solid spheres: 4/3 pi r^3 rho and 2/5 m r^2, to rounding.
  const double m = 4.0 / 3.0 * std::numbers::pi * 6.4e-8 * 2500.0;
  EXPECT_NEAR(born[2].mass, m, 1e-12 * m);
  EXPECT_NEAR(born[2].inertia.x, 0.4 * m * 1.6e-5, 1e-12 * m * 1.6e-5);
  EXPECT_TRUE(emit(*source).empty());  // once
}

TEST_F(bed, equal_spheres_share_a_shape) {
  write(kThree);
  const std::vector<NewBody> born = emit(*make());
  EXPECT_EQ(born[0].shape, born[1].shape);
  EXPECT_NE(born[0].shape, born[2].shape);
  EXPECT_EQ(services.shapes().primitives()[born[2].shape].size.x, 0.004);
}

TEST_F(bed, a_limit_takes_the_first_ones) {
  write(kThree);
  EXPECT_EQ(emit(*make("limit = 2")).size(), 2U);
  EXPECT_EQ(emit(*make("limit = 9")).size(), 3U);
}

TEST_F(bed, walls_stand_around_the_box_of_the_file) {
  write(kThree);
  const std::vector<NewBody> born = emit(*make("walls = 'glass'"));
  ASSERT_EQ(born.size(), 8U);  // a floor and four walls first
  const Vec3 inside{0.001, -0.002, 0.003};
  double walls = 0.0, floors = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(born[i].motion, Motion::fixed);
    const Vec3 normal = rotate(born[i].pose.orientation, {0, 0, 1});
    // The height of an inner point above every plane is its distance from the side of the box, to rounding.
    const double height = dot(normal, inside - born[i].pose.position);
    const double side = 0.025 + normal.x * inside.x + normal.y * inside.y;
    EXPECT_NEAR(height, normal.z > 0.5 ? inside.z : side, 1e-15);
    (normal.z > 0.5 ? floors : walls) += 1.0;
  }
  EXPECT_EQ(floors, 1.0);
  EXPECT_EQ(walls, 4.0);
}

TEST_F(bed, is_not_added_again_after_a_restart) {
  write(kThree);
  const auto before = make(), after = make();
  emit(*before);
  MemoryState saved;
  before->save(saved.writer());
  after->load(saved.reader());
  EXPECT_TRUE(emit(*after).empty());
}

TEST_F(bed, bad_rows_are_refused_at_their_line) {
  const std::string line = file.filename().string() + ":2:1: ";
  const std::string row = "is not a sphere: x y z r vx vy vz in SI units, seven finite numbers with r > 0";
  EXPECT_EQ(refusal("1 1\n1 2 3 0.1 0 0\n"), line + "'1 2 3 0.1 0 0' " + row);
  EXPECT_EQ(refusal("1 1\n1 2 3 0.1 0 0 0 0\n"), line + "'1 2 3 0.1 0 0 0 0' " + row);
  EXPECT_EQ(refusal("1 1\n1 2 3 -0.1 0 0 0\n"), line + "'1 2 3 -0.1 0 0 0' " + row);
  EXPECT_EQ(refusal("1 1\n1 2 nan 0.1 0 0 0\n"), line + "'1 2 nan 0.1 0 0 0' " + row);
  EXPECT_EQ(refusal("1 1\n1 2 3mm 0.1 0 0 0\n"), line + "'1 2 3mm 0.1 0 0 0' " + row);
}

TEST_F(bed, a_wrong_head_or_count_is_refused) {
  const std::string name = file.filename().string();
  EXPECT_NE(refusal("").find("the bed file is empty"), std::string::npos);
  for (const char* head : {"x 1\n", "1\n", "1.5 1\n", "0 1\n", "1 -1\n", "1 1 1\n"})
    EXPECT_NE(refusal(head).find(name + ":1:1: '"), std::string::npos) << head;
  const std::string row = "0 0 0 1 0 0 0\n";
  EXPECT_EQ(refusal("2 1\n" + row), name +
                                        ":2:1: the first line promises 2 spheres, but the file ends after 1; correct "
                                        "the first line, or complete the file");
  EXPECT_EQ(refusal("1 1\n" + row + row),
            name + ":3:1: the first line promises 1 spheres, but there are more rows; correct the first line");
}

TEST_F(bed, a_missing_file_is_named) {
  try {
    make();
    FAIL() << "a missing file was accepted";
  } catch (const Error& problem) {
    EXPECT_EQ(problem.kind(), ErrorKind::io);
    EXPECT_NE(std::string{problem.what()}.find(file.string()), std::string::npos);
  }
}

TEST_F(bed, an_unknown_material_is_refused) {
  write(kThree);
  EXPECT_THROW(make("", "gold"), Error);
}

}  // namespace
}  // namespace scree
