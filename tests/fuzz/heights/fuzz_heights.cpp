// Files of heights, byte by byte: what loads is a full grid of finite numbers, and a surface or a solid comes of it or a refusal.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "scree/base/error.hpp"
#include "scree/geometry/heightfield.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scree;
  try {
    HeightGrid grid = read_height_file(fuzz::file_of(data, size, ".txt"), 1e-3);
    const bool full = grid.heights.size() == grid.columns * grid.rows;
    const bool finite = std::ranges::all_of(grid.heights, [](double h) { return std::isfinite(h); });
    if (!full || !finite) std::abort();
    grid.dx = grid.dy = 0.01;
    const TriangleMesh surface = heightfield_mesh(grid);
    if (surface.triangles.size() != 2 * (grid.columns - 1) * (grid.rows - 1)) std::abort();
    const double lowest = std::ranges::min(grid.heights);
    const TriangleMesh solid = heightfield_mesh(grid, lowest - 1.0);
    const auto in_range = [&](std::uint32_t v) { return v < solid.vertices.size(); };
    if (!std::ranges::all_of(solid.triangles, [&](const Triangle& t) { return std::ranges::all_of(t, in_range); }))
      std::abort();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::io && error.kind() != ErrorKind::usage) throw;
  }
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  std::ofstream{folder / "plain.txt"} << "# mm\n0 1 2\n0 1e1 -2\n.5 1 2\n";
  std::ofstream{folder / "marks.txt"} << "1,2;\t3 # first\n\n4;5,6\r\n";
  std::ofstream{folder / "bad.txt"} << "0 1\n0 x\n1\nnan inf\n1e999 0\n";
}
