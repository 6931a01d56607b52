#include "analysis/region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

Aabb box_of(const Options& table) {
  const Aabb box{table.vector("lower"), table.vector("upper")};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] < box.upper[axis]) continue;
    throw table.error("upper", fmt::format("makes the box empty: along {}, {:g} m is not above {:g} m of 'lower'",
                                           "xyz"[axis], box.upper[axis], box.lower[axis]));
  }
  return box;
}

}  // namespace

std::vector<Parameter> Region::box_parameters() {
  return {Parameter::vector("lower", "m", "corner of the box with the smallest coordinates"),
          Parameter::vector("upper", "m", "corner of the box with the largest coordinates"), Frame::parameter()};
}

Parameter Region::parameter() {
  return Parameter::table("region", box_parameters(), "box in which bodies count; everywhere when left out").optional();
}

Region Region::of_box(const Options& table, SceneServices& services) {
  Region region;
  region.everywhere_ = false;
  region.box_ = box_of(table);
  region.frame_ = Frame{table, services};
  return region;
}

Region::Region(const Options& options, SceneServices& services) {
  if (options.has("region")) *this = of_box(options.table("region"), services);
}

std::optional<std::pair<double, double>> part_inside(const Aabb& box, const Vec3& from, const Vec3& to) {
  if (!is_finite(from) || !is_finite(to)) return std::nullopt;  // in the frame of a body that is gone
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = to[axis] - from[axis];
    if (way == 0.0) {
      if (from[axis] < box.lower[axis] || from[axis] > box.upper[axis]) return std::nullopt;
      continue;
    }
    const auto [enters, leaves] =
        std::minmax({(box.lower[axis] - from[axis]) / way, (box.upper[axis] - from[axis]) / way});
    first = std::max(first, enters);
    last = std::min(last, leaves);
  }
  if (!(first <= last)) return std::nullopt;
  return std::pair{first, last};
}

Parameter CellGrid::parameter() {
  std::vector<Parameter> members = Region::box_parameters();
  members.push_back(Parameter::numbers("cells", "1", "number of cells along x, y and z").with_count(3));
  return Parameter::table("grid", std::move(members), "the box and its division into cells");
}

CellGrid::CellGrid(const Options& options, SceneServices& services)
    : region_{Region::of_box(options.table("grid"), services)}, box_{region_.box()} {
  const Options& table = options.table("grid");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr double kMost = 10000.0;  // along an axis; a slip of the pen else fills the memory
    const double wanted = table.numbers("cells")[axis];
    if (wanted < 1.0 || wanted > kMost || wanted != std::floor(wanted)) {
      throw table.error("cells", fmt::format("must be whole numbers from 1 to {:g}; {:g} is not", kMost, wanted));
    }
    count_[axis] = static_cast<std::size_t>(wanted);
  }
  constexpr std::size_t kMostCells = 4'000'000;  // a cell takes up to 320 bytes
  if (const std::size_t cells = count_[0] * count_[1] * count_[2]; cells > kMostCells) {
    throw table.error(
        "cells", fmt::format("makes {} cells, more than the {} that are possible; take fewer along some axis", cells,
                             kMostCells));
  }
  divide();
}

CellGrid::CellGrid(const Aabb& box, const std::array<std::size_t, 3>& count) : box_{box}, count_{count} { divide(); }

void CellGrid::divide() {
  for (int axis = 0; axis < 3; ++axis) {
    spacing_[axis] =
        (box_.upper[axis] - box_.lower[axis]) / static_cast<double>(count_[static_cast<std::size_t>(axis)]);
  }
}

std::int64_t CellGrid::cell(const Vec3& world) const {
  const Vec3 place = region_.local(world);
  if (!contains(box_, place)) return -1;
  std::size_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const std::size_t n = count_[static_cast<std::size_t>(axis)];
    const auto along = static_cast<std::size_t>((place[axis] - box_.lower[axis]) / spacing_[axis]);
    index = index * n + std::min(along, n - 1);  // the upper face belongs to the last cell
  }
  return static_cast<std::int64_t>(index);
}

}  // namespace scree
