// Cylinders, cones, ellipsoids and meshes inside a hollow cylinder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "farthest_on_ellipse.hpp"
#include "polyhedron.hpp"
#include "support/trials.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;
constexpr double kReach = 0.05;
constexpr double kRounding = 1e-12;  // of numbers near one

Quat about(const Vec3& axis, double angle) {
  const Vec3 v = std::sin(0.5 * angle) * axis;
  return {std::cos(0.5 * angle), v.x, v.y, v.z};
}

/// A drum of radius 1 and half length 2 with one solid in it, at the origin.
ContactBuffer in_drum(const PrimitiveData& solid, const Pose& pose, double reach = kReach) {
  PairScene scene{primitive_data(ShapeKind::cylinder, {1, 2, 0}, true), solid};
  Polyhedron phase;
  return scene.collide(phase, {}, pose, reach);
}

// Law: a point is farthest where no point of a fine walk around the ellipse is farther, and a second one is farther than all
// next to it; the walk finds just as many such places.
TEST(FarthestOnEllipse, is_where_a_walk_finds_it) {
  RandomNumbers random{3};
  constexpr int kStations = 20000;
  int second = 0;
  for (int trial = 0; trial < trials(300); ++trial) {
    const double alpha = random.decades(1e-3, 1.0);
    const double beta = trial % 5 == 0 ? 0.0 : (trial % 5 == 1 ? alpha : alpha * random.uniform(0.0, 1.0));
    const double far = random.decades(1e-3, 10.0) * alpha, angle = random.uniform(-kPi, kPi);
    const double x = trial % 7 == 0 ? 0.0 : far * std::cos(angle), y = trial % 7 == 1 ? 0.0 : far * std::sin(angle);
    const auto distance = [&](double c, double s) { return std::hypot(x + alpha * c, y + beta * s); };
    double greatest = 0.0;
    std::vector<double> walk;
    for (int k = 0; k < kStations; ++k) {
      walk.push_back(distance(std::cos(2 * kPi * k / kStations), std::sin(2 * kPi * k / kStations)));
      greatest = std::max(greatest, walk.back());
    }
    const polyhedron::FarthestPoints found = polyhedron::farthest_on_ellipse(alpha, beta, x, y);
    ASSERT_GE(found.count, 1u);
    const auto at = [&](std::size_t k) { return distance(found.point[k].cosine, found.point[k].sine); };
    // Between two stations a distance bends by less than (alpha + far) (pi / 20000)^2 = 2.5e-8 of them.
    EXPECT_NEAR(at(0), greatest, 3e-8 * (alpha + far)) << trial;
    EXPECT_GE(at(0), greatest - 1e-14 * (alpha + far)) << trial;
    if (found.count == 1) continue;
    ++second;
    EXPECT_LE(at(1), at(0) + 1e-14 * (alpha + far));
    const double t = std::atan2(found.point[1].sine, found.point[1].cosine);
    for (const double step : {-1e-4, 1e-4})
      EXPECT_LE(distance(std::cos(t + step), std::sin(t + step)), at(1) + 1e-14 * (alpha + far)) << trial;
  }
  EXPECT_GT(second, 20) << "too few with two such places to show anything";
}

// A cylinder of radius 0.3 and half length 0.5 along the drum, its axis 0.69 from the drum's: gap 1 - 0.69 - 0.3, at the
// end of both rims, so that it lies on a line.
TEST(RoundInDrum, a_cylinder_along_it_lies_on_a_line) {
  const ContactBuffer contacts = in_drum(primitive_data(ShapeKind::cylinder, {0.3, 0.5, 0}), {{0, -0.69, 0.2}, {}});
  ASSERT_EQ(contacts.size(), 2u);
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.gap, 0.01, kRounding);
    EXPECT_NEAR(c.normal.y, 1.0, kRounding);
    EXPECT_NEAR(c.point.y, -0.995, kRounding);
  }
  EXPECT_NEAR(contacts[0].point.z, -0.3, kRounding);
  EXPECT_NEAR(contacts[1].point.z, 0.7, kRounding);
}

// A cylinder of half length b across the drum with its middle at (0, -y) touches with two places of each rim where a disc
// seen edge on, from (-b, -y - a) to (-b, -y + a), ends: the lower two lie sqrt(b^2 + (y + a)^2) from the axis.
TEST(RoundInDrum, a_cylinder_across_it_stands_on_two_places) {
  const double a = 0.2, b = 0.6, y = 0.59;
  const ContactBuffer contacts =
      in_drum(primitive_data(ShapeKind::cylinder, {a, b, 0}), {{0, -y, 0}, about({0, 1, 0}, 0.5 * kPi)});
  ASSERT_EQ(contacts.size(), 2u);
  const double rho = std::hypot(b, y + a);
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.gap, 1.0 - rho, kRounding);
    EXPECT_NEAR(std::abs(c.normal.x), b / rho, kRounding);
    EXPECT_NEAR(c.normal.y, (y + a) / rho, kRounding);
    EXPECT_NEAR(c.point.z, 0.0, kRounding);
  }
  EXPECT_LT(contacts[0].normal.x * contacts[1].normal.x, 0.0) << "one to each side";
}

