#include "scree/geometry/scan_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "scree/base/error.hpp"

namespace scree {
namespace {

// A plate of 2 x 4 x 0.5 mm of 12 mg: I1 = m (4^2 + 0.5^2) / 12 = 16.25, I2 = m (2^2 + 0.5^2) / 12 = 4.25,
// I3 = m (2^2 + 4^2) / 12 = 20 mg mm2.
const std::string kHead = "0.5 12 16.25 4.25 20 ";
const std::string kPlate = "7 1 " + kHead + "4 -1 1 1 -1 -2 -2 2 2\n";

ScanTable read(const std::string& text) {
  std::istringstream in{text};
  return read_scan_table(in);
}

/// The table has one row, which is refused for this reason.
void expect_refused(const std::string& row, const std::string& words) {
  const ScanTable table = read(row + "\n");
  ASSERT_EQ(table.refused.size(), 1u) << row;
  EXPECT_TRUE(table.particles.empty());
  EXPECT_EQ(table.refused[0].line, 1);
  EXPECT_NE(table.refused[0].reason.find(words), std::string::npos) << table.refused[0].reason;
}

TEST(scan_table, a_row_becomes_a_prism_in_si) {
  const ScanTable table = read(kPlate);
  ASSERT_EQ(table.particles.size(), 1u);
  const ScannedParticle& plate = table.particles[0];
  EXPECT_EQ(plate.material, 7);
  EXPECT_EQ(plate.id, 1);
  EXPECT_EQ(plate.line, 1);
  EXPECT_DOUBLE_EQ(plate.mass, 12e-6);
  EXPECT_DOUBLE_EQ(plate.volume(), 4e-9);
  EXPECT_DOUBLE_EQ(plate.inertia.z, 20e-12);
  EXPECT_EQ(plate.corners().size(), 8u);
}

TEST(scan_table, outlines_run_either_way_round_and_lie_anywhere) {
  const ScanTable table =
      read(kPlate + "7 2 " + kHead + "4 -1 -1 1 1 -2 2 2 -2\n" + "7 3 " + kHead + "4 99 101 101 99 48 48 52 52\n");
  ASSERT_EQ(table.particles.size(), 3u);
  for (const ScannedParticle& particle : table.particles) {
    EXPECT_NEAR(particle.volume(), 4e-9, 1e-21);  // corners at 100 mm cost four digits of sixteen
    Vec3 centre;
    for (const Vec3& p : particle.outline) centre += p;
    EXPECT_NEAR(norm(centre), 0.0, 1e-15);  // of a rectangle: the mean of its corners
    const Vec3 &a = particle.outline[0], &b = particle.outline[1], &c = particle.outline[2];
    EXPECT_GT(cross(b - a, c - b).z, 0.0) << "counter-clockwise";
  }
}

TEST(scan_table, rows_are_filled_up_with_nan_in_any_of_three_ways) {
  const std::string triangle = " 0.5 6 3 1 4 ";
  const ScanTable table = read("1 1" + triangle + "3 -1 1 0 -2 -2 2 NaN NaN NaN\n" +      // behind everything
                               "1 2" + triangle + "3 -1 1 0 NaN NaN -2 -2 2 NaN NaN\n" +  // x and y each
                               "1 3" + triangle + "5 -1 1 0 NaN NaN -2 -2 2 NaN NaN\n");  // counted in N
  ASSERT_EQ(table.particles.size(), 3u) << (table.refused.empty() ? "" : table.refused[0].reason);
  for (const ScannedParticle& particle : table.particles) EXPECT_DOUBLE_EQ(particle.area, 4e-6);
}

TEST(scan_table, corners_that_repeat_or_lie_on_sides_do_no_harm) {
  const ScanTable table = read("7 1 " + kHead + "6 -1 0 1 1 -1 -1 -2 -2 -2 2 2 -2\n");
  ASSERT_EQ(table.particles.size(), 1u);
  EXPECT_EQ(table.particles[0].outline.size(), 4u);
  EXPECT_DOUBLE_EQ(table.particles[0].area, 8e-6);
}

TEST(scan_table, passes_over_comments_blank_lines_and_a_heading) {
  const ScanTable table = read("material, particle, thickness\n\n# mm and mg\n" + kPlate + "% end\n");
  EXPECT_EQ(table.particles.size(), 1u);
  EXPECT_TRUE(table.refused.empty());
  EXPECT_EQ(table.particles[0].line, 4);
}

TEST(scan_table, names_every_bad_row_and_keeps_the_rest) {
  const ScanTable table = read(kPlate + "7 2 x\n" + "7 3 " + kHead + "4 -1 1 1 -1 -2 -2 2 2\n" + "7 4 1\n");
  EXPECT_EQ(table.particles.size(), 2u);
  ASSERT_EQ(table.refused.size(), 2u);
  EXPECT_EQ(table.refused[0].line, 2);
  EXPECT_EQ(table.refused[1].line, 4);
}

TEST(scan_table, refuses_columns_that_are_no_numbers_missing_or_left_over) {
  expect_refused("7 1 0.5mm 12 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2", "'0.5mm' in column 3 is no number");
  expect_refused("7 1 0.5 12", "ends after 4 columns, before its I1");
  expect_refused("7 1 " + kHead, "before its N");
  expect_refused("7 1 " + kHead + "4 -1 1 1 -1 -2 -2 2", "need 8 coordinates, but it has 7");
  expect_refused("7 1 " + kHead + "4 -1 1 1 -1 -2 -2 2 2 5", "need 8 coordinates, but it has 9");
}

TEST(scan_table, refuses_values_that_no_particle_has) {
  expect_refused("7.5 1 " + kHead + "4 -1 1 1 -1 -2 -2 2 2", "material id is 7.5, which is no whole number");
  expect_refused("nan 1 " + kHead + "4 -1 1 1 -1 -2 -2 2 2", "material id is nan");
  expect_refused("7 1 0 12 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2", "thickness is 0");
  expect_refused("7 1 0.5 -12 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2", "mass is -12");
  expect_refused("7 1 0.5 inf 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2", "mass is inf");
  expect_refused("7 1 0.5 12 16.25 nan 20 4 -1 1 1 -1 -2 -2 2 2", "I2 is nan");
  expect_refused("7 1 " + kHead + "2 -1 1 -2 -2", "N is 2");
  expect_refused("7 1 " + kHead + "4.5 -1 1 1 -1 -2 -2 2 2", "N is 4.5");
  expect_refused("7 1 " + kHead + "1e12 -1 1 1 -1 -2 -2 2 2", "N is 1000000000000");
}

TEST(scan_table, refuses_nan_among_the_coordinates) {
  expect_refused("7 1 " + kHead + "4 -1 nan 1 -1 -2 -2 2 2", "corner 2 of its outline is (nan, -2)");
  expect_refused("7 1 " + kHead + "4 -1 1 1 nan -2 -2 2 2", "corner 4 of its outline is (nan, 2)");
  expect_refused("7 1 " + kHead + "4 -1 1 1 inf -2 -2 2 2", "corner 4");
  expect_refused("7 1 " + kHead + "4 -1 1 nan nan -2 -2 nan nan", "has 2 corners; 3 are the least");
}

TEST(scan_table, refuses_degenerate_and_concave_outlines) {
  expect_refused("7 1 " + kHead + "4 -1 0 1 2 -1 0 1 2", "no area");
  expect_refused("7 1 " + kHead + "4 1 1 1 1 2 2 2 2", "no area");
  expect_refused("7 1 " + kHead + "4 -1 1 -1 1 -2 -2 2 2", "not convex, or crosses itself");  // a bow tie
  expect_refused("7 1 " + kHead + "5 -1 1 1 0 -1 -2 -2 2 0 2", "not convex");                 // a notch
}

TEST(scan_table, refuses_moments_that_no_body_can_have) {
  expect_refused("7 1 0.5 12 4 4 20 4 -1 1 1 -1 -2 -2 2 2", "larger than the sum of the other two");
  // The largest I3 of 12 mg within a circle of 5 mm2 squared radius is 60 mg mm2; this one is in mg cm2 or kg.
  expect_refused("7 1 0.5 12 1625 425 2000 4 -1 1 1 -1 -2 -2 2 2", "check the units");
}

TEST(scan_table, refuses_a_particle_that_it_has_already) {
  const ScanTable table = read(kPlate + "8 1 " + kPlate.substr(4) + kPlate);
  EXPECT_EQ(table.particles.size(), 2u) << "another material may use the same number";
  ASSERT_EQ(table.refused.size(), 1u);
  EXPECT_NE(table.refused[0].reason.find("stands in line 1 already"), std::string::npos);
}

TEST(scan_table, a_file_must_exist_and_hold_a_row) {
  EXPECT_THROW((void)read_scan_file("/no/such/table.txt"), Error);
  EXPECT_THROW((void)read_scan_file("/dev"), Error);
}

}  // namespace
}  // namespace scree
