#include "scan_family.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "emitter.hpp"
#include "fill.hpp"
#include "scree/base/error.hpp"
#include "testing_feed.hpp"

namespace scree {
namespace {

using testing_feed::FeedScene;

/// A plate of 2 x 4 x 0.5 mm of 12 mg (I = m (a^2 + b^2) / 12) and a square one of 3 x 3 x 1 mm of 20 mg, of material 7; and
/// a hexagon of material 8. Their densities are 3000 and 2222 kg/m3.
const std::string kPlates =
    "7 1 0.5 12 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2 NaN NaN NaN NaN\n"
    "7 2 1 20 16.67 16.67 30 4 0 3 3 0 0 0 3 3 NaN NaN NaN NaN\n";
const std::string kHexagon = "8 1 1 10 4 4 7 6 2 1 -1 -2 -1 1 0 1.7 1.7 0 -1.7 -1.7\n";
const std::string kBad = "7 3 0.5 -12 16.25 4.25 20 4 -1 1 1 -1 -2 -2 2 2\n7 4 what\n";

class ScanFamily : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  std::string family(const std::string& table, const std::string& more = "", const std::string& keys = "") {
    std::ofstream{file_} << table;
    return "{name = 'scan', material = 'copper', " + keys + " shape = {type = 'scan', file = '" + file_.string() + "'" +
           more + "}}";
  }
  Mixture mixture(const std::string& family) {
    return Mixture{options_from_text("families = [" + family + "]", Mixture::parameters()), scene_.services};
  }
  std::string refusal(const std::string& family) {
    try {
      (void)mixture(family);
    } catch (const Error& problem) {
      return problem.what();
    }
    return "accepted";
  }
  bool logged(const std::string& words) const {
    return std::ranges::any_of(scene_.services.log_lines(),
                               [&](const std::string& line) { return line.find(words) != std::string::npos; });
  }

