#include "continuum_observer.hpp"

#include <cmath>
#include <cstdlib>
#include <random>

#include "analysis/testing_observer.hpp"

namespace scree {
namespace {

constexpr const char* kScene =
    "grid = {lower = [0, 0, 0], upper = [1, 2, 1], cells = [8, 16, 10]}\nwidth = 0.15\ninterval = 0.01\n";

class ContinuumTest : public test::ObserverTest<ContinuumObserver> {
 protected:
  // Spheres in the lower half, moving along x with the height.
  void start() {
    std::mt19937_64 random{1};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    for (BodyId id = 1; id <= 300; ++id) {
      const Vec3 place{uniform(random), 2.0 * uniform(random), 0.5 * uniform(random)};
      bodies.add_sphere(id, place, 0.04, 2500.0, {place.z, 0, 0});
    }
  }
  [[nodiscard]] static bool runs(const std::string& command) { return std::system(command.c_str()) == 0; }
};

TEST_F(ContinuumTest, writes_fields_that_vtk_reads) {
  const auto observer = make(kScene);
  start();
  for (std::uint64_t step = 1; step <= 3; ++step) observer->observe(at(step), services.attributes());
  observer->finish(at(3));
  const std::string script =
      "import sys, vtk\n"
      "reader = vtk.vtkXMLImageDataReader(); reader.SetFileName(sys.argv[1]); reader.Update()\n"
      "data = reader.GetOutput()\n"
      "assert data.GetNumberOfCells() == 8 * 16 * 10, data.GetNumberOfCells()\n"
      "assert data.GetBounds() == (0.0, 1.0, 0.0, 2.0, 0.0, 1.0), data.GetBounds()\n"
      "arrays = data.GetCellData()\n"
      "assert arrays.GetArray('velocity').GetNumberOfComponents() == 3\n"
      "assert arrays.GetArray('kinetic_stress').GetNumberOfComponents() == 9\n"
      "cell = data.FindCell((0.5, 1.0, 0.25), None, 0, 1e-9, vtk.mutable(0), [0] * 3, [0] * 8)\n"
      "assert arrays.GetArray('density').GetValue(cell) > 100\n"
      "assert abs(arrays.GetArray('velocity').GetTuple(cell)[0] - 0.25) < 0.05\n"
      "assert arrays.GetArray('density').GetValue(8 * 16 * 10 - 1) == 0\n";
  services.claim_result("read.py");
  std::ofstream{folder / "read.py"} << script;
  EXPECT_TRUE(
      runs("/usr/bin/python3 " + (folder / "read.py").string() + " " + (folder / "continuum_00000003.vti").string()));
  EXPECT_TRUE(std::filesystem::exists(folder / "continuum.pvd"));
  EXPECT_TRUE(has_figure("continuum_slice"));
}

// The mass of the profile is that of the spheres, but for what reaches beyond the grid: at random places in the lower half about
// a tenth. Velocity follows the height.
TEST_F(ContinuumTest, writes_profiles_over_layers) {
  const auto observer = make(std::string{kScene} + "window = 0.02");
  start();
  for (std::uint64_t step = 1; step <= 6; ++step) observer->observe(at(step), services.attributes());
  observer->finish(at(6));
  const auto rows = csv("continuum_profile.csv");
  EXPECT_EQ(rows[0][2], "z [m]");
  ASSERT_EQ(rows.size(), 1u + 3u * 10u) << "three windows of two steps";
  EXPECT_EQ(rows[1][0], "0.02");
  EXPECT_EQ(rows[11][1], "0.02") << "the second window begins where the first ended";
  double mass = 0.0, all = 0.0;
  for (std::size_t l = 1; l <= 10; ++l) mass += std::stod(rows[l][4]) * 2.0 / 10.0;
  for (const double m : bodies.mass) all += m;
  EXPECT_LT(mass, all);
  EXPECT_GT(mass, 0.8 * all);
  for (std::size_t l = 2; l <= 4; ++l) EXPECT_NEAR(std::stod(rows[l][5]), std::stod(rows[l][2]), 0.05);
}

// 300 spheres that carry nothing but random velocities: profiles and files go on where the checkpoint was taken, in mid-window.
TEST_F(ContinuumTest, goes_on_from_a_checkpoint_while_bodies_come_and_go) {
  const auto run = [&](ContinuumObserver& observer, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      for (Vec3& place : bodies.position) place.y = std::fmod(place.y + 0.037, 2.0);
      if (step % 3 == 0) erase(step % 20);
      bodies.add_sphere(1000 + step, {0.5, 1.0, 0.7}, 0.04, 2500.0, {0, 0, static_cast<double>(step)});
      observer.observe(at(step), services.attributes());
    }
  };
  expect_checkpoints_to_keep_everything(
      std::string{kScene} + "window = 0.1\ncontact_stress = true", [&] { start(); }, run);
}

TEST_F(ContinuumTest, begins_when_it_is_told_to) {
  const auto observer = make(std::string{kScene} + "from = 0.05");
  start();
  for (std::uint64_t step = 1; step <= 5; ++step) observer->observe(at(step), services.attributes());
  observer->finish(at(5));
  EXPECT_EQ(csv("continuum_profile.csv").size(), 1u) << "nothing was averaged yet";
  EXPECT_TRUE(observer->report().empty());
}

TEST_F(ContinuumTest, refuses_a_slice_outside_of_the_grid) {
  const std::string grid = "grid = {lower = [0, 0, 0], upper = [1, 2, 1], cells = [9, 9, 9]}\nwidth = 0.2\n";
  EXPECT_NE(refusal(grid + "slice_normal = 'y'\nslice_place = 2.1").find("from 0 m to 2 m along y"), std::string::npos);
  EXPECT_NE(refusal(grid + "slice_normal = 'z'\nslice_place = -0.1").find("from 0 m to 1 m along z"),
            std::string::npos);
  EXPECT_NO_THROW((void)make(grid + "slice_normal = 'y'\nslice_place = 1.9"));
}

TEST_F(ContinuumTest, refuses_kernels_between_the_cells_and_grids_that_move) {
  services.add_body("drum", {0, {}, ""});
  EXPECT_NE(
      refusal("grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [2, 9, 9]}\nwidth = 0.2").find("half a cell"),
      std::string::npos);
  EXPECT_NE(refusal("grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [9, 9, 9], frame = 'drum'}\nwidth = 0.2")
                .find("those of the world"),
            std::string::npos);
}

}  // namespace
}  // namespace scree