// On its lid: three places of the lower rim, 120 degrees apart, each of the height of the lid; and a plug that fits the
// drum, 1 mm less in radius, is held all around.
TEST(RoundInDrum, a_standing_cylinder_is_held_from_all_sides) {
  const ContactBuffer standing = in_drum(primitive_data(ShapeKind::cylinder, {0.3, 0.5, 0}), {{0.1, 0, -1.501}, {}});
  ASSERT_EQ(standing.size(), 3u);
  Vec3 mean;
  for (const Contact& c : standing) {
    EXPECT_NEAR(c.gap, -0.001, kRounding);
    EXPECT_NEAR(c.normal.z, 1.0, kRounding);
    EXPECT_NEAR(std::hypot(c.point.x - 0.1, c.point.y), 0.3, kRounding);
    mean += c.point / 3.0;
  }
  EXPECT_NEAR(std::hypot(mean.x - 0.1, mean.y), 0.0, kRounding);
  const ContactBuffer plug = in_drum(primitive_data(ShapeKind::cylinder, {0.999, 0.5, 0}), {});
  ASSERT_EQ(plug.size(), 6u);
  Vec3 sum;
  for (const Contact& c : plug) {
    EXPECT_NEAR(c.gap, 0.001, kRounding);
    sum += c.normal;
  }
  EXPECT_NEAR(norm(sum), 0.0, kRounding);
}

// A cone of base radius a and half height h whose mantle's line lies along the drum's: the apex and one point of the rim,
// both at the drum's radius less the gap.
TEST(RoundInDrum, a_cone_lies_on_its_mantle) {
  const double a = 0.3, h = 0.5, gap = 0.004, slope = std::atan2(a, 2.0 * h);
  const Quat turn = about({1, 0, 0}, slope);  // the mantle's lowest line becomes level
  const Vec3 apex = rotate(turn, Vec3{0, 0, h});
  const ContactBuffer contacts =
      in_drum(primitive_data(ShapeKind::cone, {a, h, 0}), {{0, -(1.0 - gap) - apex.y, 0}, turn});
  ASSERT_EQ(contacts.size(), 2u);
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.gap, gap, kRounding);
    EXPECT_NEAR(c.normal.y, 1.0, kRounding);
  }
  EXPECT_NEAR(std::abs(contacts[0].point.z - contacts[1].point.z), std::hypot(2.0 * h, a), kRounding);
}

// An ellipsoid with half axes a along x and b along y, its middle on the drum's axis, touches with both ends of a; moved
// down by y < (a^2 - b^2) / b it touches at sin t = b y / (a^2 - b^2), a cos t to both sides; beyond that at its lowest point.
TEST(RoundInDrum, an_ellipsoid_touches_with_one_place_or_two) {
  const double a = 0.98, b = 0.4;
  const PrimitiveData solid = primitive_data(ShapeKind::ellipsoid, {a, b, 0.7});
  for (const double y : {0.0, 0.1, 0.2}) {
    const ContactBuffer contacts = in_drum(solid, {{0, -y, 0.3}, {}});
    ASSERT_EQ(contacts.size(), 2u);
    const double sine = b * y / (a * a - b * b), cosine = std::sqrt(1.0 - sine * sine);
    for (const Contact& c : contacts) {
      EXPECT_NEAR(c.gap, 1.0 - std::hypot(a * cosine, y + b * sine), kRounding);
      EXPECT_NEAR(c.point.z, 0.3, kRounding);
    }
    EXPECT_NEAR(contacts[0].normal.x + contacts[1].normal.x, 0.0, kRounding);
  }
  const ContactBuffer low = in_drum(primitive_data(ShapeKind::ellipsoid, {0.3, 0.2, 0.7}), {{0, -0.79, 1.29}, {}});
  ASSERT_EQ(low.size(), 2u) << "the mantle and a lid";
  EXPECT_NEAR(low[0].gap, 0.01, kRounding);
  EXPECT_NEAR(low[0].normal.y, 1.0, kRounding);
  EXPECT_NEAR(low[1].gap, 0.01, kRounding);
  EXPECT_NEAR(low[1].normal.z, -1.0, kRounding);
}

// Law: a mesh is inside when its corners are: it has the contacts of the hull of the same corners, were it not hollowed out.
TEST(RoundInDrum, a_mesh_is_held_by_its_corners) {
  RandomNumbers random{7};
  std::size_t found = 0;
  for (int trial = 0; trial < trials(100); ++trial) {
    const Solid hull = random_hull(random, 16, 0.4);
    PrimitiveData mesh = hull.data;
    mesh.primitive.kind = ShapeKind::triangle_mesh;
    mesh.faces.clear();
    const Pose pose{random.in_cube(0.75), random.rotation()};
    const auto gaps = [&](const PrimitiveData& solid) {
      std::vector<double> list;
      for (const Contact& c : in_drum(solid, pose)) list.push_back(c.gap);
      std::ranges::sort(list);
      return list;
    };
    const std::vector<double> of_mesh = gaps(mesh), of_hull = gaps(hull.data);
    ASSERT_EQ(of_mesh.size(), of_hull.size());
    for (std::size_t k = 0; k < of_mesh.size(); ++k) EXPECT_NEAR(of_mesh[k], of_hull[k], kRounding);
    found += of_mesh.size();
  }
  EXPECT_GT(found, 50u);
}

// Law: what is far outside or floats in the middle touches nothing.
TEST(RoundInDrum, outside_is_left) {
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid}) {
    const PrimitiveData solid = primitive_data(kind, {0.1, 0.1, 0.1});
    for (const Vec3& at : {Vec3{1.3, 0, 0}, Vec3{0, 0, -2.3}, Vec3{}}) EXPECT_TRUE(in_drum(solid, {at, {}}).empty());
    EXPECT_FALSE(in_drum(solid, {{0.9, 0, 0}, {}}).empty());
  }
}

}  // namespace
}  // namespace scree
