#include "scree/geometry/mass_properties.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

using testing_random::Random;
constexpr double kPi = std::numbers::pi;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

void expect_near(const Mat3& a, const Mat3& b, double tolerance) {
  expect_near(a.row0, b.row0, tolerance);
  expect_near(a.row1, b.row1, tolerance);
  expect_near(a.row2, b.row2, tolerance);
}

/// Volume, centre and inertia matrix by integrating discs of radius f(z), z in [-h, h], with the midpoint rule: an
/// independent way to every solid of revolution, good to (h / n)^2 for smooth profiles.
template <typename Profile>
void expect_revolution(const MassProperties& properties, Profile profile, double h, double tolerance) {
  constexpr int n = 20000;
  double volume = 0, first = 0, along = 0, second = 0;
  for (int i = 0; i < n; ++i) {
    const double z = -h + (2.0 * i + 1.0) * h / n, r = profile(z), slice = kPi * r * r * 2.0 * h / n;
    volume += slice;
    first += slice * z;
    second += slice * z * z;
    along += 0.5 * slice * r * r;
  }
  const double centre = first / volume;
  const double across = 0.5 * along + second - volume * centre * centre;
  EXPECT_NEAR(properties.volume / volume, 1.0, tolerance);
  EXPECT_NEAR(properties.centre.z, centre, tolerance * h);
  EXPECT_NEAR(properties.inertia.x / across, 1.0, tolerance);
  EXPECT_NEAR(properties.inertia.y / across, 1.0, tolerance);
  EXPECT_NEAR(properties.inertia.z / along, 1.0, tolerance);
  EXPECT_EQ(properties.orientation, Quat{});
}

// The midpoint rule with 20 000 slices is good to about 1e-8 for these profiles.
TEST(mass_properties, closed_forms_agree_with_the_integral_over_discs) {
  const auto ball = [](double z) { return std::sqrt(std::max(0.0, 4.0 - z * z)); };
  expect_revolution(sphere_mass_properties(2.0), ball, 2.0, 1e-6);
  expect_revolution(
      cylinder_mass_properties(0.7, 1.5), [](double) { return 0.7; }, 1.5, 1e-6);
  expect_revolution(
      cone_mass_properties(0.7, 1.5), [](double z) { return 0.7 * (1.5 - z) / 3.0; }, 1.5, 1e-6);
  const auto capsule = [](double z) {
    const double beyond = std::max(0.0, std::abs(z) - 1.0);
    return std::sqrt(std::max(0.0, 0.25 - beyond * beyond));
  };
  expect_revolution(capsule_mass_properties(0.5, 1.0), capsule, 1.5, 1e-6);
}

TEST(mass_properties, textbook_values) {
  const MassProperties ball = sphere_mass_properties(0.5);
  EXPECT_DOUBLE_EQ(ball.volume, kPi / 6.0);
  EXPECT_DOUBLE_EQ(ball.inertia.x / ball.volume, 0.1);  // 2/5 r^2
  const MassProperties brick = box_mass_properties({0.5, 1.0, 1.5});
  EXPECT_DOUBLE_EQ(brick.volume, 6.0);
  expect_near(brick.inertia / brick.volume, {13.0 / 12.0, 10.0 / 12.0, 5.0 / 12.0}, 1e-14);
  const MassProperties cone = cone_mass_properties(1.0, 1.0);
  EXPECT_DOUBLE_EQ(cone.volume, kPi * 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(cone.centre.z, -0.5);  // a quarter of the height above the base
}

TEST(mass_properties, a_box_as_a_mesh_has_the_closed_form) {
  const MassProperties closed = box_mass_properties({0.5e-3, 1e-3, 2e-3});
  const MassProperties mesh = mesh_mass_properties(box_mesh({0.5e-3, 1e-3, 2e-3}));
  EXPECT_NEAR(mesh.volume / closed.volume, 1.0, 1e-14);
  expect_near(mesh.inertia / closed.inertia.x, closed.inertia / closed.inertia.x, 1e-13);
  EXPECT_EQ(mesh.orientation, Quat{});
}

// The inscribed prism of n sides misses a share of 2/3 (pi/n)^2 of the area: the error falls with the square.
TEST(mass_properties, a_cylinder_mesh_converges_to_the_closed_form_at_second_order) {
  const MassProperties closed = cylinder_mass_properties(1.0, 0.5);
  double previous = 0.0;
  for (const int sides : {16, 32, 64, 128}) {
    const MassProperties mesh = mesh_mass_properties(cylinder_mesh(1.0, 0.5, sides));
    const double error = 1.0 - mesh.volume / closed.volume;
    EXPECT_NEAR(error, 2.0 / 3.0 * kPi * kPi / (sides * sides), 0.02 * error);
    if (previous > 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.1);
    }
    EXPECT_NEAR(mesh.inertia.z / closed.inertia.z, 1.0, 3.0 * error);
    previous = error;
  }
}