  FeedScene scene_;
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("scree_scan_" + std::to_string(::getpid()) + ".txt");
};

TEST_F(ScanFamily, particles_have_mass_and_inertia_of_the_table) {
  const Mixture scans = mixture(family(kPlates));
  RandomStream random{1, "test"};
  std::set<double> masses;
  for (int i = 0; i < 40; ++i) {
    const Particle particle = scans.draw(random);
    masses.insert(std::round(particle.body.mass * 1e9));
    const bool thin = particle.body.mass < 15e-6;
    const Vec3 inertia = thin ? Vec3{16.25e-12, 4.25e-12, 20e-12} : Vec3{16.67e-12, 16.67e-12, 30e-12};
    // Mass and inertia go through density and size and back: some roundings.
    EXPECT_NEAR(particle.body.mass, thin ? 12e-6 : 20e-6, 1e-18);
    EXPECT_NEAR(norm(particle.body.inertia - inertia), 0.0, 1e-24);
    EXPECT_NEAR(particle.body.radius, std::cbrt(3 * (thin ? 4e-9 : 9e-9) / (4 * M_PI)), 1e-15);
  }
  EXPECT_EQ(masses.size(), 2u) << "both rows are drawn";
}

TEST_F(ScanFamily, a_row_is_one_shape_whose_spheres_fill_the_prism) {
  const Mixture scans = mixture(family(kPlates));
  EXPECT_EQ(scene_.services.shapes().shapes().size(), 2u);
  RandomStream random{1, "test"};
  const Particle particle = scans.draw(random);
  EXPECT_FALSE(particle.shape.has_value());
  const ShapeSet& shapes = scene_.services.shapes();
  for (const Shape& shape : shapes.shapes()) {
    const Primitive& part = shapes.primitives(shape)[0];
    const auto spheres = shapes.spheres().subspan(part.first_sphere, part.sphere_count);
    const std::vector<Sphere> all{spheres.begin(), spheres.end()};
    EXPECT_NEAR(cluster_mass_properties(all).volume / shape.volume, 1.0, kVolumeLimit);
    // The plates lie flat in their own frame: centres near the plane z = 0, within the outline.
    for (const Sphere& sphere : all) {
      EXPECT_LE(std::abs(sphere.centre.z), 0.5e-3);
      EXPECT_LE(std::hypot(sphere.centre.x, sphere.centre.y), 2.3e-3);
    }
  }
}

TEST_F(ScanFamily, bad_rows_are_refused_with_their_place_or_skipped_and_counted) {
  const std::string sentence = refusal(family(kPlates + kBad));
  EXPECT_NE(sentence.find(".txt:3: its mass is -12"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("2 bad rows"), std::string::npos) << sentence;

  const Mixture scans = mixture(family(kPlates + kBad + kHexagon, ", bad_rows = 'skip', material_id = 7"));
  EXPECT_TRUE(logged(".txt:3: its mass is -12"));
  EXPECT_TRUE(logged(".txt:4: 'what' in column 3 is no number"));
  const std::vector<ReportTable> report = scans.report();
  ASSERT_EQ(report.size(), 1u);
  EXPECT_EQ(report[0].rows[0], (std::vector<std::string>{"2", "2", "1"}));
}

TEST_F(ScanFamily, a_cluster_beyond_the_limits_is_a_bad_row) {
  // One sphere for a plate of 1 : 8.
  const std::string sentence = refusal(family(kPlates, ", max_spheres = 1"));
  EXPECT_NE(sentence.find("1 spheres come within"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find(".txt:1:"), std::string::npos) << sentence;
}

TEST_F(ScanFamily, says_when_nothing_is_left_or_a_law_is_given_as_well) {
  EXPECT_NE(refusal(family(kBad, ", bad_rows = 'skip'")).find("no row to use: 2 are bad"), std::string::npos);
  EXPECT_NE(refusal(family(kHexagon, ", material_id = 1")).find("1 are of other materials"), std::string::npos);
  EXPECT_NE(refusal(family(kHexagon, "", "size = 1e-3,")).find("is measured"), std::string::npos);
  EXPECT_NE(refusal(family(kHexagon, "", "density = 1e3,")).find("is measured"), std::string::npos);
  EXPECT_NE(refusal("{name = 's', material = 'copper', shape = 'sphere'}").find("needs 'size'"), std::string::npos);
}

TEST_F(ScanFamily, the_share_by_mass_knows_the_measured_masses) {
  // Half the mass each: plates of 16 mg on average and spheres of 8.4 g/cm3 and 2 mm, 35.2 mg.
  const std::string toml = "share_by = 'mass'\nfamilies = [" + family(kPlates) +
                           ", {name = 'ball', material = 'copper', size = 2e-3, shape = 'sphere'}]";
  const Mixture both{options_from_text(toml, Mixture::parameters()), scene_.services};
  RandomStream random{5, "test"};
  double plates = 0.0, balls = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double mass = both.draw(random).body.mass;
    (mass < 30e-6 ? plates : balls) += mass;
  }
  EXPECT_NEAR(plates / (plates + balls), 0.5, 0.015);  // three standard deviations of 20 000 draws and of the mean mass
}

TEST_F(ScanFamily, sources_report_the_rows) {
  const std::string families = "families = [" + family(kPlates + kBad, ", bad_rows = 'skip'") + "]\n";
  const auto emitter =
      scene_.make<Emitter>("rate = 100\ncentre = [0, 0, 0]\nu = [0.1, 0, 0]\nv = [0, 0.1, 0]\n" + families);
  EXPECT_EQ(emitter->report().size(), 1u);
  const auto fill = scene_.make<Fill>("count = 5\nlower = [0, 0, 0]\nupper = [0.1, 0.1, 0.1]\n" + families);
  EXPECT_EQ(fill->report().at(0).rows.at(0).at(1), "2");
}

}  // namespace
}  // namespace scree
