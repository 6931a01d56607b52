// Series and files of lines.
#include "vtp/file_series.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "scree/state/memory_state.hpp"
#include "vtp/poly_data.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

class FileSeriesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_series_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(FileSeriesTest, keeps_the_frames_whose_files_are_still_there) {
  FileSeries series;
  series.add(0.1, 0, "a.vtp");
  series.add(0.2, 1, "b.vtp");
  std::ofstream{folder / "b.vtp"} << "x";
  MemoryState state;
  series.save(state.writer(), "frames");
  FileSeries again;
  again.load(state.reader(), "frames", folder);
  ASSERT_EQ(again.frames().size(), 1u);
  EXPECT_EQ(again.frames()[0].file, "b.vtp");
  EXPECT_EQ(again.frames()[0].time, 0.2);
  EXPECT_EQ(again.frames()[0].part, 1);
}

// Lines read back with VTK itself: two segments over three points.
TEST_F(FileSeriesTest, lines_are_cells_that_vtk_reads) {
  PolyData data;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  data.point_count = points.size();
  data.points = to_array("Points", std::span<const Vec3>{points}, Precision::double_precision);
  data.lines = {{0, 1}, {1, 2}};
  data.cell_data = {to_array("force", std::vector<double>{3.0, 4.0}, Precision::double_precision)};
  write_vtp(data, folder / "lines.vtp");
  const std::string command =
      "/usr/bin/python3 -c \"import sys, vtk\n"
      "r = vtk.vtkXMLPolyDataReader(); r.SetFileName(sys.argv[1]); r.Update(); d = r.GetOutput()\n"
      "assert d.GetNumberOfLines() == 2 and d.GetNumberOfVerts() == 0\n"
      "assert d.GetCell(1).GetPointId(0) == 1 and d.GetCell(1).GetPointId(1) == 2\n"
      "assert d.GetCellData().GetArray('force').GetValue(1) == 4.0\" " +
      (folder / "lines.vtp").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace scree