TEST(mass_properties, a_rotated_moved_mesh_gives_back_its_moments_and_axes) {
  Random random{1};
  const Vec3 half{1.0, 2.0, 3.5};
  const MassProperties closed = box_mass_properties(half);
  for (int trial = 0; trial < 100; ++trial) {
    const Pose pose{random.in_box({-9, -9, -9}, {9, 9, 9}), random.rotation()};
    TriangleMesh mesh = box_mesh(half);
    for (Vec3& v : mesh.vertices) v = transform(pose, v);
    const MassProperties found = mesh_mass_properties(mesh);
    EXPECT_NEAR(found.volume, closed.volume, 1e-11 * closed.volume);
    expect_near(found.centre, pose.position, 1e-11);
    // The order of the moments may differ; their set may not, and the matrix built from them may not.
    std::array<double, 3> a{found.inertia.x, found.inertia.y, found.inertia.z};
    std::array<double, 3> b{closed.inertia.x, closed.inertia.y, closed.inertia.z};
    std::ranges::sort(a);
    std::ranges::sort(b);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k] / b[k], 1.0, 1e-11);
    expect_near(inertia_matrix(found), inertia_matrix(placed(closed, pose)), 1e-10 * b[2]);
    const double norm_of_q = squared_norm({found.orientation.x, found.orientation.y, found.orientation.z}) +
                             found.orientation.w * found.orientation.w;
    EXPECT_NEAR(norm_of_q, 1.0, 1e-12);  // a unit quaternion is a right-handed frame
  }
}

TEST(mass_properties, small_rotations_keep_the_order_of_the_axes) {
  const MassProperties closed = box_mass_properties({3, 2, 1});  // moments in falling order along x, y, z reversed
  const Quat small = from_rotation_vector({0.1, -0.2, 0.15});
  const MassProperties found = to_mass_properties(to_moments(placed(closed, {{}, small})));
  expect_near(found.inertia, closed.inertia, 1e-10);
  EXPECT_NEAR(std::abs(found.orientation.w), small.w, 1e-10);
  EXPECT_GE(found.orientation.w, 0.0);
}

TEST(mass_properties, moments_and_properties_are_inverse) {
  Random random{2};
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose{random.in_box({-2, -2, -2}, {2, 2, 2}), random.rotation()};
    const MassProperties p = placed(box_mass_properties({0.3, 0.5, 0.9}), pose);
    const MassProperties back = to_mass_properties(to_moments(p));
    EXPECT_NEAR(back.volume, p.volume, 1e-13);
    expect_near(back.centre, p.centre, 1e-13);
    expect_near(inertia_matrix(back), inertia_matrix(p), 1e-12);
  }
}

TEST(mass_properties, two_half_boxes_compose_to_the_whole) {
  const MassProperties half = box_mass_properties({0.5, 1, 2});
  const std::array parts{placed(half, {{-0.5, 0, 0}, {}}), placed(half, {{0.5, 0, 0}, {}})};
  const MassProperties whole = composed(parts), closed = box_mass_properties({1, 1, 2});
  EXPECT_NEAR(whole.volume, closed.volume, 1e-13);
  expect_near(whole.centre, {}, 1e-14);
  expect_near(whole.inertia, closed.inertia, 1e-12);
  EXPECT_EQ(whole.orientation, Quat{});
}

TEST(mass_properties, a_hole_is_a_part_of_negative_density) {
  const std::array parts{WeightedPart{cylinder_mass_properties(1.0, 0.5), 1.0},
                         WeightedPart{cylinder_mass_properties(0.6, 0.5), -1.0}};
  const MassProperties tube = composed(parts);
  EXPECT_NEAR(tube.volume, kPi * (1.0 - 0.36), 1e-13);
  EXPECT_NEAR(tube.inertia.z / tube.volume, 0.5 * (1.0 + 0.36), 1e-13);  // (r1^2 + r2^2) / 2
}

TEST(mass_properties, a_composition_does_not_depend_on_the_order_of_its_parts) {
  Random random{3};
  std::vector<MassProperties> parts;
  for (int i = 0; i < 6; ++i) {
    const Vec3 half = random.in_box({0.1, 0.1, 0.1}, {1, 1, 1});
    parts.push_back(placed(box_mass_properties(half), {random.in_box({-3, -3, -3}, {3, 3, 3}), random.rotation()}));
  }
  const MassProperties first = composed(parts);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(parts.begin(), parts.end(), random.engine());
    const MassProperties again = composed(parts);
    EXPECT_NEAR(again.volume, first.volume, 1e-12);
    expect_near(again.centre, first.centre, 1e-12);
    expect_near(inertia_matrix(again), inertia_matrix(first), 1e-10);
    expect_near(again.inertia, first.inertia, 1e-10);
  }
}

TEST(mass_properties, an_ellipsoid_is_a_stretched_ball) {
  // Second moments of volume scale with their own axis squared, times the volume's factor.
  const double a = 0.5, b = 0.2, c = 0.7;
  const MassProperties ball = sphere_mass_properties(1.0), found = ellipsoid_mass_properties({a, b, c});
  const double second = 0.5 * ball.inertia.x;  // integral of x^2 over the unit ball
  EXPECT_NEAR(found.volume, ball.volume * a * b * c, 1e-15);
  expect_near(found.inertia, second * a * b * c * Vec3{b * b + c * c, a * a + c * c, a * a + b * b}, 1e-15);
}

TEST(mass_properties, scaling_goes_with_the_third_and_fifth_power) {
  const MassProperties small = scaled(cone_mass_properties(1.0, 2.0), 1e-3);
  const MassProperties closed = cone_mass_properties(1e-3, 2e-3);
  EXPECT_NEAR(small.volume / closed.volume, 1.0, 1e-14);
  EXPECT_NEAR(small.centre.z / closed.centre.z, 1.0, 1e-14);
  expect_near(small.inertia / closed.inertia.z, closed.inertia / closed.inertia.z, 1e-13);
}

TEST(mass_properties, refuses_meshes_that_are_not_solids_and_says_why) {
  TriangleMesh open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  try {
    (void)mesh_mass_properties(open);
    FAIL() << "an open mesh was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("holes"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)mesh_mass_properties(turned_inside_out(box_mesh({1, 1, 1}))), Error);
  EXPECT_THROW((void)to_mass_properties({}), Error);
}

}  // namespace
}  // namespace scree
