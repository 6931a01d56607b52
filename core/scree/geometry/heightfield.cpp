#include "scree/geometry/heightfield.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "scree/base/error.hpp"
#include "scree/geometry/number_table.hpp"

namespace scree {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw Error{ErrorKind::usage, sentence}; }

void check(const HeightGrid& grid) {
  const std::string size = std::to_string(grid.columns) + " columns and " + std::to_string(grid.rows) + " rows";
  if (grid.columns < 2 || grid.rows < 2) {
    refuse("a heightfield needs at least 2 columns and 2 rows of heights, but has " + size);
  }
  if (grid.heights.size() / grid.columns != grid.rows || grid.heights.size() % grid.columns != 0) {
    refuse("a heightfield of " + size + " needs " + std::to_string(grid.columns * grid.rows) + " heights, but has " +
           std::to_string(grid.heights.size()));
  }
  if (grid.heights.size() > std::size_t{1} << 28) refuse("a heightfield of " + size + " is too large to be stored");
  if (!(grid.dx > 0.0) || !(grid.dy > 0.0)) refuse("the spacing of a heightfield must be above zero");
  if (!std::ranges::all_of(grid.heights, [](double h) { return std::isfinite(h); })) {
    refuse("the heights of a heightfield must be finite numbers");
  }
}

/// The vertices on the rim, counter-clockwise seen from above.
std::vector<std::uint32_t> rim_of(const HeightGrid& grid) {
  const auto at = [&](std::size_t i, std::size_t k) { return static_cast<std::uint32_t>(k * grid.columns + i); };
  std::vector<std::uint32_t> rim;
  for (std::size_t i = 0; i + 1 < grid.columns; ++i) rim.push_back(at(i, 0));
  for (std::size_t k = 0; k + 1 < grid.rows; ++k) rim.push_back(at(grid.columns - 1, k));
  for (std::size_t i = grid.columns - 1; i > 0; --i) rim.push_back(at(i, grid.rows - 1));
  for (std::size_t k = grid.rows - 1; k > 0; --k) rim.push_back(at(0, k));
  return rim;
}

/// Walls down from the rim to `base`, and a fan of triangles as underside.
void close(const HeightGrid& grid, double base, TriangleMesh& mesh) {
  const std::vector<std::uint32_t> rim = rim_of(grid);
  const auto count = static_cast<std::uint32_t>(rim.size()), first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const std::uint32_t v : rim) mesh.vertices.push_back({mesh.vertices[v].x, mesh.vertices[v].y, base});
  const std::uint32_t middle = first + count;
  mesh.vertices.push_back({0.5 * grid.dx * static_cast<double>(grid.columns - 1),
                           0.5 * grid.dy * static_cast<double>(grid.rows - 1), base});
  for (std::uint32_t j = 0; j < count; ++j) {
    const std::uint32_t next = (j + 1) % count;
    mesh.triangles.push_back({rim[j], first + j, first + next});
    mesh.triangles.push_back({rim[j], first + next, rim[next]});
    mesh.triangles.push_back({middle, first + next, first + j});
  }
}

}  // namespace

TriangleMesh heightfield_mesh(const HeightGrid& grid, std::optional<double> base) {
  check(grid);
  if (base && !(*base < *std::ranges::min_element(grid.heights))) {
    refuse("the base of a heightfield must lie below all of its heights, the lowest of which is " +
           std::to_string(*std::ranges::min_element(grid.heights)) + " m");
  }
  TriangleMesh mesh;
  mesh.vertices.reserve(grid.heights.size());
  mesh.triangles.reserve(2 * (grid.columns - 1) * (grid.rows - 1));
  for (std::size_t k = 0; k < grid.rows; ++k) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      mesh.vertices.push_back(
          {grid.dx * static_cast<double>(i), grid.dy * static_cast<double>(k), grid.heights[k * grid.columns + i]});
    }
  }
  for (std::size_t k = 0; k + 1 < grid.rows; ++k) {
    for (std::size_t i = 0; i + 1 < grid.columns; ++i) {
      const auto near = static_cast<std::uint32_t>(k * grid.columns + i);
      const auto far = static_cast<std::uint32_t>(near + grid.columns);
      mesh.triangles.push_back({near, near + 1, far + 1});
      mesh.triangles.push_back({near, far + 1, far});
    }
  }
  if (base) close(grid, *base, mesh);
  return mesh;
}

HeightGrid read_height_file(const std::filesystem::path& file, double scale) {
  std::ifstream in{file};
  if (!in || std::filesystem::is_directory(file)) {
    throw Error{ErrorKind::io, "the file of heights '" + file.string() + "' cannot be read; check the path"};
  }
  HeightGrid grid;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const NumberRow row = read_numbers(text);
    const auto refuse_line = [&](const std::string& sentence) {
      throw Error{ErrorKind::usage, SourceLocation{file.string(), line, 0}, sentence};
    };
    if (!row.bad_word.empty()) refuse_line("'" + row.bad_word + "' is no number; a row of heights holds numbers only");
    if (row.numbers.empty()) continue;
    if (!std::ranges::all_of(row.numbers, [](double h) { return std::isfinite(h); })) {
      refuse_line("a height is not finite; every place of the grid needs a height");
    }
    if (grid.rows == 0) grid.columns = row.numbers.size();
    if (row.numbers.size() != grid.columns) {
      refuse_line("this row has " + std::to_string(row.numbers.size()) + " heights, but the first row has " +
                  std::to_string(grid.columns) + "; all rows must be of one length");
    }
    ++grid.rows;
    for (const double height : row.numbers) grid.heights.push_back(scale * height);
  }
  return grid;
}

}  // namespace scree
