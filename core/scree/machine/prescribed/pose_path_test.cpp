// Paths: poses over time from a file.
#include "scree/machine/prescribed/pose_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace scree {
namespace {

std::filesystem::path file_with(const std::string& text) {
  std::filesystem::path file = std::filesystem::path{testing::TempDir()} / "scree_pose_path_test.csv";
  std::ofstream{file} << text;
  return file;
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(PosePath::read(file_with(text), {"scene.toml", 7, 1}));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(pose_path, goes_straight_between_positions_and_holds_the_ends) {
  const PosePath path = PosePath::read(file_with("time, x, y, z\n1, 0, 0, 0\n2, 1, 2, 3\n4, 1, 0, 3\n"), {});
  EXPECT_FALSE(path.has_orientations());
  EXPECT_EQ(path.at(0.0).position, (Vec3{0, 0, 0}));
  EXPECT_LT(norm(path.at(1.5).position - Vec3{0.5, 1, 1.5}), 1e-15);
  EXPECT_LT(norm(path.at(3.0).position - Vec3{1, 1, 3}), 1e-15);
  EXPECT_EQ(path.at(9.0).position, (Vec3{1, 0, 3}));
}

// A quarter turn about z, by the shortest way although the second quaternion is written with the other sign.
TEST(pose_path, turns_evenly_by_the_shortest_way) {
  const PosePath path = PosePath::read(
      file_with("0, 0, 0, 0, 1, 0, 0, 0\n1, 0, 0, 0, -0.70710678118654757, 0, 0, -0.70710678118654757\n"), {});
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const double angle = share * std::numbers::pi / 2;
    EXPECT_LT(norm(rotate(path.at(share).orientation, {1, 0, 0}) - Vec3{std::cos(angle), std::sin(angle), 0}), 1e-15);
  }
}

TEST(pose_path, rotation_vector_inverts_the_exponential_map) {
  for (const Vec3& v : {Vec3{}, Vec3{1e-9, 0, 2e-9}, Vec3{0.3, -0.2, 0.9}, Vec3{0, 3.1, 0}}) {
    const Quat q = from_rotation_vector(v);
    EXPECT_LT(norm(rotation_vector(q) - v), 1e-14);
    EXPECT_LT(norm(rotation_vector(Quat{-q.w, -q.x, -q.y, -q.z}) - v), 1e-14);
  }
}

TEST(pose_path, bad_rows_are_named_by_their_line) {
  EXPECT_NE(refusal("0, 0, 0, 0\n1, 0, 0, 0\n0.5, 0, 0, 0\n").find(".csv:3: the time 0.5 s does not come after 1 s"),
            std::string::npos);
  EXPECT_NE(refusal("0, 0, 0, 0\n1, 0, 0\n").find(".csv:2: the row has 3 numbers; it needs four"), std::string::npos);
  EXPECT_NE(
      refusal("0, 0, 0, 0\n1, 0, 0, 0, 1, 0, 0, 0\n").find(".csv:2: the row has 8 numbers, but those before it have 4"),
      std::string::npos);
  EXPECT_NE(
      refusal("0, 0, 0, 0, 1, 0, 0, 0\n1, 0, 0, 0, 1, 1, 0, 0\n").find(".csv:2: the quaternion has the length 1.41"),
      std::string::npos);
  EXPECT_NE(refusal("").find("scene.toml:7:1: the file "), std::string::npos);
}

}  // namespace
}  // namespace scree
